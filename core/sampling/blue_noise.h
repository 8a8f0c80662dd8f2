// A (0,2) sequence for each decision, with errors that are blue noise over the image
//                                  [Heitz and Belcour 2019; Ahmed and Wonka 2020; Ahmed 2024; Christensen et al. 2018]
//
// The points are those of `pmj02`, but the pixels of a tile of 32 x 32 share their randomisation. Pixel q of the tile, in
// the order of a Z-curve, adds a number of its own, digit by digit, before the randomisation:
//
//   x(q, i) = scramble(C i + P^T C q)   modulo 2
//
// C is the generator matrix of the coordinate, P^T the transposed Pascal matrix, i the sample. The points of a pixel are a
// digital shift of the net of `pmj02`, so that each pixel has its variance. From sample 2 on, each pixel has its own order of
// samples within the groups of 2^h samples that follow 2^h. With P^T, the first 2^m samples of the 2^k pixels of each aligned
// part of the tile together have one value in each of 2^(m + k) intervals, for all m and k, because all square parts of
// consecutive rows and the first columns of P^T are regular [Lang, sec. 7.2.4]. Errors of neighbouring pixels that come from
// single decisions therefore cancel: the noise is of high frequency.
//
//   Properties    As `pmj02` for each pixel. Over the pixels of a tile, the first sample of each two-dimensional decision is
//                 a net as well. Progressive; helps most with one to four samples per pixel, and where few decisions
//                 determine the error.
//   Cost          about 1.6 times that of `pmj02`
//   Limitations   Errors of neighbouring pixels are correlated. Noise that depends on many decisions, like that of
//                 indirect light, stays nearly white. Further light samples and branches of a path have independent numbers.
#pragma once
#include "sampling/sampler.h"

namespace etendue {

class BlueNoiseSampler final : public Sampler {
 public:
  static constexpr SamplerDescription kDescription{
      .name = "blue-noise",
      .label = "Blue-noise (0,2)",
      .doc =
          "As pmj02, with points that neighbouring pixels share so that their errors cancel: the noise of few samples is "
          "of high frequency and less visible.",
      .joint_dimensions = 2,
      .padding = "independent orders of samples and pixels for each decision of a path",
  };
  static constexpr int kTileBits = 5;
  auto parameters() { return std::tie(); }

  void block(uint32_t pixel_seed, uint32_t sample, uint32_t block, SampleBlock& out) const override;
  DimensionSet blocks(std::span<const uint32_t> pixel_seeds, uint32_t sample, uint32_t block, DimensionSet requested,
                      SampleTable& out) const override;
  int tile_bits() const override { return kTileBits; }
};

}  // namespace etendue
