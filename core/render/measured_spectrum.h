// The spectrum of the light that a rendered image shows, measured with spectral paths.
//
// Each path contributes its radiance at four wavelengths. The mean over the paths is taken for each interval of 5 nm.
// Luminance and radiance are integrals of this spectrum, the luminance with V(lambda).      [Lang, sec. 3.4]
#pragma once
#include <array>
#include <functional>
#include <memory>

#include "base/result.h"
#include "render/document.h"
#include "spectrum/observer.h"

namespace etendue::render {

struct MeasuredSpectrum {
  static constexpr size_t kBins = kWavelengths - 1;  // between the wavelengths of the tables of the observer

  // Spectral radiance in W/(m^2 sr nm), the mean of each interval, and its standard error.
  std::array<double, kBins> radiance{}, standard_error{};
  uint32_t samples = 0;  // per pixel

  static double wavelength(size_t bin) { return table_wavelength(bin) + kWavelengthStep / 2; }  // nm, its middle
  // In W/(m^2 sr), from 380 to 780 nm.
  double total_radiance() const;
  // In cd/m^2.
  double luminance() const;
  // Lumens per watt; 0 for a black spectrum.
  double luminous_efficacy() const;
  // The spectrum times a factor.
  MeasuredSpectrum times(double factor) const;
};

// Measures all pixels of a document together, with spectral rendering. The integrator is that of the document if it
// renders spectra, else path tracing. An error says why the scene cannot be rendered, or that `keep_going` returned
// false.
Result<MeasuredSpectrum> measure_spectrum(
    Document document, std::shared_ptr<const scene::CompiledScene> scene, uint32_t samples,
    const std::function<bool()>& keep_going = [] { return true; });

}  // namespace etendue::render
