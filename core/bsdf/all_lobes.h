// A set of lobes of any type, for glTF extensions beyond the standard lobes and for the BSDF models of the registry.
//
// The lobe types are hidden behind functions that are not inlined (all_lobe_types.h), so that editing a BSDF model
// recompiles no integrator. Scenes whose surfaces need fewer types use StandardLobes or DiffuseOnly (lobe_set.h), whose
// functions are inlined.
#pragma once
#include <array>
#include <cstddef>

#include "bsdf/lobe.h"
#include "spectrum/rgb.h"

namespace etendue {

template <class Color>
class AllLobes;

// The functions are those of LobeSet (lobe_set.h).
template <>
class AllLobes<Rgb> {
 public:
  using Color = Rgb;

  AllLobes();

  void clear();
  bool empty() const;
  int size() const;
  void set_relative_eta(float eta, float outside_eta);
  void keep_deltas(bool deltas);
  bool has_non_delta_lobe() const;
  float min_alpha() const;
  bool has_component(ScatterType type) const;
  Rgb eval(const Vec3& wo, const Vec3& wi, TransportMode mode) const;
  Rgb eval_component(ScatterType type, const Vec3& wo, const Vec3& wi, TransportMode mode) const;
  float pdf(const Vec3& wo, const Vec3& wi, TransportMode mode) const;
  bool sample(const Vec3& wo, const LobeRandom& random, TransportMode mode, LobeSample<Rgb>& s) const;
  void add_deltas(const Vec3& wo, TransportMode mode, DeltaSet<Rgb>& deltas) const;

  // Storage for the hidden set; all_lobes.cpp checks that it is large enough.
  static constexpr size_t kBytes = 864, kAlignment = 8;

 private:
  friend struct AllLobesAccess;
  alignas(kAlignment) std::array<std::byte, kBytes> set_;
};

// Whether f changes when both directions turn about the normal by the same angle, as it does for anisotropic surfaces.
// Tested by nine pairs of directions: a change of less than 1 % is not found.
bool depends_on_azimuth(const AllLobes<Rgb>& lobes);

}  // namespace etendue
