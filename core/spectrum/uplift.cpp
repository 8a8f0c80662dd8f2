#include "spectrum/uplift.h"

#include <array>
#include <cstdint>

#include "spectrum/observer.h"
#include "spectrum/uplift_table.h"

namespace etendue {
namespace {

constexpr float kSigmoidStart = static_cast<float>(kFirstWavelength),
                kInverseSigmoidRange = static_cast<float>(1 / (kLastWavelength - kFirstWavelength));

// Interpolates the table.
class UpliftTable {
 public:
  UpliftTable() {
    for (size_t z = 0; z < uplift::kScales; ++z) scales_[z] = static_cast<float>(uplift::scale_at(z));
    for (size_t k = 0; k < kGuesses; ++k)
      guesses_[k] = static_cast<uint8_t>(interval_of(static_cast<float>(k) / (kGuesses - 1), 0));
  }

  SigmoidSpectrum at(const Rgb& color) const {
    const int largest = color.r >= color.g && color.r >= color.b ? 0 : color.g >= color.b ? 1 : 2;
    const float scale = color[largest];
    if (!(scale > 0)) return {0, 0, kBlack};
    const float to_node = (uplift::kRatios - 1) / scale;
    const float x = color[(largest + 1) % 3] * to_node, y = color[(largest + 2) % 3] * to_node;
    const size_t xi = std::min(static_cast<size_t>(x), uplift::kRatios - 2),
                 yi = std::min(static_cast<size_t>(y), uplift::kRatios - 2),
                 zi = interval_of(scale, guesses_[static_cast<size_t>(scale * (kGuesses - 1))]);
    const float fx = x - static_cast<float>(xi), fy = y - static_cast<float>(yi),
                fz = (scale - scales_[zi]) / (scales_[zi + 1] - scales_[zi]);
    std::array<float, 4> sum{};
    const auto add_row = [&](size_t dy, size_t dz, float weight) {
      const float* row = &uplift::kTable[uplift::table_index(static_cast<size_t>(largest), zi + dz, yi + dy, xi)];
      const float left = weight * (1 - fx), right = weight * fx;
      for (size_t k = 0; k < sum.size(); ++k) sum[k] += left * row[k] + right * row[4 + k];
    };
    add_row(0, 0, (1 - fy) * (1 - fz));
    add_row(1, 0, fy * (1 - fz));
    add_row(0, 1, (1 - fy) * fz);
    add_row(1, 1, fy * fz);
    return {sum[0], sum[1], sum[2]};
  }

 private:
  static constexpr size_t kGuesses = 1025;
  static constexpr float kBlack = -2000;  // S < 1e-7

  // The interval of the values of the largest component that contains `scale`, which is not before `guess`.
  size_t interval_of(float scale, size_t guess) const {
    while (guess + 2 < uplift::kScales && scales_[guess + 1] <= scale) ++guess;
    return guess;
  }

  std::array<float, uplift::kScales> scales_{};
  std::array<uint8_t, kGuesses> guesses_{};  // intervals of equidistant values
};

const UpliftTable& uplift_table() {
  static const UpliftTable table;
  return table;
}

bool is_grey(const Rgb& c) { return c.r == c.g && c.g == c.b; }

// A loop over the wavelengths that compilers vectorize.
SampledSpectrum sampled(const SigmoidSpectrum& spectrum, const Wavelengths& wavelengths) {
  SampledSpectrum result;
  for (size_t i = 0; i < result.values.size(); ++i) {
    const float t = (wavelengths.nm[i] - kSigmoidStart) * kInverseSigmoidRange;
    const float p = (spectrum.c0 * t + spectrum.c1) * t + spectrum.c2;
    result.values[i] = 0.5f + 0.5f * p / std::sqrt(1 + p * p);
  }
  return result;
}

}  // namespace

SigmoidSpectrum SigmoidSpectrum::of(const Rgb& color) { return uplift_table().at(color); }

float SigmoidSpectrum::operator()(float wavelength) const {
  const float t = (wavelength - kSigmoidStart) * kInverseSigmoidRange, p = (c0 * t + c1) * t + c2;
  return 0.5f + 0.5f * p / std::sqrt(1 + p * p);
}

RgbSpectrum RgbSpectrum::reflectance(const Rgb& color) {
  const auto unit = [](float x) { return x > 0 ? std::min(x, 1.0f) : 0.0f; };  // NaN becomes 0
  const Rgb c(unit(color.r), unit(color.g), unit(color.b));
  RgbSpectrum spectrum;
  spectrum.constant_ = is_grey(c);
  spectrum.scale_ = spectrum.constant_ ? c.r : 1;
  if (!spectrum.constant_) spectrum.shape_ = SigmoidSpectrum::of(c);
  return spectrum;
}

RgbSpectrum RgbSpectrum::relative_to(float scale, const Rgb& color) {
  if (!(scale > 0)) return {};
  RgbSpectrum spectrum = reflectance(color / scale);
  spectrum.scale_ *= scale;
  return spectrum;
}

RgbSpectrum RgbSpectrum::scaled(const Rgb& color) {
  RgbSpectrum constant;
  constant.scale_ = color.r;
  return is_grey(color) ? constant : relative_to(max_component(color), color);
}

RgbSpectrum RgbSpectrum::emission(const Rgb& color) {
  return is_grey(color) ? scaled(color) : relative_to(2 * max_component(color), color);
}

SampledSpectrum RgbSpectrum::at(const Wavelengths& wavelengths) const {
  return constant_ ? SampledSpectrum(scale_) : sampled(shape_, wavelengths) * scale_;
}

SampledSpectrum uplift_reflectance(const Rgb& color, const Wavelengths& wavelengths) {
  return RgbSpectrum::reflectance(color).at(wavelengths);
}
SampledSpectrum uplift_scaled(const Rgb& color, const Wavelengths& wavelengths) {
  return RgbSpectrum::scaled(color).at(wavelengths);
}
SampledSpectrum uplift_emission(const Rgb& color, const Wavelengths& wavelengths) {
  return RgbSpectrum::emission(color).at(wavelengths);
}

}  // namespace etendue
