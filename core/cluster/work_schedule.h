// Division of the samples of a rendering among ranks (processes of a job).
//
// Ranks receive pieces, which are ranges of sample numbers, one at a time. Sizes follow from the measured speeds, so
// that fast ranks receive more. As in guided self-scheduling [Polychronopoulos and Kuck 1987], a piece takes half of the
// time that all ranks together need for the rest, so that all end at about the same time. A piece whose rank is late is
// given to another rank as well; the first answer counts. Both have the same bits.
//
// With many ranks, results go to collectors (cluster/collectors.h), and their sums to rank 0.
//
// The schedule has no clock and sends nothing: times are arguments, in seconds from any origin.
#pragma once
#include <cstdint>
#include <limits>
#include <optional>
#include <vector>

#include "cluster/collectors.h"
#include "cluster/sample_ranges.h"

namespace etendue::cluster {

struct ScheduleOptions {
  double shortest_piece = 0.5, longest_piece = 30;  // planned duration of a piece, in seconds
  // The fraction of its time that rank 0 may spend on merging. Where that is needed, pieces are longer than the above.
  // Only towards the end it is exceeded.
  double merge_load = 0.2;
  // A piece is late after this multiple of its planned duration, and a while longer. It is then given to another rank.
  double patience = 4, shortest_patience = 5;
  // The time that the first piece of a rank may take besides, because the scene is compiled.
  double first_patience = 60;
  int most_damaged = 3;  // damaged results after which a rank receives no more pieces
  // Ranks that add up results for rank 0. Without a number it follows from the duration of adding a result: none, or
  // the square root of the number of ranks.
  std::optional<int> collectors = {};
};

struct Piece {
  uint64_t id = 0;
  SampleRange samples;
  int32_t collector = 0;  // the rank that receives the result
  int32_t unused = 0;     // so that the bytes of a message are defined
};

class WorkSchedule {
 public:
  // `samples` are to be rendered per pixel, without a limit if it is 0. Those of `done` exist already.
  WorkSchedule(int ranks, uint32_t samples, SampleRanges done, const ScheduleOptions& options = {});

  // No piece is planned to end later than this time by more than half of the duration of one sample.
  void set_deadline(double time) { deadline_ = time; }
  // The measured duration of adding one result to the film of rank 0.
  void set_merge_seconds(double seconds);

  // The next piece of a rank that has none; nothing if there is no work for it at present.
  std::optional<Piece> next(int rank, double now);
  // The answer of a rank has arrived at its collector. Returns whether the samples of its piece are new and have to be
  // merged.
  bool complete(int rank, uint64_t piece, double now);
  // The answer of a rank to its piece is damaged.
  void reject(int rank);
  // The collector that has to send its sum now, if there is one.
  std::optional<int> next_to_collect(double now);
  // The sum of a collector has arrived. Returns whether it has to be merged.
  bool deliver(int collector);
  // A collector that does not answer, if there is one.
  std::optional<int> late_collector(double now) const;
  // The collector is not used any more. What it has not delivered is rendered again.
  void retire(int collector);
  // The rank does not exist any more. Its piece is given to another one.
  void remove(int rank);
  // No further samples are begun. Those between samples that exist are still completed.
  void close();

  bool is_finished() const { return samples_ > 0 && done_.contains({0, samples_}); }
  const SampleRanges& done() const { return done_; }
  // The number of samples at the end: the limit, or, once the schedule is closed, that of begun samples. 0: not known.
  uint32_t samples() const { return samples_; }

  // Samples that a rank has rendered and that were new.
  uint32_t samples_of(int rank) const { return ranks_[static_cast<size_t>(rank)].samples; }
  // Whether the result of the rank's piece goes to this collector.
  bool is_at(int rank, int collector) const {
    const Rank& r = rank_at(rank);
    return r.piece && r.piece->collector == collector;
  }
  // Whether the rank has a piece and is late.
  bool is_late(int rank, double now) const;
  // Ranks that receive work.
  int active_ranks() const;
  // Ranks that add up results for rank 0.
  int collectors() const { return collectors_.count(); }
  uint32_t repeated_pieces() const { return repeated_pieces_; }  // pieces that were given to a further rank
  uint32_t damaged_results() const { return damaged_results_; }
  uint32_t retired_collectors() const { return retired_collectors_; }

 private:
  struct Rank {
    bool is_active = true;
    std::optional<Piece> piece;     // that it is rendering
    double begun = 0, planned = 0;  // time when it received the piece, and planned duration; 0: not known
    double seconds_per_sample = 0;  // measured; 0: not known
    uint32_t measured_samples = 0;  // of the piece from which it was measured
    uint32_t samples = 0;
    int damaged = 0;
  };
  struct OpenPiece {
    Piece piece;
    std::vector<int> ranks;  // that are rendering it
  };

  const Rank& rank_at(int rank) const { return ranks_[static_cast<size_t>(rank)]; }
  Rank& rank_at(int rank) { return ranks_[static_cast<size_t>(rank)]; }
  std::optional<size_t> find(uint64_t id) const;
  double seconds_per_sample(int rank) const;
  void update_speeds();
  double merging_seconds() const;
  double collecting_seconds() const;
  bool has_open_piece_for(int collector) const;
  double piece_seconds(double now) const;
  uint32_t piece_samples(int rank, double now) const;
  bool is_expected_late(const OpenPiece& open, double now) const;
  const OpenPiece* late_piece(double now) const;
  Piece assign(int rank, const Piece& piece, double now);
  void release(int rank, uint64_t id);
  void measure(Rank& rank, const SampleRange& range, double seconds);

  ScheduleOptions options_;
  uint32_t samples_;
  double deadline_ = std::numeric_limits<double>::infinity();
  double merge_seconds_ = 0;
  std::vector<Rank> ranks_;
  std::vector<OpenPiece> open_;
  Collectors collectors_;
  SampleRanges done_, begun_;                                       // begun_: done, at a collector, or in an open piece
  double typical_seconds_per_sample_ = 0, samples_per_second_ = 0;  // of active ranks; 0: not known
  double no_work_until_ = 0;
  uint64_t last_id_ = 0;
  uint32_t repeated_pieces_ = 0, damaged_results_ = 0, retired_collectors_ = 0;
};

}  // namespace etendue::cluster
