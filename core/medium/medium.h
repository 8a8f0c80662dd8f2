// Participating media as a user edits them, and homogeneous media.                            [Lang, sec. 4.1.2]
#pragma once
#include <memory>

#include "medium/density_field.h"
#include "medium/medium_spectra.h"
#include "medium/phase_function.h"
#include "spectrum/emission_spectrum.h"
#include "spectrum/rgb.h"

namespace etendue {

// How the transmittance of a heterogeneous medium is estimated. All of them are unbiased.
enum class TransmittanceEstimator : uint8_t { delta, ratio, residual_ratio, regular };

template <>
struct Options<TransmittanceEstimator> {
  static constexpr std::array<Option, 4> kOptions{{{"delta", "Delta tracking"},
                                                   {"ratio", "Ratio tracking"},
                                                   {"residual-ratio", "Residual ratio tracking"},
                                                   {"regular", "Regular tracking"}}};
};

// A medium as a user edits it. The coefficients are probabilities per length, in 1/m.
struct MediumDescription {
  Rgb scattering{0};
  Rgb absorption{0};
  PhaseFunctionRef phase;
  // The source function of emission: the radiance of the medium where it is optically thick and does not scatter. The
  // emission coefficient is the product with the absorption coefficient.                      [Lang, sec. 4.1.2]
  Rgb emission{0};
  // Of the hottest part, kelvin; it gives `emission` the colour of a black body. 0: no dependence on the temperature.
  float temperature = 0;
  DensityRef density = {};  // factor on all coefficients; null in homogeneous media
  TransmittanceEstimator estimator = TransmittanceEstimator::residual_ratio;
  // Measured coefficients, which spectral rendering uses; the RGB coefficients are then those of the spectra.
  CoefficientSpectrumRef scattering_spectrum = {}, absorption_spectrum = {};

  // Sets a coefficient to a measured one, and its RGB value; a spectrum that is none only leaves the RGB value.
  void set_spectrum(Coefficient coefficient, const CoefficientSpectrumRef& spectrum);
  // `additional` is further absorption, 1/m.
  MediumSpectra spectra(const Rgb& additional) const;

  bool has_spectrum() const { return scattering_spectrum || absorption_spectrum; }
  bool scatters() const { return !is_black(scattering); }
  bool emits() const { return !is_black(emission) && !is_black(absorption); }
  bool is_heterogeneous() const { return density && !is_clear(); }
  // Whether paths through it need more than Beer's law.
  bool is_volume() const { return scatters() || emits() || is_heterogeneous(); }
  // Whether light passes it as it passes a vacuum.
  bool is_clear() const { return is_black(scattering) && is_black(absorption); }
  friend bool operator==(const MediumDescription&, const MediumDescription&) = default;
};

// A medium in the form that rendering reads.
struct HomogeneousMedium : MediumCoefficients<Rgb> {
  MediumSpectra spectra;
  std::shared_ptr<const EmissionSpectrum> blackbody;  // multiplies the emission; null if it has no temperature
  std::shared_ptr<const PhaseFunction> phase;

  HomogeneousMedium() = default;
  // `additional` is further absorption, 1/m.
  explicit HomogeneousMedium(const MediumDescription& m, const Rgb& additional = Rgb(0));

  // The coefficients at the wavelengths of a path.
  MediumCoefficients<SampledSpectrum> at(const Wavelengths& wavelengths) const;
};

}  // namespace etendue
