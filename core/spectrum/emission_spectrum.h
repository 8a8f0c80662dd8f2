// Spectra of emitters: illuminants, black bodies and measured spectra, by name.
//
// A spectrum gives an emitter its distribution over the wavelengths; the scale comes from the emitter. Spectra are
// relative to illuminant D65, as all spectral quantities of paths (wavelengths.h), and scaled to a luminance of 1.
#pragma once
#include <memory>
#include <string>
#include <string_view>

#include "base/parameter.h"
#include "spectrum/named_spectra.h"
#include "spectrum/spectrum.h"
#include "spectrum/wavelength_table.h"

namespace etendue {

class EmissionSpectrum {
 public:
  // `spectrum` must not be black between 380 and 780 nm.
  explicit EmissionSpectrum(const Spectrum& spectrum);

  // The linear sRGB value, which RGB rendering uses. Its luminance is 1 unless a component lies outside the gamut:
  // negative components are 0.
  const Rgb& rgb() const { return rgb_; }

  // The spectrum relative to D65, linear between whole nanometres.
  SampledSpectrum at(const Wavelengths& wavelengths) const { return values_.at(wavelengths); }
  // In nm.
  float at(float wavelength) const { return values_.at(wavelength); }

  // The spectrum of an emitter whose RGB value is `emitted`, that of this spectrum times a factor. A factor with a
  // colour, of a texture or tint, is a smooth spectrum (uplift.h).
  SampledSpectrum emission(const Rgb& emitted, const Wavelengths& wavelengths) const;

 private:
  Rgb factor_of(const Rgb& emitted) const;

  WavelengthTable values_;
  Rgb rgb_{1};
};

// The spectrum of an emitter; none if the name is kNoSpectrum.
struct EmissionSpectrumRef : NamedSpectrum<EmissionSpectrum> {
  // The linear sRGB value of an emitter with this colour.
  Rgb applied_to(const Rgb& color) const { return spectrum ? color * spectrum->rgb() : color; }
};

// Stands for an emitter whose spectrum follows from its RGB colour.
inline constexpr const char* kNoSpectrum = "none";

// kNoSpectrum, or a name of find_spectrum (spectrum_names.h).
Result<EmissionSpectrumRef> find_emission_spectrum(std::string_view name);
// The same; no spectrum if the name is not valid.
EmissionSpectrumRef emission_spectrum_or_none(std::string_view name);

// The parameter of an emitter that names its spectrum.
Text emission_spectrum_parameter(const char* name, const EmissionSpectrumRef& value);

}  // namespace etendue
