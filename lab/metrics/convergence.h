// Convergence curves: error as a function of time or samples, and the statistics derived from them. Nothing here
// renders.
//
// A curve is one repeat of one method: its error against a reference at increasing times and sample counts. Error bars
// come from the spread of several repeats with different seeds. The points of a single curve cannot provide them: they
// are running sums of the same samples, so their errors are correlated.
//
// Errors are means over pixels and channels (metrics/metrics.h): the squares of the three measures of
// film/error_measure.h, and the bias in the unit of the image.
#pragma once
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "film/error_measure.h"
#include "metrics/line_fit.h"

namespace etendue::metrics {

struct ErrorPoint {
  double seconds = 0;  // rendering time
  double spp = 0;      // samples per pixel
  double mse = 0, relmse = 0;
  double bias = 0;           // mean of image - reference
  double displayed_mse = 0;  // of the displayed values

  // The root mean square error in a measure.
  double error(film::ErrorMeasure measure) const;
};

struct ErrorCurve {
  int repeat = 0;
  std::vector<ErrorPoint> points;  // by increasing seconds and spp
};

struct MethodCurves {
  std::string name;
  std::vector<ErrorCurve> repeats;
};

enum class Abscissa { seconds, samples };

// --- Error of the reference ----------------------------------------------------------------------------------------

// The squared standard error of the reference, averaged over pixels and channels; for relmse each term is divided by
// r^2 + 0.01.
struct ReferenceNoise {
  double mse = 0, relmse = 0, displayed_mse = 0;
  double relative_error = 0;  // relative standard error of `mse`, as far as it follows from the variances of the values

  // The root of the noise in a measure.
  double error(film::ErrorMeasure measure) const;
};

// If image and reference are independent, a measured MSE is the sum of the image's MSE and that of the reference.
// Subtracts the latter. A point whose error does not exceed that of the reference becomes zero; the fits ignore it.
ErrorPoint without_noise(ErrorPoint measured, const ReferenceNoise& noise);
MethodCurves without_noise(const MethodCurves& method, const ReferenceNoise& noise);

// The smallest RMSE that the reference determines within 5 %. With m the MSE of an image, r that of the reference and d the
// relative error of r, the corrected MSE has the variance d^2 (r^2 + 2 m r): the first term is the error of r, the second
// the product of both noises. It is at least the standard error of the reference.
double smallest_certain_rmse(const ReferenceNoise& noise);

// True if an RMSE on the corrected curves is smaller than that.
bool is_reference_too_noisy(const MethodCurves& corrected, const ReferenceNoise& noise);

// --- Interpolation and bands ---------------------------------------------------------------------------------------

// `count` numbers from first to last in equal ratios, both ends included. 0 < first <= last, count >= 2.
std::vector<double> log_grid(double first, double last, int count);

// The repeats whose last point lies at nine tenths of the longest one's abscissa or beyond it. Medians and slopes use
// these alone, along the whole curve, so that a repeat that ended early or is still running does not bend the curve.
MethodCurves complete_repeats(const MethodCurves& method, Abscissa abscissa);

// The abscissas at which all complete repeats have an error above zero; nothing without such points.
struct Range {
  double first, last;
};
std::optional<Range> abscissa_range(const MethodCurves& method, Abscissa abscissa, film::ErrorMeasure measure);

// The error at `x`, interpolated linearly between the logarithms of the neighbouring points; nothing outside the curve.
std::optional<double> error_at(const ErrorCurve& curve, Abscissa abscissa, film::ErrorMeasure measure, double x);

// Median and 10 % to 90 % quantiles over the complete repeats, at the abscissas that all of them reach.
struct BandPoint {
  double x, low, median, high;
};
std::vector<BandPoint> error_band(const MethodCurves& method, Abscissa abscissa, film::ErrorMeasure measure,
                                  std::span<const double> grid);

// The last point of the curve that a chart draws, and the medians of the complete repeats at their ends.
struct CurveEnd {
  std::optional<BandPoint> point;  // none if no error is left after subtraction of the reference's noise
  double seconds = 0, spp = 0;
  size_t repeats = 0;  // number of complete repeats
};
CurveEnd curve_end(const MethodCurves& method, Abscissa abscissa, film::ErrorMeasure measure);

// The q-quantile, 0 <= q <= 1, interpolated linearly between order statistics; NaN for no values.
double quantile(std::vector<double> values, double q);

// --- Statistics over repeats ---------------------------------------------------------------------------------------

// A mean over repeats and its standard error. The 95 % confidence interval is value +- t(degrees) * standard_error with
// Student's t distribution. With a single repeat `degrees` is 0 and the standard error is meaningless.
struct Estimate {
  double value = 0, standard_error = 0;
  int degrees = 0;  // degrees of freedom
  bool known = false;
};
Estimate estimate_of(std::span<const double> values);

// The slope of the logarithm of the error over log time or log samples: -1/2 for Monte Carlo, steeper for quasi-Monte Carlo, zero where
// only bias remains. A weighted line is fitted to each repeat; the slopes are averaged over repeats. The weight of a
// point is the length of the logarithmic axis it represents, so that densely sampled ends do not dominate. On corrected
// curves it is reduced by the uncertainty of the correction. For one repeat the standard error is that of the line fit,
// which ignores correlation and is too small; `degrees` is 0 to mark this.
Estimate slope_of(const MethodCurves& corrected, Abscissa abscissa, const ReferenceNoise& noise = {},
                  film::ErrorMeasure measure = film::ErrorMeasure::rmse);

// 1 over the mean of squared error * seconds at the end of the repeats. For Monte Carlo it does not depend on their duration.
// Averaging the inverses instead would favour methods with scattered errors. Unknown if no error is left.
Estimate efficiency_of(const MethodCurves& corrected, film::ErrorMeasure measure = film::ErrorMeasure::rmse);

// The mean bias at the end of the repeats. `reference_error` is the standard error of the mean of the reference image.
// All repeats share it, so it is added in quadrature to the standard error.
Estimate bias_of(const MethodCurves& method, double reference_error = 0);

// The MSE separated into bias and variance by means of the average image of N repeats:
//   variance = (M1 - MN) N / (N - 1),   bias^2 = (N MN - M1) / (N - 1) - noise
// with M1 the mean over repeats of the MSE and MN the MSE of the average image. Both estimates may be negative by
// chance. Nothing for fewer than two repeats.
struct BiasVariance {
  double squared_bias, variance;
};
std::optional<BiasVariance> bias_and_variance(double mean_mse, double mse_of_mean, int repeats,
                                              const ReferenceNoise& noise = {});

}  // namespace etendue::metrics
