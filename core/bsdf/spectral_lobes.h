// The lobes of a surface at the wavelengths of a path.
//
// Lobes are built for RGB and converted (spectral_lobes.cpp): colours become spectra (spectrum/uplift.h), and
// indices of refraction of measured metals are taken at each wavelength. The types are hidden as in AllLobes<Rgb>.
#pragma once
#include "bsdf/all_lobes.h"
#include "spectrum/wavelengths.h"

namespace etendue {

// The functions are those of LobeSet (lobe_set.h).
template <>
class AllLobes<SampledSpectrum> {
 public:
  using Color = SampledSpectrum;

  AllLobes();

  // Replaces the lobes by those of an RGB surface. `wavelengths` must outlive the set at the same address.
  void assign(const AllLobes<Rgb>& lobes, const Wavelengths& wavelengths);
  // Replaces the lobes by a Lambertian one.
  void assign_lambertian(const Color& albedo);

  void clear();
  bool empty() const;
  int size() const;
  bool has_non_delta_lobe() const;
  float min_alpha() const;
  bool has_component(ScatterType type) const;
  Color eval(const Vec3& wo, const Vec3& wi, TransportMode mode) const;
  Color eval_component(ScatterType type, const Vec3& wo, const Vec3& wi, TransportMode mode) const;
  float pdf(const Vec3& wo, const Vec3& wi, TransportMode mode) const;
  bool sample(const Vec3& wo, const LobeRandom& random, TransportMode mode, LobeSample<Color>& s) const;
  void add_deltas(const Vec3& wo, TransportMode mode, DeltaSet<Color>& deltas) const;

  // Storage for the hidden set; spectral_lobes.cpp checks that it is large enough.
  static constexpr size_t kBytes = 1152, kAlignment = 8;

 private:
  friend struct SpectralLobesAccess;
  alignas(kAlignment) std::array<std::byte, kBytes> set_;
};

}  // namespace etendue
