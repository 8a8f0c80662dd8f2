// The ranks that add up the results of other ranks for rank 0: a tree of two levels.
//
// With many ranks, rank 0 cannot add all results itself. Collectors receive the results of a group of ranks each, and
// rank 0 asks them for their sums from time to time. Sums are exact, so the image has the same bits. The samples of a
// collector that fails are rendered again.
#pragma once
#include <optional>
#include <vector>

#include "cluster/sample_ranges.h"

namespace etendue::cluster {

class Collectors {
 public:
  // The ranks 1 to `count` become collectors.
  void begin(int count) { collectors_.resize(static_cast<size_t>(count)); }
  int count() const { return static_cast<int>(collectors_.size()); }
  int usable() const;
  bool is_usable(int rank) const { return rank > 0 && rank <= count() && !at(rank).has_failed; }
  // Where a rank sends its results; 0 is rank 0.
  int collector_of(int rank) const;

  // The collector has these samples.
  void hold(int rank, const SampleRange& samples) { at(rank).held.add(samples); }
  // Whether the collector has samples that rank 0 has not asked for.
  bool is_due(int rank, double now, double interval) const;
  bool has_samples(int rank) const { return at(rank).held.count() > 0 && !is_asked(rank); }
  // Rank 0 asks for all samples that the collector has.
  void ask(int rank, double now);
  bool is_asked(int rank) const { return at(rank).asked.count() > 0; }
  bool is_overdue(int rank, double now, double patience) const;
  // The answer has arrived. The samples that it contains; empty if there was no question.
  SampleRanges deliver(int rank);
  // The collector is not used any more. The samples that it has not delivered.
  SampleRanges retire(int rank);

 private:
  struct Collector {
    bool has_failed = false;
    SampleRanges held, asked;
    double asked_at = 0;
  };
  const Collector& at(int rank) const { return collectors_[static_cast<size_t>(rank) - 1]; }
  Collector& at(int rank) { return collectors_[static_cast<size_t>(rank) - 1]; }

  std::vector<Collector> collectors_;
};

}  // namespace etendue::cluster
