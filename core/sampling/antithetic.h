// Antithetic variates: pairs of samples u and 1 - u                              [Lang, sec. 6.5.5, eq. 6.517-6.522]
//
// Samples 2 i and 2 i + 1 of a pixel have the numbers u and 1 - u in all dimensions; u are those of sample i of `random`.
// With the variance V and the covariance C of f(u) and f(1 - u), the mean of N samples has the variance (V + C) / N.
//
//   Properties    No variance for linear functions, less for monotonic ones. Unbiased for any number of samples.
//   Limitations   For functions that are symmetric about 1/2, C = V: pairs are worth one sample. Light transport varies
//                 mostly by edges and peaks [Lang, Remark 6.28]. Half-buffers have pairs of their own, so that the first
//                 pair is complete after three samples of the pixel, and both are after four.
#pragma once
#include "base/hash.h"
#include "sampling/random.h"

namespace etendue {

class AntitheticSampler final : public Sampler {
 public:
  static constexpr SamplerDescription kDescription{
      .name = "antithetic",
      .label = "Antithetic",
      .doc = "Pairs of samples u and 1 - u: exact for linear functions, twice the variance for symmetric ones.",
      .for_study = true,
      .joint_dimensions = 1,
      .padding = "independent random numbers for each pair and dimension",
  };
  auto parameters() { return std::tie(); }

  void block(uint32_t pixel_seed, uint32_t sample, uint32_t block, SampleBlock& out) const override {
    constexpr float kLargest = 1 - 0x1p-24f;
    pairs_.block(pixel_seed, sample / 2, block, out);
    if (sample % 2 == 0) return;
    for (float& u : out) u = kLargest - u;
  }

 private:
  RandomSampler pairs_;
};

}  // namespace etendue
