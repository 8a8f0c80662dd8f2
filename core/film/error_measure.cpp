#include "film/error_measure.h"

#include <algorithm>
#include <cmath>

#include "base/number_text.h"

namespace etendue::film {
namespace {

struct MeasureText {
  const char* label;
  const char* description;
};

const MeasureText& text_of(ErrorMeasure measure) {
  static constexpr std::array<MeasureText, kErrorMeasures.size()> kTexts{
      {{"RMSE", "Root mean square error over pixels and channels, in the unit of the image"},
       {"relative error",
        "Root mean square of the error relative to the true value; 0.01 is added to the squared value"},
       {"displayed error",
        "Root mean square error of the displayed image, after exposure, tone mapping and sRGB encoding. 100 % is the "
        "difference between black and white"}}};
  return kTexts[static_cast<size_t>(measure)];
}

// With A and B the means of the half-buffers, the error of the mean is estimated by (A - B) / 2. If both have the same
// weight, A and B lie one estimated error above and below the mean, so (d(A) - d(B)) / 2 is the central difference of
// the displayed value over this error.
RowError displayed_error_of_row(const Film& film, const DisplayTransform& display, int y) {
  RowError row;
  RowSum sum(row.absolute);
  for (int x = 0; x < film.width(); ++x) {
    const Film::Pixel& p =
        film.pixels()[static_cast<size_t>(y) * static_cast<size_t>(film.width()) + static_cast<size_t>(x)];
    if (p.count[0] == 0 || p.count[1] == 0) return {.absolute = {}, .known = false};
    const Rgb a = display(film.half_buffer_mean(x, y, 0));
    const Rgb b = display(film.half_buffer_mean(x, y, 1));
    double squares = 0;
    for (int c = 0; c < 3; ++c) squares += sqr(double{a[c]} - double{b[c]});
    sum.add(0.25 * squares);
    row.has_light = row.has_light || !is_black(film.mean(x, y));
  }
  return row;
}

MeasuredError relative_error_of(const Film& film, const RangeRunner& run) {
  const std::optional<RelativeError> e = relative_error(film, run);
  if (!e) return {};
  const auto has_light = [](const Film::Pixel& p) {
    return std::ranges::any_of(p.sum, [](const auto& sum) { return sum != std::array<double, 3>{}; });
  };
  if (e->relmse == 0 && std::ranges::none_of(film.pixels(), has_light)) return {};
  return {.value = std::sqrt(e->relmse),
          .interval = {std::sqrt(e->interval.low), std::sqrt(e->interval.high)},
          .variation = e->root_variation,
          .known = true};
}

}  // namespace

const char* measure_label(ErrorMeasure measure) { return text_of(measure).label; }
const char* measure_description(ErrorMeasure measure) { return text_of(measure).description; }

std::string error_text(ErrorMeasure measure, double error) {
  const double value = measure == ErrorMeasure::rmse ? error : 100 * error;
  // Without an exponent, which %g uses from 100 on.
  const std::string digits = format_text(value < 99.5 ? "%.2g" : "%.0f", value);
  return measure == ErrorMeasure::rmse ? digits : digits + " %";
}

MeasuredError measured_rmse(const ErrorEstimate& error) {
  return {
      .value = error.rmse, .interval = error.rmse_interval, .variation = error.rmse_variation, .known = error.known};
}

MeasuredError measured_error(const Film& film, ErrorMeasure measure, const DisplayTransform& display,
                             const RangeRunner& given_run) {
  const auto run_here = [](int count, const std::function<void(int, int)>& task) {
    task(0, count);
    return true;
  };
  const RangeRunner run = given_run ? given_run : RangeRunner(run_here);
  if (measure == ErrorMeasure::relative) return relative_error_of(film, run);
  std::vector<RowError> rows(static_cast<size_t>(film.height()));
  const auto measure_rows = [&](int first, int end) {
    for (int y = first; y < end; ++y)
      rows[static_cast<size_t>(y)] =
          measure == ErrorMeasure::rmse ? film.error_of_row(y) : displayed_error_of_row(film, display, y);
  };
  if (!run(film.height(), measure_rows)) return {};
  return measured_rmse(film.error(rows));
}

}  // namespace etendue::film
