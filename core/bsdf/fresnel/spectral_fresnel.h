// The Fresnel term of microfacets at the wavelengths of a path.
//
// Constants of a measured metal (metal_spectra.h) and constants that are equal for all colours are evaluated per
// wavelength. Other RGB constants determine RGB reflectances, whose spectra are used.
#pragma once
#include "bsdf/fresnel/fresnel_term.h"
#include "bsdf/fresnel/metal_spectra.h"
#include "spectrum/uplift.h"

namespace etendue {

template <>
struct FresnelTerm<SampledSpectrum> {
  FresnelTerm<Rgb> rgb;
  const Wavelengths* wavelengths = nullptr;
  bool per_wavelength = false;
  SampledSpectrum eta, kappa;  // if `per_wavelength`

  static FresnelTerm of(const FresnelTerm<Rgb>& rgb, const Wavelengths& wavelengths) {
    FresnelTerm term;
    term.rgb = rgb;
    term.wavelengths = &wavelengths;
    const auto grey = [](const Rgb& c) { return c.r == c.g && c.g == c.b; };
    const MetalSpectrum* metal = find_metal_spectrum(rgb.eta, rgb.kappa);
    term.per_wavelength = metal || (grey(rgb.eta) && grey(rgb.kappa));
    for (int i = 0; term.per_wavelength && i < SampledSpectrum::kSize; ++i) {
      const float wavelength = wavelengths.nm[static_cast<size_t>(i)];
      term.eta[i] = metal ? metal->eta(wavelength) : rgb.eta.r;
      term.kappa[i] = metal ? metal->kappa(wavelength) : rgb.kappa.r;
    }
    return term;
  }

  SampledSpectrum operator()(float cosine) const {
    if (rgb.kind == FresnelKind::one) return SampledSpectrum(1);
    if (!per_wavelength) return uplift_reflectance(rgb(cosine), *wavelengths);
    SampledSpectrum f;
    for (int i = 0; i < SampledSpectrum::kSize; ++i) f[i] = rgb.component(cosine, eta[i], kappa[i]);
    return f;
  }
};

}  // namespace etendue
