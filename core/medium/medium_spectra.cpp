#include "medium/medium_spectra.h"

namespace etendue {

AbsorptionSpectrum::AbsorptionSpectrum(const Rgb& absorption, std::shared_ptr<const CoefficientSpectrum> measured)
    : measured_(std::move(measured)) {
  scale_ = max_component(absorption);
  constant_ = absorption.r == absorption.g && absorption.g == absorption.b;
  if (constant_ || !(scale_ > 0)) return;
  transmittance_ = RgbSpectrum::reflectance(exponential_of(absorption / scale_));
}

SampledSpectrum AbsorptionSpectrum::at(const Wavelengths& wavelengths) const {
  return measured_ ? measured_->at(wavelengths) + of_rgb(wavelengths) : of_rgb(wavelengths);
}

SampledSpectrum AbsorptionSpectrum::of_rgb(const Wavelengths& wavelengths) const {
  if (constant_) return SampledSpectrum(scale_);
  SampledSpectrum absorption = transmittance_.at(wavelengths);
  for (float& value : absorption.values) value = -std::log(value) * scale_;
  return absorption;
}

}  // namespace etendue
