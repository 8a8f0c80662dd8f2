// Newton's method for the direction in which a chain reaches a target.          [Hanika et al. 2015; Zeltner et al. 2020]
//
// The unknown is the direction at the start of the chain, in two coordinates. Every evaluation traces the whole chain, so
// that all its events obey the laws of reflection and refraction exactly, and only its end misses the target.
#pragma once
#include <cmath>

#include "integrator/manifold/chain_target.h"

namespace etendue::integrator::manifold {

// By how much the end of a chain misses its target.
struct ChainEnd {
  float distance = 0;            // from the last vertex to the target, metres
  Vec2 miss{0};                  // the angle between the ray and the direction of the target, times the distance
  EndDerivatives derivatives{};  // of the end of the ray at this distance, by the direction at the start

  // The change of direction that reaches the target to first order.
  Vec2 step() const {
    const auto& [x, y] = derivatives.column;
    return Vec2(miss.x * y.y - miss.y * y.x, miss.y * x.x - miss.x * x.y) / derivatives.determinant();
  }
  // The angle under which the end moves by a change of direction, to first order.
  float angle_of(Vec2 step) const { return angle(derivatives.column[0] * step.x + derivatives.column[1] * step.y); }
  float angle() const { return angle(miss); }

 private:
  float angle(Vec2 v) const { return glm::length(v) / (std::isinf(distance) ? 1 : distance); }
};

template <class M>
ChainEnd end_of(const Chain<M>& chain, const ChainTarget& target) {
  ChainEnd end;
  const Vec3 towards = target.direction_from(chain.last.position);
  end.distance = target.is_infinite() ? kInfinity : glm::distance(target.position(), chain.last.position);
  const Frame across(chain.direction);
  end.derivatives = end_derivatives(chain.derivatives, across, end.distance);
  const Vec2 sideways(glm::dot(towards, across.x), glm::dot(towards, across.y));
  const float sine = glm::length(sideways), angle = std::atan2(sine, glm::dot(towards, chain.direction));
  const float scale = target.is_infinite() ? 1 : end.distance;
  end.miss = sine > 0 ? sideways * (angle / sine * scale) : Vec2(angle * scale, 0);
  return end;
}

// Newton's method for the direction of a chain.
template <class M>
class ManifoldWalk {
 public:
  ManifoldWalk(ChainTracer<M>& tracer, const ChainTarget& target, ChainRandom& random)
      : tracer_(tracer), target_(target), random_(random) {}

  // Changes the direction of a chain, whose type it keeps, until the chain reaches the target; false if it does not.
  bool walk(Chain<M>& chain, ChainEnd& end) {
    end = end_of(chain, target_);
    traces_ = 0;
    while (traces_ < kMaxTraces) {
      Vec2 step = end.step();
      const float length = glm::length(step);
      if (!std::isfinite(length)) return false;
      if (length < kConverged || end.angle() < kReached) return true;
      if (length > kLongestStep) step *= kLongestStep / length;
      if (!descend(step, chain, end) && !leave(step, chain, end)) return false;
    }
    return false;
  }

 private:
  static constexpr int kMaxTraces = 12, kMaxHalvings = 2;
  static constexpr float kLongestStep = 0.3f, kConverged = 1e-5f;  // radians
  // Close to a focus, the end hardly depends on the direction, and rounding errors keep steps long.
  static constexpr float kReached = 3e-6f;  // radians

  bool move(Vec2 step, const Chain<M>& from, Chain<M>& next, ChainEnd& reached) {
    ++traces_;
    const Frame& f = from.start;
    if (!tracer_.trace(glm::normalize(f.z + f.x * step.x + f.y * step.y), from.type, next)) return false;
    reached = end_of(next, target_);
    return true;
  }

  // Takes a step, or a shorter one, that brings the end closer to the target.
  bool descend(Vec2 step, Chain<M>& chain, ChainEnd& end) {
    Chain<M> next;
    ChainEnd reached;
    for (int k = 0; k <= kMaxHalvings; ++k, step *= 0.5f)
      if (move(step, chain, next, reached) && reached.angle() < end.angle()) {
        chain = next, end = reached;
        return true;
      }
    return false;
  }

  // Takes a random step of similar length. The derivative of interpolated normals jumps at the edges of triangles, where
  // Newton's method can get stuck between two of them.
  bool leave(Vec2 step, Chain<M>& chain, ChainEnd& end) {
    const float along = 2 * random_.next(), across = 2 * random_.next() - 1;
    Chain<M> next;
    ChainEnd reached;
    if (!move(step * along + Vec2(-step.y, step.x) * across, chain, next, reached)) return false;
    chain = next, end = reached;
    return true;
  }

  ChainTracer<M>& tracer_;
  const ChainTarget& target_;
  ChainRandom& random_;
  int traces_ = 0;
};

}  // namespace etendue::integrator::manifold
