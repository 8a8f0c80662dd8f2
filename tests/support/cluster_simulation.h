// Simulation of renderings on many ranks: the real schedule, with a clock and a network that are computed.
//
// Rank 0 and each collector receive results one after the other over one link, and add them one after the other. Ranks
// that die do not answer any more.
#pragma once
#include <cstdint>

#include "cluster/work_schedule.h"

namespace etendue::test {

struct SimulatedJob {
  int ranks = 1;
  uint32_t samples = 1000;        // per pixel
  double seconds_per_sample = 1;  // mean of all ranks
  double speed_spread = 0;        // standard deviation of the logarithm of the ranks' speeds
  double slow_pieces = 0;         // the probability that a piece takes ten times as long
  double lifetime = 0;            // mean time until a rank dies, in seconds; 0: none dies. Rank 0 never does
  double damaged_results = 0;     // probability
  double bytes_per_result = 0;
  double bytes_per_second = 1.25e9;  // of the link of each rank that receives results
  double merge_seconds = 0;          // of one result
  double latency = 1e-3;             // seconds of a message
  cluster::ScheduleOptions options = {};
  uint64_t seed = 1;
};

struct SimulatedRun {
  bool is_complete = false;
  double seconds = 0;
  double utilisation =
      0;  // time for rendering the samples of the image, as a fraction of the time of all ranks until they die
  double merging = 0;    // the fraction of the time that rank 0 spends on merging
  double receiving = 0;  // the fraction of the time that its link is in use
  double bytes = 0;      // received by rank 0
  uint32_t results = 0, repeated = 0, damaged = 0;
  uint32_t merged_samples = 0;  // of all results that were added to the film
  int dead_ranks = 0, collectors = 0;
  uint32_t retired_collectors = 0;
};

SimulatedRun simulate(const SimulatedJob& job);

}  // namespace etendue::test
