#include "film/error_measure.h"

#include <algorithm>
#include <cmath>

#include "base/number_text.h"
#include "film/relative_error.h"

namespace etendue::film {
namespace {

// Rows of the image per range in which the relative error is computed.
constexpr int kBandRows = 64;

struct MeasureText {
  const char* label;
  const char* description;
};

const MeasureText& text_of(ErrorMeasure measure) {
  static constexpr std::array<MeasureText, kErrorMeasures.size()> kTexts{
      {{"RMSE", "Root mean square error over pixels and channels, in the unit of the image"},
       {"relative error", "Root mean square of the error relative to the true value; 0.01 is added to the squared value"},
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
    const Film::Pixel& p = film.pixels()[static_cast<size_t>(y) * static_cast<size_t>(film.width()) +
                                         static_cast<size_t>(x)];
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
  const size_t values = film.pixels().size() * 3;
  std::vector<float> rgb(values), variance(values);
  std::vector<char> known(static_cast<size_t>(film.height()), 1);
  const auto copy_rows = [&](int first, int end) {
    for (int y = first; y < end; ++y)
      for (int x = 0; x < film.width(); ++x) {
        const size_t i = static_cast<size_t>(y) * static_cast<size_t>(film.width()) + static_cast<size_t>(x);
        const Film::Pixel& p = film.pixels()[i];
        if (p.count[0] == 0 || p.count[1] == 0) known[static_cast<size_t>(y)] = 0;
        const Rgb mean = film.mean(x, y), v = film.variance_of_mean(x, y);
        for (int c = 0; c < 3; ++c) {
          rgb[3 * i + static_cast<size_t>(c)] = mean[c];
          variance[3 * i + static_cast<size_t>(c)] = v[c];
        }
      }
  };
  if (!run(film.height(), copy_rows)) return {};
  const bool has_light = std::ranges::any_of(rgb, [](float v) { return v != 0; });
  if (!has_light || std::ranges::find(known, 0) != known.end()) return {};
  std::vector<RelativeErrorSum> sums(static_cast<size_t>((film.height() + kBandRows - 1) / kBandRows));
  const auto sum_bands = [&](int first, int end) {
    for (int band = first; band < end; ++band)
      sums[static_cast<size_t>(band)] =
          relative_error_of_rows(film.width(), film.height(), rgb, variance, band * kBandRows,
                                 std::min(film.height(), (band + 1) * kBandRows));
  };
  if (!run(static_cast<int>(sums.size()), sum_bands)) return {};
  const RelativeError e = relative_error(sums, static_cast<double>(values));
  return {.value = std::sqrt(e.relmse),
          .interval = {std::sqrt(e.interval.low), std::sqrt(e.interval.high)},
          .variation = e.root_variation,
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
  return {.value = error.rmse, .interval = error.rmse_interval, .variation = error.rmse_variation, .known = error.known};
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
