// Rank-1 lattice sequence                                          [Hickernell et al. 2000; Cools et al. 2006]
//
// Dimension j of sample i is frac(Phi_2(i) z_j) with the radical inverse Phi_2 in base 2, moved by a random offset modulo
// 1 that is independent for every pixel and dimension (Cranley-Patterson rotation). The numbers z_j are those for 2^20
// points in base 2 of [Cools et al. 2006]. Each block of dimensions after the first 64 reuses the first eight
// dimensions with its own order of samples.
//
//   Properties    The first 2^m samples are a lattice. Progressive. The error falls faster than with random numbers for
//                 smooth functions, and fastest for smooth periodic ones.
//   Limitations   Edges that are parallel to lines of the lattice.
#pragma once
#include "sampling/owen.h"
#include "sampling/point_group.h"

namespace etendue {

class LatticeSampler final : public Sampler {
 public:
  static constexpr SamplerDescription kDescription{
      .name = "lattice",
      .label = "Rank-1 lattice",
      .doc = "A lattice with a random offset that grows with the samples. Good for smooth integrands.",
      .for_study = true,
      .joint_dimensions = 64,
      .padding = "blocks of the first eight dimensions, each in an order of samples of its own",
  };
  static constexpr uint32_t kDimensions = 64;
  auto parameters() { return std::tie(); }

  // The coordinate without the offset, as a fraction of 32 bits.
  static uint32_t point(uint32_t sample, uint32_t dimension) {
    static constexpr std::array<uint32_t, kDimensions> kGenerator{
        1,      182667, 469891, 498753, 110745, 446247, 250185, 118627, 245333, 283199, 408519, 391023, 246327,
        126539, 399185, 461527, 300343, 69681,  516695, 436179, 106383, 238523, 413283, 70841,  47719,  300129,
        113029, 123925, 410745, 211325, 17489,  511893, 40767,  186077, 519471, 255369, 101819, 243573, 66189,
        152143, 503455, 113217, 132603, 463967, 297717, 157383, 224015, 502917, 36237,  94049,  170665, 79397,
        123963, 223451, 323871, 303633, 98567,  318855, 494245, 477137, 177975, 64483,  26695,  88779};
    return reverse_bits(sample) * kGenerator[dimension];
  }

  void block(uint32_t pixel_seed, uint32_t sample, uint32_t block, SampleBlock& out) const override {
    const uint32_t seed = hash_combine(pixel_seed, block);
    const bool is_padding = block >= kDimensions / kBlockSize;
    const uint32_t index = is_padding ? owen_scramble(sample, mix_bits(seed)) : sample;
    for (uint32_t k = 0; k < kBlockSize; ++k)
      out[k] = to_unit_float(point(index, is_padding ? k : block * kBlockSize + k) + hash_combine(seed, k));
  }
};

}  // namespace etendue
