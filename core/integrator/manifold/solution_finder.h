// Walks from random starts to a target, and how many of them it takes to find a solution again.
//
// The probability P that a walk finds a solution has no closed form. The number of walks until one finds it has the
// expectation 1 / P [Booth 2007; Zeltner et al. 2020, sec. 4.3].
#pragma once
#include "integrator/manifold/manifold_walk.h"

namespace etendue::integrator::manifold {

// A chain that reaches a target: its direction and its type determine it.
struct Solution {
  Frame start;  // z is the direction
  ChainType type;
  ChainEnd end;

  // Whether a chain is this solution, up to rounding errors. They are large in direction close to a focus.
  template <class M>
  bool is(const Chain<M>& chain) const {
    constexpr float kEqual = 1e-4f, kEqualAtEnd = 1e-5f, kClose = 1e-2f;  // radians
    if (type != chain.type) return false;
    const Vec3 difference = chain.start.z - start.z;
    const Vec2 step(glm::dot(difference, start.x), glm::dot(difference, start.y));
    const float length = glm::length(difference);
    return length < kEqual || (length < kClose && end.angle_of(step) < kEqualAtEnd);
  }
};

// Walks from one start to one target.
template <class M>
class SolutionFinder {
 public:
  SolutionFinder(const SpecularCasters& casters, ChainTracer<M>& tracer, const ChainTarget& target, ChainRandom& random)
      : casters_(casters), tracer_(tracer), target_(target), random_(random) {}

  // One walk; false if it does not reach the target.
  bool find(Chain<M>& chain, ChainEnd& end) {
    const ChainStart<M>& start = tracer_.start();
    const scene::SurfacePoint& x = start.point;
    const Vec3 direction = random_direction(x.position);
    if (x.material->is_opaque && (glm::dot(direction, x.ng) > 0) != (glm::dot(start.wo, x.ng) > 0)) return false;
    return tracer_.trace_any(direction, target_.finite_position(), random_, chain) &&
           ManifoldWalk<M>(tracer_, target_, random_).walk(chain, end);
  }

  // The number of walks until one finds a solution, an estimate of 1 / P without bias. Roulette ends long searches: after
  // each block of walks, whose lengths double, a search goes on with probability 1/2, and its further walks count twice as
  // much.
  float estimate_walks(const Solution& solution) {
    float walks = 0, weight = 1;
    for (int block = kFirstBlock; block <= kLastBlock; block *= 2, weight *= 2) {
      for (int i = 0; i < block; ++i) {
        walks += weight;
        if (finds(solution)) return walks;
      }
      if (random_.next() < 0.5f) break;
    }
    return walks;
  }

  // The number of walks until one finds a solution, if that is at most `longest`.
  std::optional<int> search(int longest, const Solution& solution) {
    for (int i = 1; i <= longest; ++i)
      if (finds(solution)) return i;
    return {};
  }

  // Searches that long are certain, so estimates up to this number are numbers of walks.
  static constexpr int kCertainWalks = 31;

 private:
  static constexpr float kStraight = 0.5f;  // the share of walks that start straight towards the target
  // Solutions that fewer than one in about 2 kLastBlock walks finds lose a part of their light.
  static constexpr int kFirstBlock = kCertainWalks + 1, kLastBlock = 1 << 15;

  bool finds(const Solution& solution) {
    ChainEnd end;
    return find(chain_, end) && solution.is(chain_);
  }

  // Straight to the target, from which chains through flat glass deviate little, or to a random point of a caster.
  Vec3 random_direction(const Vec3& from) {
    if (random_.next() < kStraight) return target_.direction_from(from);
    const float choice = random_.next();
    return normalize_or(casters_.sample(choice, random_.next_2d()) - from, Vec3(0, 0, 1));
  }

  const SpecularCasters& casters_;
  ChainTracer<M>& tracer_;
  const ChainTarget& target_;
  ChainRandom& random_;
  Chain<M> chain_;
};

}  // namespace etendue::integrator::manifold
