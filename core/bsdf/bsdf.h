// The BSDF at a surface point: a set of lobes in the shading frame, evaluated for world-space directions.
//
// Directions are unit vectors in world space that point away from the surface. `eval` is f in 1/sr, without the cosine;
// densities are per solid angle of wi. The geometric normal decides on which side of the surface a direction lies, the
// shading normal orients the lobes. Pairs for which the two normals disagree scatter nothing, so that no light leaks
// through a surface [Veach 1997, sec. 5.3].
#pragma once
#include "base/frame.h"
#include "bsdf/lobe.h"

namespace etendue {

// M is a transport model (transport/model_types.h), which defines Color and Lobes.
template <class M>
class Bsdf {
 public:
  using Color = typename M::Color;

  // Removes all lobes. The frame's z axis and `geometric_normal` point to the front of the surface. They are
  // referenced, not copied: they must outlive the BSDF and stay in place.
  void reset(const Frame& shading, const Vec3& geometric_normal) {
    rebind(shading, geometric_normal);
    lobes.clear();
  }

  // Keeps the lobes. To be called after copying a BSDF together with its surface point.
  void rebind(const Frame& shading, const Vec3& geometric_normal) {
    frame_ = &shading;
    ng_ = &geometric_normal;
  }

  typename M::Lobes lobes;

  bool has_non_delta_lobe() const { return lobes.has_non_delta_lobe(); }
  const Frame& frame() const { return *frame_; }

  // f, without deltas.
  Color eval(const Vec3& wo, const Vec3& wi, TransportMode mode = TransportMode::radiance) const {
    const Vec3 o = frame_->to_local(wo), i = frame_->to_local(wi);
    return consistent(wo, wi, o, i) ? lobes.eval(o, i, mode) * adjoint_factor(wo, wi, o, i, mode) : Color(0);
  }

  // Whether `eval_component` can differ from 0 for this type. Deltas do not count.
  bool has_component(ScatterType type) const { return lobes.has_component(type); }

  // The part of `eval` of one scattering type.
  Color eval_component(ScatterType type, const Vec3& wo, const Vec3& wi,
                       TransportMode mode = TransportMode::radiance) const {
    const Vec3 o = frame_->to_local(wo), i = frame_->to_local(wi);
    if (!consistent(wo, wi, o, i)) return Color(0);
    return lobes.eval_component(type, o, i, mode) * adjoint_factor(wo, wi, o, i, mode);
  }

  // Density with which `sample` generates wi, per solid angle; deltas have none.
  float pdf(const Vec3& wo, const Vec3& wi, TransportMode mode = TransportMode::radiance) const {
    const Vec3 o = frame_->to_local(wo), i = frame_->to_local(wi);
    return consistent(wo, wi, o, i) ? lobes.pdf(o, i, mode) : 0;
  }

  // f |cos_i| with the cosine to the shading normal, and the density, at the cost of one change of frame.
  struct Value {
    Color f_cos{0};
    float pdf = 0;
  };
  Value evaluate(const Vec3& wo, const Vec3& wi, TransportMode mode = TransportMode::radiance) const {
    const Vec3 o = frame_->to_local(wo), i = frame_->to_local(wi);
    if (!consistent(wo, wi, o, i)) return {};
    return {lobes.eval(o, i, mode) * (adjoint_factor(wo, wi, o, i, mode) * std::abs(i.z)), lobes.pdf(o, i, mode)};
  }

  // Samples a direction. s.weight is f |cos_i| / pdf with the cosine to the shading normal, s.wi is in world space.
  // False if the light is absorbed; the path ends. s must be default-initialised.
  bool sample(const Vec3& wo, const LobeRandom& random, TransportMode mode, LobeSample<Color>& s) const {
    const Vec3 o = frame_->to_local(wo);
    if (o.z == 0 || !lobes.sample(o, random, mode, s)) return false;
    const Vec3 i = s.wi;
    s.wi = frame_->to_world(i);
    if (!consistent(wo, s.wi, o, i)) return false;
    s.weight *= adjoint_factor(wo, s.wi, o, i, mode);
    return !is_black(s.weight);
  }

  // All deltas with their coefficients, in world space. `sample` returns the same coefficients over the probability of
  // selecting the delta. The probabilities of the result are not set.
  DeltaSet<Color> deltas(const Vec3& wo, TransportMode mode = TransportMode::radiance) const {
    DeltaSet<Color> all, world;
    const Vec3 o = frame_->to_local(wo);
    if (o.z != 0) lobes.add_deltas(o, mode, all);
    for (int k = 0; k < all.count; ++k) {
      LobeSample<Color> s = all.lobes[static_cast<size_t>(k)];
      const Vec3 i = s.wi;
      s.wi = frame_->to_world(i);
      if (!consistent(wo, s.wi, o, i)) continue;
      s.weight *= adjoint_factor(wo, s.wi, o, i, mode);
      if (!is_black(s.weight)) world.lobes[static_cast<size_t>(world.count++)] = s;
    }
    return world;
  }

  // The delta that scatters wo to one side of the surface: reflection, or transmission if `transmitted`. Deltas of
  // several lobes in the same direction are added. d.wi is in world space; d.value excludes the adjoint factor of
  // shading normals. False if there is no such delta.
  bool delta_direction(const Vec3& wo, bool transmitted, TransportMode mode, DeltaDirection<Color>& d) const {
    const Vec3 o = frame_->to_local(wo);
    DeltaSet<Color> all;
    if (o.z != 0) lobes.add_deltas(o, mode, all);
    d = {};
    Vec3 i(0);
    for (size_t k = 0; k < static_cast<size_t>(all.count); ++k) {
      const LobeSample<Color>& lobe = all.lobes[k];
      if (lobe.transmitted != transmitted) continue;
      i = lobe.wi;
      d.eta = lobe.eta;
      d.value += lobe.weight;
      d.probability += all.probabilities[k];
    }
    if (!(d.probability > 0) || is_black(d.value)) return false;
    d.wi = frame_->to_world(i);
    return consistent(wo, d.wi, o, i);
  }

  // |cos| to the shading normal, the factor of f in integrals over solid angle.
  float cosine(const Vec3& wi) const { return std::abs(glm::dot(frame_->z, wi)); }

 private:
  // Whether both normals agree on the side of wo and of wi. o and i are the same directions in the shading frame.
  bool consistent(const Vec3& wo, const Vec3& wi, const Vec3& o, const Vec3& i) const {
    return glm::dot(*ng_, wo) * o.z > 0 && glm::dot(*ng_, wi) * i.z > 0;
  }

  // Shading normals make scattering asymmetric: the adjoint BSDF contains this ratio of cosines [Veach 1997, eq. 5.19].
  float adjoint_factor(const Vec3& wo, const Vec3& wi, const Vec3& o, const Vec3& i, TransportMode mode) const {
    if (mode == TransportMode::radiance) return 1;
    return std::abs(o.z * glm::dot(*ng_, wi) / (i.z * glm::dot(*ng_, wo)));
  }

  const Frame* frame_ = nullptr;
  const Vec3* ng_ = nullptr;
};

}  // namespace etendue
