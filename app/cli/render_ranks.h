// etendue render on several ranks of a job that mpirun has started.
#pragma once
#include <functional>
#include <optional>
#include <string>

#include "cluster/communicator.h"
#include "cluster/sample_ranges.h"
#include "render/partial_result.h"
#include "render_results.h"

namespace etendue::cli {

struct RanksArguments {
  ResultFiles files;
  std::string checkpoint_file;
  double checkpoint_interval = 0;      // seconds; 0: checkpoints are written only if the rendering is interrupted
  bool resumes = false;                // from `checkpoint_file`
  bool sends_scene = false;            // whether rank 0 sends the files of the scene to the other ranks
  std::optional<int> collectors = {};  // as in cluster::ScheduleOptions
};

// What exists already, from a checkpoint.
struct RenderedSamples {
  render::PartialSamples samples;
  cluster::SampleRanges ranges;
  double seconds = 0;
};

// The number of threads of this process, for the argument of --threads: without one, the processes of a machine share
// its hardware threads.
int threads_of_rank(int threads);

// Why a document cannot be rendered by several ranks; empty if it can.
std::string ranks_incompatibility(const render::Document& document);

// Calls `render` on rank 0 of the job that mpirun has started, and renders for it on the other ranks. Returns the exit
// code.
int run_on_ranks(int threads, const std::function<int(cluster::Communicator&)>& render);

// Renders a document and writes the results. Returns the exit code. Called on rank 0.
int render_on_ranks(cluster::Communicator& communicator, const render::Document& document,
                    const RanksArguments& arguments, std::optional<RenderedSamples> start);

}  // namespace etendue::cli
