// Poisson disk sets and related blue-noise sets                              [Lang, sec. 6.5.3 and 7.4; Cook 1986]
//
// Each two-dimensional decision of a group takes the points of a set in which no two points are closer than a distance,
// modulo 1. The set is the same for all pixels, moved by a random offset modulo 1 (Cranley-Patterson rotation).
//
//   darts           accepts random points until none has been accepted for long [Cook 1986]; the number of points follows
//                   from the distance and is a little smaller or larger than asked for
//   bridson         tries random points in an annulus around points of the set [Bridson 2007]; denser, with about the same
//                   number of points
//   best-candidate  adds the candidate that is farthest from the set, from a number of candidates that grows with the set
//                   [Mitchell 1991]; any prefix is evenly distributed, and the number of points is exact
//
//   Properties    Little energy at low frequencies: aliasing becomes noise of high frequencies.
//   Limitations   The projections onto the axes are random. The convergence rate is that of random numbers.
#pragma once
#include "sampling/sampler.h"

namespace etendue {

enum class PoissonDiskSize { small, medium, large };
enum class PoissonDiskAlgorithm { darts, bridson, best_candidate };

}  // namespace etendue

template <>
struct etendue::Options<etendue::PoissonDiskSize> {
  static constexpr std::array<etendue::Option, 3> kOptions{{{"16", "16"}, {"64", "64"}, {"256", "256"}}};
};
template <>
struct etendue::Options<etendue::PoissonDiskAlgorithm> {
  static constexpr std::array<etendue::Option, 3> kOptions{
      {{"darts", "Dart throwing"}, {"bridson", "Bridson"}, {"best-candidate", "Best candidate"}}};
};

namespace etendue {

class PoissonDiskSampler final : public Sampler {
 public:
  static constexpr SamplerDescription kDescription{
      .name = "poisson-disk",
      .label = "Poisson disk",
      .doc = "Sets of random points that keep a distance. For comparison: no aliasing, but slow convergence.",
      .progressive = false,
      .for_study = true,
      .joint_dimensions = 2,
      .padding = "independent orders of samples for each decision of a path",
  };
  Choice<PoissonDiskSize> size{"size", "Group size", PoissonDiskSize::medium, "Approximate number of points of a set"};
  Choice<PoissonDiskAlgorithm> algorithm{"algorithm", "Algorithm", PoissonDiskAlgorithm::darts,
                                         "How the set is generated"};
  auto parameters() { return std::tie(size, algorithm); }

  struct Points {
    double distance = 0;  // the smallest one between two points, modulo 1
    std::vector<std::array<double, 2>> points;
  };
  // The set of a size without offset.
  static const Points& points(PoissonDiskSize size, PoissonDiskAlgorithm algorithm = PoissonDiskAlgorithm::darts);

  void block(uint32_t pixel_seed, uint32_t sample, uint32_t block, SampleBlock& out) const override;
};

}  // namespace etendue
