// Mutations of light paths: proposals and acceptance ratios.             [Lang, sec. 9.4, eq. 9.112, 9.120; Veach 1997]
#pragma once
#include "integrator/mlt/bidirectional_mutation.h"
#include "integrator/mlt/perturbations.h"

namespace etendue::integrator {

enum class Mutation : uint8_t { bidirectional, lens, caustic, chain, subpath };
inline constexpr size_t kMutations = 5;

// The probability of each mutation, by the set of mutations that are applicable to a path; tabulated, because each step
// needs three of them.
class MutationChoice {
 public:
  explicit MutationChoice(const std::array<float, kMutations>& weights) {
    for (unsigned kind = 0; kind < kKinds; ++kind) {
      double sum = 0;
      for (size_t i = 0; i < kMutations; ++i)
        sum += is_applicable(static_cast<Mutation>(i), kind) ? double{weights[i]} : 0;
      for (size_t i = 0; i < kMutations; ++i)
        probabilities_[kind][i] = is_applicable(static_cast<Mutation>(i), kind) ? double{weights[i]} / sum : 0;
    }
  }

  double probability(Mutation mutation, const PathShape& shape) const {
    return probabilities_[kind_of(shape)][static_cast<size_t>(mutation)];
  }
  Mutation choose(const PathShape& shape, ChainRandom& random) const {
    const auto& p = probabilities_[kind_of(shape)];
    double u = random.next();
    for (size_t i = kMutations - 1; i > 0; --i) {
      if (u < p[i]) return static_cast<Mutation>(i);
      u -= p[i];
    }
    return Mutation::bidirectional;
  }

 private:
  static constexpr unsigned kLens = 1, kCaustic = 2, kChain = 4, kKinds = 8;

  static unsigned kind_of(const PathShape& shape) {
    return (shape.lens_end >= 0 ? kLens : 0) | (shape.caustic_start >= 0 ? kCaustic : 0) |
           (shape.chain_end >= 0 ? kChain : 0);
  }
  static bool is_applicable(Mutation mutation, unsigned kind) {
    switch (mutation) {
      case Mutation::bidirectional:
        return true;
      case Mutation::lens:
      case Mutation::subpath:
        return (kind & kLens) != 0;
      case Mutation::caustic:
        return (kind & kCaustic) != 0;
      case Mutation::chain:
        return (kind & kChain) != 0;
    }
    return false;
  }

  std::array<std::array<double, kMutations>, kKinds> probabilities_;
};

// The parameters of all chains.
struct MutationPlan {
  MutationChoice mutations;
  EdgeCounts counts;
  LogUniform pixels, angles;
  float size;  // of the scene, metres
};

// A source of image points, in the unit square, for lens subpath mutations.
template <class PointFunction>
concept ImagePointSource = requires(PointFunction f) {
  { f() } -> std::convertible_to<Vec2>;
};

// Proposes y from x by this mutation. Returns f(y) T(y -> x) / (f(x) T(x -> y)), zero if y has no contribution.
template <class M, ImagePointSource Point>
double propose(Mutation mutation, const MutationPlan& plan, PathSpace<M>& space, const LightPath<M>& x,
               const PathShape& shape, ChainRandom& random, Point&& image_point, LightPath<M>& y,
               PathShape& shape_of_y) {
  double forward = 0, reverse = 0;  // T / f
  switch (mutation) {
    case Mutation::bidirectional: {
      const auto e = exchange(plan.counts, space, x, random, y);
      if (!e) return 0;
      forward = proposal_density_over_f(plan.counts, space, x, *e, y);
      reverse = proposal_density_over_f(plan.counts, space, y, {e->added, e->deleted}, x);
      break;
    }
    case Mutation::lens:
    case Mutation::subpath:
    case Mutation::chain: {
      const int end = mutation == Mutation::chain ? shape.chain_end : shape.lens_end;
      const bool resampled = mutation == Mutation::subpath;
      const Vec2 raster = resampled ? space.image_point(image_point()) : perturb_raster(x.raster, plan.pixels, random);
      const Vec2 lens = resampled ? random.next_2d() : x.lens;
      if (!retrace_from_camera(x, raster, lens, end, plan.angles, space, random, y)) return 0;
      forward = camera_retrace_density_over_f(end, y);
      reverse = camera_retrace_density_over_f(end, x);
      break;
    }
    case Mutation::caustic: {
      const int start = shape.caustic_start;
      if (!retrace_from_light(x, start, plan.angles, plan.size, space, random, y)) return 0;
      forward = light_retrace_density_over_f(start, y);
      reverse = light_retrace_density_over_f(start, x);
      break;
    }
  }
  shape_of_y = integrator::shape_of(y);
  forward *= plan.mutations.probability(mutation, shape);
  reverse *= plan.mutations.probability(mutation, shape_of_y);
  const double ratio = reverse / forward;
  return std::isfinite(ratio) ? ratio : 0;
}

}  // namespace etendue::integrator
