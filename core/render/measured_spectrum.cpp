#include "render/measured_spectrum.h"

#include <cmath>

#include "film/film.h"
#include "render/prepared_document.h"

namespace etendue::render {
namespace {

constexpr double kLargestEfficacy = 683;  // lm/W, at the wavelength of the largest sensitivity

// Integrals over the intervals between the wavelengths of the tables, by Simpson's rule.
template <class F>
double integral_over(size_t bin, F&& f) {
  const double a = table_wavelength(bin), b = a + kWavelengthStep;
  return kWavelengthStep / 6 * (f(a) + 4 * f((a + b) / 2) + f(b));
}

double visibility(double wavelength) { return observer_at(wavelength).y; }

// D65 of luminance 1 cd/m^2: the spectral radiance in W/(m^2 sr nm) of a value of 1 relative to D65.
double radiance_of_d65(double wavelength) {
  static const double scale = [] {
    double sum = 0;
    for (size_t i = 0; i < MeasuredSpectrum::kBins; ++i)
      sum += integral_over(i, [](double w) { return visibility(w) * d65_at(w); });
    return 1 / (kLargestEfficacy * sum);
  }();
  return scale * d65_at(wavelength);
}

// Weighted means of the samples in each interval, relative to D65 in its middle. The weight is one over the density of
// the wavelength.
class SpectralBins {
 public:
  void add(const integrator::SpectralSample& sample) {
    for (size_t i = 0; i < sample.wavelengths.nm.size(); ++i) {
      const double at = (static_cast<double>(sample.wavelengths.nm[i]) - kFirstWavelength) / kWavelengthStep;
      const size_t number = std::min(static_cast<size_t>(std::max(at, 0.0)), MeasuredSpectrum::kBins - 1);
      Bin& bin = bins_[number];
      const double d65 =
          d65_at(static_cast<double>(sample.wavelengths.nm[i])) / d65_at(MeasuredSpectrum::wavelength(number));
      const auto value = static_cast<double>(sample.radiance.values[i]) * d65;
      const auto weight = static_cast<double>(sample.wavelengths.inverse_pdf[i]);
      if (!std::isfinite(value)) continue;
      bin.weight += weight;
      bin.sum += weight * value;
      bin.squares += weight * value * value;
      bin.squared_weight += weight * weight;
    }
  }

  MeasuredSpectrum spectrum() const {
    MeasuredSpectrum s;
    for (size_t i = 0; i < bins_.size(); ++i) {
      const Bin& b = bins_[nearest_with_samples(i)];
      if (!(b.weight > 0)) continue;
      const double d65 = radiance_of_d65(MeasuredSpectrum::wavelength(i)), mean = b.sum / b.weight;
      const double variance = std::max(b.squares / b.weight - mean * mean, 0.0);
      s.radiance[i] = d65 * mean;
      s.standard_error[i] = d65 * std::sqrt(variance * b.squared_weight) / b.weight;
    }
    return s;
  }

 private:
  struct Bin {
    double weight = 0, sum = 0, squares = 0, squared_weight = 0;
  };

  // Few paths have wavelengths at the ends of the range: intervals without samples take the value of the nearest one
  // with samples, relative to D65.
  size_t nearest_with_samples(size_t bin) const {
    for (size_t distance = 0; distance < bins_.size(); ++distance) {
      if (bin >= distance && bins_[bin - distance].weight > 0) return bin - distance;
      if (bin + distance < bins_.size() && bins_[bin + distance].weight > 0) return bin + distance;
    }
    return bin;
  }

  std::array<Bin, MeasuredSpectrum::kBins> bins_;
};

// Adds one sample of all pixels; false if it was cancelled.
bool add_sample(const PreparedDocument& prepared, integrator::RenderState& state, uint32_t sample,
                const std::function<bool()>& keep_going, std::vector<integrator::SpectralSample>& samples) {
  using integrator::PixelBlock;
  std::array<Rgb, PixelBlock::kMostPixels> pixels;
  for (int y = 0; y < prepared.height(); y += PixelBlock::kHeight)
    for (int x = 0; x < prepared.width(); x += PixelBlock::kWidth) {
      const PixelBlock block = integrator::block_containing(x, y, prepared.width(), prepared.height(), sample);
      if (!state.sample(block, pixels, {.keep_going = &keep_going, .spectra = &samples})) return false;
    }
  return true;
}

}  // namespace

double MeasuredSpectrum::total_radiance() const {
  double sum = 0;
  for (const double value : radiance) sum += value * kWavelengthStep;
  return sum;
}

double MeasuredSpectrum::luminance() const {
  double sum = 0;
  for (size_t i = 0; i < kBins; ++i) sum += radiance[i] * integral_over(i, visibility);
  return kLargestEfficacy * sum;
}

double MeasuredSpectrum::luminous_efficacy() const {
  const double total = total_radiance();
  return total > 0 ? luminance() / total : 0;
}

MeasuredSpectrum MeasuredSpectrum::times(double factor) const {
  MeasuredSpectrum s = *this;
  for (double& value : s.radiance) value *= factor;
  for (double& value : s.standard_error) value *= factor;
  return s;
}

Result<MeasuredSpectrum> measure_spectrum(Document document, std::shared_ptr<const scene::CompiledScene> scene,
                                          uint32_t samples, const std::function<bool()>& keep_going) {
  document.method.color = transport::ColorMode::spectral;
  if (!integrator::find_integrator(document.method.integrator)->spectral) document.method.integrator = "path";
  PreparedDocument prepared(document, std::move(scene));
  if (!prepared.refusal().empty()) return usage_error("the spectrum cannot be measured: " + prepared.refusal());
  const auto state = prepared.begin(prepared.context());
  SpectralBins bins;
  std::vector<integrator::SpectralSample> of_sample;
  for (uint32_t i = 0; i < samples; ++i) {
    prepared.prepare_sampler(i / film::kHalfBuffers);
    of_sample.clear();
    if (!add_sample(prepared, *state, i, keep_going, of_sample))
      return usage_error("the measurement of the spectrum was cancelled");
    for (const integrator::SpectralSample& sample : of_sample) bins.add(sample);
  }
  MeasuredSpectrum spectrum = bins.spectrum();
  spectrum.samples = samples;
  return spectrum;
}

}  // namespace etendue::render
