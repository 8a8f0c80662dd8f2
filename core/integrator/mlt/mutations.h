// Metropolis' algorithm on light paths: proposals, and how often each is accepted.       thesis 9.4, (9.112), (9.120)
#pragma once
#include "integrator/mlt/bidirectional_mutation.h"
#include "integrator/mlt/perturbations.h"

namespace etendue::integrator {

enum class Mutation : uint8_t { bidirectional, lens, caustic, chain, subpath };
inline constexpr size_t kMutations = 5;

// How often each mutation is tried, by which of them a path admits: prepared for all cases, as a chain asks for it
// three times in each step.
class MutationChoice {
 public:
  explicit MutationChoice(const std::array<float, kMutations>& weights) {
    for (unsigned kind = 0; kind < kKinds; ++kind) {
      double sum = 0;
      for (size_t i = 0; i < kMutations; ++i) sum += admits(static_cast<Mutation>(i), kind) ? double{weights[i]} : 0;
      for (size_t i = 0; i < kMutations; ++i)
        probabilities_[kind][i] = admits(static_cast<Mutation>(i), kind) ? double{weights[i]} / sum : 0;
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
  static bool admits(Mutation mutation, unsigned kind) {
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

// What all chains of a picture share.
struct MutationPlan {
  MutationChoice mutations;
  EdgeCounts counts;
  Octaves pixels, angles;
  float size;  // of the scene, metres
};

// What a path is proposed from besides random numbers: the point of the picture, in the unit square, that a lens
// subpath mutation takes.
template <class PointOfPicture>
concept PicturePoints = requires(PointOfPicture f) {
  { f() } -> std::convertible_to<Vec2>;
};

// Proposes y from x by this mutation. Returns f(y) T(y -> x) over f(x) T(x -> y), zero if y has no contribution.
template <class M, PicturePoints Point>
double propose(Mutation mutation, const MutationPlan& plan, PathSpace<M>& space, const LightPath<M>& x,
               const PathShape& shape, ChainRandom& random, Point&& point_of_picture, LightPath<M>& y,
               PathShape& shape_of_y) {
  double there = 0, back = 0;  // T / f
  switch (mutation) {
    case Mutation::bidirectional: {
      const auto e = exchange(plan.counts, space, x, random, y);
      if (!e) return 0;
      there = tentative(plan.counts, space, x, *e, y);
      back = tentative(plan.counts, space, y, {e->added, e->deleted}, x);
      break;
    }
    case Mutation::lens:
    case Mutation::subpath:
    case Mutation::chain: {
      const int end = mutation == Mutation::chain ? shape.chain_end : shape.lens_end;
      const bool anew = mutation == Mutation::subpath;
      const Vec2 raster = anew ? space.point_of_picture(point_of_picture()) : moved(x.raster, plan.pixels, random);
      const Vec2 lens = anew ? random.next_2d() : x.lens;
      if (!retrace_from_camera(x, raster, lens, end, plan.angles, space, random, y)) return 0;
      there = retraced_from_camera(end, y);
      back = retraced_from_camera(end, x);
      break;
    }
    case Mutation::caustic: {
      const int start = shape.caustic_start;
      if (!retrace_from_light(x, start, plan.angles, plan.size, space, random, y)) return 0;
      there = retraced_from_light(start, y);
      back = retraced_from_light(start, x);
      break;
    }
  }
  shape_of_y = integrator::shape_of(y);
  there *= plan.mutations.probability(mutation, shape);
  back *= plan.mutations.probability(mutation, shape_of_y);
  const double ratio = back / there;
  return std::isfinite(ratio) ? ratio : 0;
}

}  // namespace etendue::integrator
