// The measures in which the error of an image is stated: one list for limits, the status bar, recommendations, charts
// and the command line.
//
//   rmse       root of the mean of (x - r)^2, in the unit of the image
//   relative   root of the mean of (x - r)^2 / (r^2 + 0.01), the root of relMSE
//   displayed  root of the mean of (d(x) - d(r))^2; d is the displayed value, from 0 to 1: exposure, tone mapping and
//              sRGB encoding. Noise in clipped pixels does not count
//
// x is the image and r the truth; the means are over pixels and channels. Relative and displayed errors are fractions,
// which people read in per cent.
#pragma once
#include <array>
#include <functional>
#include <string>
#include <vector>

#include "base/parameter.h"
#include "film/film.h"
#include "film/relative_error.h"
#include "image/display.h"

namespace etendue::film {

enum class ErrorMeasure : uint8_t { rmse, relative, displayed };
inline constexpr std::array<ErrorMeasure, 3> kErrorMeasures{ErrorMeasure::rmse, ErrorMeasure::relative,
                                                            ErrorMeasure::displayed};

// "RMSE", "relative error" or "displayed error", as within a sentence.
const char* measure_label(ErrorMeasure measure);
// One sentence that defines the measure, for tooltips.
const char* measure_description(ErrorMeasure measure);
// The error with two significant digits: "0.012", or "1.2 %" for a fraction.
std::string error_text(ErrorMeasure measure, double error);

// How an image is displayed; the measure `displayed` depends on it.
struct DisplayTransform {
  float exposure = 0;  // EV
  image::ToneCurve curve = image::ToneCurve::none;

  Rgb operator()(const Rgb& radiance) const { return image::displayed(radiance, exposure, curve); }
  friend bool operator==(const DisplayTransform&, const DisplayTransform&) = default;
};

// The estimated error of an image in one of the measures.
struct MeasuredError {
  double value = 0;
  Interval interval;     // 95 % confidence
  double variation = 0;  // as ErrorEstimate::rmse_variation
  bool known = false;    // as ErrorEstimate::known
};
MeasuredError measured_rmse(const ErrorEstimate& error);

// Estimates the error from the two half-buffers. The result does not depend on `run`, which by default uses the calling
// thread. Unknown if it is interrupted. Per pixel and thread, `rmse` takes about 0.02 us, `displayed` 0.2 us, and
// `relative` 0.7 us.
MeasuredError measured_error(const Film& film, ErrorMeasure measure, const DisplayTransform& display,
                             const RangeRunner& run = {});

}  // namespace etendue::film

template <>
struct etendue::Options<etendue::film::ErrorMeasure> {
  static constexpr std::array<etendue::Option, 3> kOptions{
      {{"rmse", "RMSE"}, {"relative", "Relative error"}, {"displayed", "Displayed error"}}};
};
