// Scattering at a vertex of a path through scattering media: the BSDF of a surface, or a phase function.
//
// A phase function has the interface of a BSDF whose cosine is 1. The scattering coefficient is part of the throughput
// that reaches the vertex (medium/free_flight.h).
#pragma once
#include "bsdf/bsdf.h"
#include "medium/phase_function.h"

namespace etendue {

template <class M>
  requires(M::kScattering)
class Bsdf<M> {
 public:
  using Color = typename M::Color;
  using Surface = Bsdf<typename M::Surfaces>;
  using Value = typename Surface::Value;

  // The BSDF of a surface vertex, to be set by the caller.
  Surface& begin_surface() {
    phase_ = nullptr;
    return surface_;
  }
  // `phase` must outlive the vertex.
  void set_volume(const PhaseFunction& phase) { phase_ = &phase; }
  bool in_volume() const { return phase_ != nullptr; }
  // The BSDF of a vertex that does not lie in a volume.
  const Surface& surface() const { return surface_; }
  // To be called after copying a vertex together with its point.
  void rebind(const Frame& shading, const Vec3& geometric_normal) { surface_.rebind(shading, geometric_normal); }

  bool has_non_delta_lobe() const { return in_volume() || surface_.has_non_delta_lobe(); }
  bool has_component(ScatterType type) const {
    return in_volume() ? type == ScatterType::volume : surface_.has_component(type);
  }

  Color eval(const Vec3& wo, const Vec3& wi, TransportMode mode = TransportMode::radiance) const {
    return in_volume() ? Color(phase_->eval(wo, wi)) : surface_.eval(wo, wi, mode);
  }
  float cosine(const Vec3& wi) const { return in_volume() ? 1 : surface_.cosine(wi); }

  Color eval_component(ScatterType type, const Vec3& wo, const Vec3& wi,
                       TransportMode mode = TransportMode::radiance) const {
    if (!in_volume()) return surface_.eval_component(type, wo, wi, mode);
    return type == ScatterType::volume ? Color(phase_->eval(wo, wi)) : Color(0);
  }

  float pdf(const Vec3& wo, const Vec3& wi, TransportMode mode = TransportMode::radiance) const {
    return in_volume() ? phase_->eval(wo, wi) : surface_.pdf(wo, wi, mode);
  }
  Value evaluate(const Vec3& wo, const Vec3& wi, TransportMode mode = TransportMode::radiance) const {
    if (!in_volume()) return surface_.evaluate(wo, wi, mode);
    const float p = phase_->eval(wo, wi);
    return {Color(p), p};
  }

  bool sample(const Vec3& wo, const LobeRandom& random, TransportMode mode, LobeSample<Color>& s) const {
    if (!in_volume()) return surface_.sample(wo, random, mode, s);
    s.wi = phase_->sample(wo, random.u);
    s.pdf_solid_angle = phase_->eval(wo, s.wi);
    s.weight = Color(1);
    s.type = ScatterType::volume;
    return true;
  }

  DeltaSet<Color> deltas(const Vec3& wo, TransportMode mode = TransportMode::radiance) const {
    return in_volume() ? DeltaSet<Color>() : surface_.deltas(wo, mode);
  }

 private:
  Surface surface_;
  const PhaseFunction* phase_ = nullptr;
};

}  // namespace etendue
