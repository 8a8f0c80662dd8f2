// Curves of error over time: what they are, and what is read off them. Data and mathematics; nothing here renders.
//
// A curve is one repeat of one method: its error against a reference after so many seconds and samples. Several repeats
// with seeds of their own tell what is chance: all error bars come from their spread, because the points of one curve
// are sums of the same samples and err together.                                      design: accuracy
//
// Errors are as in measure/metrics.h: mse in squared radiance, relmse without unit, bias in radiance, over pixels and
// channels, on linear pixels.
#pragma once
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "metrics/line_fit.h"

namespace etendue::metrics {

struct ErrorPoint {
  double seconds = 0;  // of rendering
  double spp = 0;
  double mse = 0, relmse = 0;
  double bias = 0;  // mean of image - reference
};

struct ErrorCurve {
  int repeat = 0;
  std::vector<ErrorPoint> points;  // seconds and spp grow
};

struct MethodCurves {
  std::string name;
  std::vector<ErrorCurve> repeats;
};

enum class Abscissa { seconds, samples };
enum class ErrorKind { rmse, relmse };

// --- The reference's own error -------------------------------------------------------------------------------------

// The mean squared standard error of the reference, over pixels and channels; relmse divides by r^2 + 0.01 first.
struct ReferenceNoise {
  double mse = 0, relmse = 0;
};

// A measured MSE is the image's plus the reference's, if they are independent: the latter is taken off. What is left of
// a point whose error is not above the reference's is zero, and the fits leave it out.
ErrorPoint without_noise(ErrorPoint measured, const ReferenceNoise& noise);
MethodCurves without_noise(const MethodCurves& method, const ReferenceNoise& noise);

// Whether the smallest RMSE on the corrected curves is not at least ten times the reference's standard error: too noisy
// a reference to tell.
bool too_noisy(const MethodCurves& corrected, const ReferenceNoise& noise);

// --- Reading curves ------------------------------------------------------------------------------------------------

// `count` numbers from first to last in equal ratios, both included. 0 < first <= last, count >= 2.
std::vector<double> log_grid(double first, double last, int count);

// The least and the largest positive abscissa with an error above zero on any of the curves; nothing without points.
struct Span {
  double first, last;
};
std::optional<Span> span_of(const MethodCurves& method, Abscissa along);

// The error at `x` by a straight line between the logarithms of its neighbours; nothing beyond the ends. rmse is the
// root of mse; relmse is as it is.
std::optional<double> error_at(const ErrorCurve& curve, Abscissa along, ErrorKind kind, double x);

// Median and 10 % to 90 % of the repeats, at those abscissas that at least half of them reach.
struct BandPoint {
  double x, low, median, high;
};
std::vector<BandPoint> band_of(const MethodCurves& method, Abscissa along, ErrorKind kind,
                               std::span<const double> grid);

// The q-quantile, 0 <= q <= 1, by a straight line between order statistics; NaN of nothing.
double quantile(std::vector<double> values, double q);

// --- Reading figures -----------------------------------------------------------------------------------------------

// A figure and its standard error over repeats. An interval of 95 % is value +- t(degrees) * standard_error of
// Student's distribution. Without repeats to tell, degrees is 0 and the standard error means nothing.
struct Figure {
  double value = 0, standard_error = 0;
  int degrees = 0;
  bool known = false;
};
Figure figure_of(std::span<const double> values);

// The slope of log RMSE against the logarithm of time or samples: -1/2 for Monte Carlo, steeper for quasi-Monte Carlo,
// flat where a bias is all that is left. A weighted line through each repeat, then the mean over repeats. Points weigh
// as much as the piece of the logarithmic axis they stand for: dense ends do not rule; and, of corrected curves, as
// much less as the correction made them uncertain. With one repeat the standard error is that of the line, which
// knows of no correlation: too small, and degrees is 0 to say so.
Figure slope_of(const MethodCurves& corrected, Abscissa along, const ReferenceNoise& noise = {});

// 1 over the mean of MSE * seconds at the end of the repeats: for Monte Carlo it does not depend on how long they ran.
// The mean of the inverses would favour methods whose errors scatter. Unknown where no error is left.
Figure efficiency_of(const MethodCurves& corrected);

// The bias at the end of each repeat. `reference_error` is the standard error of the reference's mean over the image,
// which all repeats share; it is added to the standard error.
Figure bias_of(const MethodCurves& method, double reference_error = 0);

// MSE split in two by the mean image of N repeats:
//   variance = (M1 - MN) N / (N - 1),   bias^2 = (N MN - M1) / (N - 1) - noise
// with M1 the mean over repeats of the MSE, MN the MSE of the mean image. Both estimates may come out below zero by
// chance. Nothing for fewer than two repeats.
struct Split {
  double squared_bias, variance;
};
std::optional<Split> split(double mean_mse, double mse_of_mean, int repeats, const ReferenceNoise& noise = {});

}  // namespace etendue::metrics
