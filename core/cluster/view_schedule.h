// Division of the samples of a document among ranks while it is viewed.
//
// Rank 0 takes one sample at a time, other ranks pieces: ranges of sample numbers. A rank may have several pieces whose
// samples have not been delivered, so it goes on rendering while a film is transferred. Each sample number is given
// out once; only those of a rank that is given up are given out again, and what it delivers later does not count.
#pragma once
#include <cstdint>
#include <optional>
#include <span>
#include <vector>

#include "cluster/work_schedule.h"

namespace etendue::cluster {

class ViewSchedule {
 public:
  explicit ViewSchedule(int ranks) : ranks_(static_cast<size_t>(ranks)) {}

  // Begins a document. `limit` is the number of samples per pixel; 0: no limit.
  void begin(uint32_t limit);
  // Pieces beyond a lower limit are taken from their ranks.
  void set_limit(uint32_t limit);

  // The next sample of rank 0; nothing if all are given out.
  std::optional<uint32_t> next_own();
  // A piece that takes about this many seconds, as far as the speed of the rank is known. Nothing if all samples are
  // given out, or if the rank has many pieces that it has not delivered. The first piece of a document is one sample.
  std::optional<Piece> next(int rank, double seconds);
  // A rank has rendered a piece in this time.
  void measure(int rank, uint32_t samples, double seconds);
  // A rank has delivered these pieces. Returns whether they are to be added to the image: all, or none if one of them
  // has been taken from the rank; the others are then given out again.
  bool deliver(int rank, std::span<const uint64_t> pieces);
  // Takes all pieces from a rank that it has not delivered.
  void give_up(int rank);

  size_t undelivered(int rank) const { return ranks_[static_cast<size_t>(rank)].pieces.size(); }
  // Whether the rank has rendered no piece of the document yet.
  bool is_first(int rank) const { return !ranks_[static_cast<size_t>(rank)].has_rendered; }
  // Samples per pixel of the document: of rank 0, which may include one in progress, and delivered by other ranks.
  uint32_t own_samples() const { return own_samples_; }
  uint32_t delivered_samples() const { return delivered_samples_; }

 private:
  struct Rank {
    std::vector<Piece> pieces;      // not delivered
    double seconds_per_sample = 0;  // measured; 0: not known
    uint32_t pieces_of_document = 0;
    bool has_rendered = false;  // a piece of the document
  };

  uint32_t remaining() const;
  std::optional<SampleRange> take(uint32_t most);

  std::vector<Rank> ranks_;
  uint32_t limit_ = 0;
  SampleRanges given_out_;
  uint32_t own_samples_ = 0, delivered_samples_ = 0;
  uint64_t last_id_ = 0;
};

}  // namespace etendue::cluster
