// Who gets the next samples: adaptive sampling that stays unbiased.
//
// A picture is sampled in rounds. In round p every pixel gets 2^p samples in each half of the film, and as many again,
// on average, go to blocks of pixels by what they bring: numbers of samples proportional to the standard deviations
// make the mean squared error least for the sum of samples (Neyman 1934). At the worst, where the deviations misled, a
// block has half of what an even hand would have given it.
//
// A sampler that looks at its samples to decide whether to take more of them is biased (Kirk & Arvo, "Unbiased Sampling
// Techniques for Image Synthesis", 1991). Here each half is allotted samples by what the first 2^p samples of the
// *other* half say, and their number depends on nothing. Given the allotment, a half is as random as without one, its
// mean unbiased; the mean of both halves is the picture, each with the weight 1/2, as weights by number would know of
// the samples too.
#pragma once
#include <vector>

#include "film/tile_variance.h"
#include "render/document.h"

namespace etendue::render {

class SampleAllocation {
 public:
  // `pixels` are the sizes of the blocks.
  SampleAllocation(Adaptive goal, std::vector<int> pixels);

  // A piece of work: each half of each block gets its samples from number `first` on, up to `end` and to its target.
  struct Piece {
    uint32_t first = 0, end = 0;
  };
  const Piece& piece() const { return piece_; }
  uint32_t target(size_t block, uint32_t half) const { return targets_[block][half]; }

  // The piece is done everywhere: on to the next.
  void advance(const film::TileVariance& spread);

 private:
  void begin_even();
  void begin_uneven(const film::TileVariance& spread);
  void share_out(const film::TileVariance& spread, uint32_t half);
  double worth(const film::TileVariance::Moments& seen) const;
  void set_piece(uint32_t first);

  Adaptive goal_;
  std::vector<int> pixels_;
  double all_pixels_ = 0;
  std::vector<std::array<uint32_t, 2>> targets_;
  uint32_t most_ = 0;  // of the targets
  int power_ = film::TileVariance::kFirstPower;
  bool even_ = true;  // the part of the round that all pixels get
  Piece piece_;
};

}  // namespace etendue::render
