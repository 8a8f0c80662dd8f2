// An RGB lobe whose values are converted to spectra.
//
// The conversion of a value keeps its largest component as the bound of all wavelengths, so that the lobe gains no
// energy. Directions and densities are those of the RGB lobe.
#pragma once
#include "bsdf/lobe_set.h"
#include "spectrum/uplift.h"

namespace etendue {

template <class Lobe>
struct UpliftedLobe {
  using Color = SampledSpectrum;

  Lobe lobe;
  const Wavelengths* wavelengths = nullptr;

  bool is_delta() const { return lobe.is_delta(); }
  bool has_component(ScatterType type) const { return lobe.has_component(type); }
  float sampling_weight(const Vec3& wo) const { return lobe.sampling_weight(wo); }
  float alpha() const { return alpha_of(lobe); }

  Color eval(const Vec3& wo, const Vec3& wi, TransportMode mode) const { return uplifted(lobe.eval(wo, wi, mode)); }
  Color eval_component(ScatterType type, const Vec3& wo, const Vec3& wi, TransportMode mode) const {
    return uplifted(lobe.eval_component(type, wo, wi, mode));
  }
  float pdf(const Vec3& wo, const Vec3& wi, TransportMode mode) const { return lobe.pdf(wo, wi, mode); }

  bool sample(const Vec3& wo, const LobeRandom& random, TransportMode mode, LobeSample<Color>& s) const {
    LobeSample<Rgb> rgb;
    if (!lobe.sample(wo, random, mode, rgb)) return false;
    s = {rgb.wi, uplifted(rgb.weight), rgb.pdf_solid_angle, rgb.eta, rgb.type, rgb.delta, rgb.transmitted};
    return true;
  }

  void add_deltas(const Vec3& wo, TransportMode mode, DeltaSet<Color>& deltas) const {
    DeltaSet<Rgb> rgb;
    lobe.add_deltas(wo, mode, rgb);
    for (size_t k = 0; k < static_cast<size_t>(rgb.count); ++k) {
      const LobeSample<Rgb>& s = rgb.lobes[k];
      if (s.transmitted)
        deltas.add_transmission(s.wi, uplifted(s.weight), s.eta, rgb.probabilities[k]);
      else
        deltas.add_reflection(s.wi, uplifted(s.weight), rgb.probabilities[k]);
    }
  }

 private:
  Color uplifted(const Rgb& value) const { return uplift_scaled(value, *wavelengths); }
};

}  // namespace etendue
