// A set of lobes of any type: what the rarer glTF extensions and the BSDF models of the registry need.
//
// The lobe types are hidden (all_lobe_types.h), so that editing a BSDF model recompiles no integrator. Surfaces that
// need fewer types have sets of their own (lobe_set.h), whose functions are inlined.
#pragma once
#include <array>
#include <cstddef>

#include "bsdf/lobe.h"
#include "spectrum/rgb.h"

namespace etendue {

template <class Color>
class AllLobes;

// The functions are those of Mix (lobe_set.h).
template <>
class AllLobes<Rgb> {
 public:
  using Color = Rgb;

  AllLobes();

  void clear();
  bool empty() const;
  int size() const;
  bool has_non_delta_lobe() const;
  float min_alpha() const;
  bool has_component(ScatterType letter) const;
  Rgb eval(const Vec3& wo, const Vec3& wi, TransportMode mode) const;
  Rgb eval_component(ScatterType letter, const Vec3& wo, const Vec3& wi, TransportMode mode) const;
  float pdf(const Vec3& wo, const Vec3& wi, TransportMode mode) const;
  bool sample(const Vec3& wo, const LobeRandom& random, TransportMode mode, LobeSample<Rgb>& s) const;
  void add_deltas(const Vec3& wo, TransportMode mode, DeltaSet<Rgb>& deltas) const;

  static constexpr size_t kBytes = 864, kAlignment = 8;

 private:
  friend struct AllLobesAccess;
  alignas(kAlignment) std::array<std::byte, kBytes> set_;
};

// Whether f changes when both directions turn about the normal by the same angle.
bool depends_on_azimuth(const AllLobes<Rgb>& lobes);

}  // namespace etendue
