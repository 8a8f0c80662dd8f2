// The scattering function at one surface point: a few lobes in a fixed value on the stack.
//
// Directions are in world space, point away from the surface, and are unit. `eval` leaves the cosine out; densities are
// per solid angle of wi. Which side a direction is on is decided by the geometric normal, the shape of the lobes by the
// shading normal (Veach 1997, section 5.3), so that light never leaks through a surface.
#pragma once
#include "base/frame.h"
#include "bsdf/lobe.h"

namespace etendue {

// M is a transport model: it names Color and Lobes.
template <class M>
class Bsdf {
 public:
  using Color = typename M::Color;

  // Without lobes. `geometric_normal` and the frame's z point to the front of the surface; both must stay where they
  // are.
  void reset(const Frame& shading, const Vec3& geometric_normal) {
    frame_ = &shading, ng_ = &geometric_normal;
    lobes.clear();
  }

  // After a copy: the same at a copy of the point.
  void rebind(const Frame& shading, const Vec3& geometric_normal) { frame_ = &shading, ng_ = &geometric_normal; }

  typename M::Lobes lobes;

  bool has_non_delta_lobe() const { return lobes.has_non_delta_lobe(); }
  const Frame& frame() const { return *frame_; }

  Color eval(const Vec3& wo, const Vec3& wi, TransportMode mode = TransportMode::radiance) const {
    const Vec3 o = frame_->to_local(wo), i = frame_->to_local(wi);
    return consistent(wo, wi, o, i) ? lobes.eval(o, i, mode) * adjoint_factor(wo, wi, o, i, mode) : Color(0);
  }

  // Whether `eval` can have a part of this letter; deltas are none of it.
  bool has_component(ScatterType letter) const { return lobes.has_component(letter); }

  // The part of `eval` that is of one letter.
  Color eval_component(ScatterType letter, const Vec3& wo, const Vec3& wi,
                       TransportMode mode = TransportMode::radiance) const {
    const Vec3 o = frame_->to_local(wo), i = frame_->to_local(wi);
    if (!consistent(wo, wi, o, i)) return Color(0);
    return lobes.eval_component(letter, o, i, mode) * adjoint_factor(wo, wi, o, i, mode);
  }

  float pdf(const Vec3& wo, const Vec3& wi, TransportMode mode = TransportMode::radiance) const {
    const Vec3 o = frame_->to_local(wo), i = frame_->to_local(wi);
    return consistent(wo, wi, o, i) ? lobes.pdf(o, i, mode) : 0;
  }

  // Both at once, the first times the cosine.
  struct Value {
    Color f_cos{0};
    float pdf = 0;
  };
  Value evaluate(const Vec3& wo, const Vec3& wi, TransportMode mode = TransportMode::radiance) const {
    const Vec3 o = frame_->to_local(wo), i = frame_->to_local(wi);
    if (!consistent(wo, wi, o, i)) return {};
    return {lobes.eval(o, i, mode) * (adjoint_factor(wo, wi, o, i, mode) * std::abs(i.z)), lobes.pdf(o, i, mode)};
  }

  // s.weight is f cos / pdf with the cosine to the shading normal; s.wi is in world space. False: the path ends here.
  bool sample(const Vec3& wo, const LobeRandom& random, TransportMode mode, LobeSample<Color>& s) const {
    const Vec3 o = frame_->to_local(wo);
    if (o.z == 0 || !lobes.sample(o, random, mode, s)) return false;
    const Vec3 i = s.wi;
    s.wi = frame_->to_world(i);
    if (!consistent(wo, s.wi, o, i)) return false;
    s.weight *= adjoint_factor(wo, s.wi, o, i, mode);
    return !is_black(s.weight);
  }

  // Every delta with its coefficient, in world space: what `sample` finds when it chooses one, each over the
  // probability of that choice.
  DeltaSet<Color> deltas(const Vec3& wo, TransportMode mode = TransportMode::radiance) const {
    DeltaSet<Color> all, kept;
    const Vec3 o = frame_->to_local(wo);
    if (o.z != 0) lobes.add_deltas(o, mode, all);
    for (int k = 0; k < all.count; ++k) {
      LobeSample<Color> s = all.lobes[static_cast<size_t>(k)];
      const Vec3 i = s.wi;
      s.wi = frame_->to_world(i);
      if (!consistent(wo, s.wi, o, i)) continue;
      s.weight *= adjoint_factor(wo, s.wi, o, i, mode);
      if (!is_black(s.weight)) kept.lobes[static_cast<size_t>(kept.count++)] = s;
    }
    return kept;
  }

  // The delta that takes wo to this side of the surface; d.wi is in world space, and d.value without the adjoint's
  // ratio of cosines. False if there is none.
  bool delta_direction(const Vec3& wo, bool transmitted, TransportMode mode, DeltaDirection<Color>& d) const {
    const Vec3 o = frame_->to_local(wo);
    DeltaSet<Color> all;
    if (o.z != 0) lobes.add_deltas(o, mode, all);
    d = {};
    Vec3 i(0);
    // Those of several lobes that lead the same way are one.
    for (size_t k = 0; k < static_cast<size_t>(all.count); ++k) {
      const LobeSample<Color>& lobe = all.lobes[k];
      if (lobe.transmitted != transmitted) continue;
      i = lobe.wi, d.eta = lobe.eta;
      d.value += lobe.weight, d.probability += all.probabilities[k];
    }
    if (!(d.probability > 0) || is_black(d.value)) return false;
    d.wi = frame_->to_world(i);
    return consistent(wo, d.wi, o, i);
  }

  // |cos| to the shading normal: what an integral over solid angle multiplies f by.
  float cosine(const Vec3& wi) const { return std::abs(glm::dot(frame_->z, wi)); }

 private:
  // Both normals must agree on whether the pair is a reflection or a transmission.
  bool consistent(const Vec3& wo, const Vec3& wi, const Vec3& o, const Vec3& i) const {
    return glm::dot(*ng_, wo) * o.z > 0 && glm::dot(*ng_, wi) * i.z > 0;
  }

  // Shading normals make scattering asymmetric: the adjoint carries the ratio of cosines (Veach 1997, (5.19)).
  float adjoint_factor(const Vec3& wo, const Vec3& wi, const Vec3& o, const Vec3& i, TransportMode mode) const {
    if (mode == TransportMode::radiance) return 1;
    return std::abs(o.z * glm::dot(*ng_, wi) / (i.z * glm::dot(*ng_, wo)));
  }

  const Frame* frame_ = nullptr;
  const Vec3* ng_ = nullptr;
};

}  // namespace etendue
