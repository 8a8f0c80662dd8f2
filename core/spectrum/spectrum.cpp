#include "spectrum/spectrum.h"

#include <algorithm>
#include <cctype>
#include <cmath>
#include <limits>

#include "base/file.h"
#include "base/number_text.h"
#include "spectrum/blackbody.h"

namespace etendue {
namespace {

// Lumens per watt at the wavelength of the largest sensitivity.
constexpr double kLargestEfficacy = 683;

Result<void> check_samples(const std::vector<Spectrum::Sample>& samples) {
  if (samples.size() < 2) return input_error("has fewer than two samples; give a wavelength in nm and a value per row");
  for (size_t i = 0; i < samples.size(); ++i) {
    const auto& [wavelength, value] = samples[i];
    const std::string where = "sample " + std::to_string(i + 1);
    if (!std::isfinite(wavelength) || wavelength <= 0)
      return input_error(where + ": the wavelength has to be a finite number above 0, in nm");
    const std::string at = where + ", " + format_number(wavelength, 6) + " nm";
    if (!std::isfinite(value)) return input_error(at + ": the value is not a finite number");
    if (value < 0) return input_error(at + ": the value " + format_number(value) + " is negative; give 0 or more");
    if (i > 0 && wavelength == samples[i - 1].wavelength)
      return input_error(at + ": the wavelength occurs twice; give each wavelength once");
    if (i > 0 && wavelength < samples[i - 1].wavelength)
      return input_error(at + ": the wavelength is smaller than that of the sample before it; sort by wavelength");
  }
  return {};
}

// Reads a number from the start of `text` and removes it. False if there is none. Understands "nan" and "inf".
bool take_number(std::string& text, double& number) {
  const size_t start = text.find_first_not_of(" \t\r,;");
  if (start == std::string::npos) return false;
  const char* first = text.c_str() + start;
  char* end = nullptr;
  number = std::strtod(first, &end);
  if (end == first) return false;
  text.erase(0, static_cast<size_t>(end - text.c_str()));
  return true;
}

}  // namespace

Spectrum Spectrum::constant(double value) {
  Spectrum spectrum;
  spectrum.constant_ = value;
  return spectrum;
}

Result<Spectrum> Spectrum::blackbody(double kelvin) {
  if (!(kelvin >= kMinTemperature && kelvin <= kMaxTemperature))
    return usage_error("the temperature of a black body has to be from " + format_number(kMinTemperature, 6) + " to " +
                       format_number(kMaxTemperature, 6) + " K");
  Spectrum spectrum;
  spectrum.kelvin_ = kelvin;
  return spectrum;
}

Result<Spectrum> Spectrum::piecewise_linear(std::vector<Sample> samples) {
  if (const auto checked = check_samples(samples); !checked) return checked.error();
  Spectrum spectrum;
  spectrum.samples_ = std::move(samples);
  return spectrum;
}

double Spectrum::operator()(double wavelength) const {
  if (kelvin_ > 0) return blackbody_at(wavelength, kelvin_);
  if (samples_.empty()) return constant_;
  if (!(wavelength >= samples_.front().wavelength && wavelength <= samples_.back().wavelength)) return 0;
  auto after = std::ranges::upper_bound(samples_, wavelength, {}, &Sample::wavelength);
  if (after == samples_.end()) return samples_.back().value;
  const Sample &a = *(after - 1), &b = *after;
  const double t = (wavelength - a.wavelength) / (b.wavelength - a.wavelength);
  return a.value * (1 - t) + b.value * t;
}

std::pair<double, double> Spectrum::range() const {
  if (samples_.empty()) return {0, std::numeric_limits<double>::infinity()};
  return {samples_.front().wavelength, samples_.back().wavelength};
}

Xyz Spectrum::xyz() const { return xyz_of(*this); }

double Spectrum::luminous_efficacy() const {
  double power = 0;
  for (size_t i = 0; i < kWavelengths; ++i) {
    const bool at_end = i == 0 || i + 1 == kWavelengths;
    power += (*this)(table_wavelength(i)) * (at_end ? kWavelengthStep / 2 : kWavelengthStep);
  }
  return power > 0 ? kLargestEfficacy * xyz().y / power : 0;
}

std::array<double, 3> Spectrum::rgb() const {
  const Xyz color = xyz();
  if (!(color.y > 0)) return {};
  return rgb_of({color.x / color.y, 1, color.z / color.y});
}

Result<Spectrum> read_spectrum(const std::string& path) {
  const auto bytes = read_file(path);
  if (!bytes) return bytes.error();
  std::string text;
  text.reserve(bytes->size());
  for (const std::byte b : *bytes) text += static_cast<char>(b);
  std::vector<Spectrum::Sample> samples;
  bool has_names = false;
  size_t row = 0;
  for (size_t begin = 0; begin < text.size(); ++row) {
    const size_t end = std::min(text.find('\n', begin), text.size());
    std::string line = text.substr(begin, end - begin);
    begin = end + 1;
    const size_t first = line.find_first_not_of(" \t\r");
    if (first == std::string::npos || line[first] == '#') continue;
    Spectrum::Sample sample;
    if (take_number(line, sample.wavelength) && take_number(line, sample.value)) {
      samples.push_back(sample);
      continue;
    }
    if (has_names || !samples.empty())
      return input_error(path + ": row " + std::to_string(row + 1) +
                         " is not a wavelength and a value, separated by a comma");
    has_names = true;
  }
  auto spectrum = Spectrum::piecewise_linear(std::move(samples));
  if (!spectrum) return input_error(path + ": " + spectrum.error().message);
  return spectrum;
}

}  // namespace etendue
