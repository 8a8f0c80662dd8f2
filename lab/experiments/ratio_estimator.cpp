// A biased but consistent estimator: the mean of a pixel with the weights of its filter normalised by their sum
// [Lang, eq. 6.151-6.156, corrected]
//
//   ratio     F_N = sum of w(X_i) f(X_i) / sum of w(X_i)       X uniform in the pixel
//   unbiased  F_N = (1/N) sum of w(X_i) f(X_i)
//
// The pixel is [0, 1], the filter the tent w(x) = 2 (1 - |2x - 1|). For f = x^2 the integral of w f is 7/24. The ratio has
// the mean 1/3 for N = 1, whatever the filter is. For large N its bias is 1/(45 N), so that its variance soon dominates
// its error. In an image of one value the ratio has no error, and the unbiased estimator has the variance 1/(3N).
#include <cmath>

#include "equations/random_numbers.h"
#include "experiments/error_curves.h"
#include "experiments/moments.h"

namespace etendue::experiments {

enum class PixelImage { square, flat };

}  // namespace etendue::experiments

template <>
struct etendue::Options<etendue::experiments::PixelImage> {
  static constexpr std::array<etendue::Option, 2> kOptions{{{"square", "x\u00b2"}, {"flat", "1"}}};
};

namespace etendue::experiments {
namespace {

struct RatioEstimator {
  static constexpr ExperimentDescription kDescription{
      .name = "ratio-estimator",
      .label = "A biased and consistent estimator",
      .summary = "Bias and error of the pixel mean with normalised filter weights, against the unbiased estimator",
      .source = "[Lang, eq. 6.128, 6.151]"};

  Choice<PixelImage> image{"image", "Image", PixelImage::square, "The radiance f in the pixel"};
  Number<int> samples{"samples", "Samples",         256, {2, 16384}, "Largest number of samples of a pixel",
                      "",        Scale::logarithmic};
  Number<int> repeats{
      "repeats", "Repeats",         16384, {256, 262144}, "Number of pixels. Higher shows a smaller bias",
      "",        Scale::logarithmic};
  auto parameters() { return std::tie(image, samples, repeats); }

  Result<ExperimentResult> run(const RunContext& context) const {
    const auto work = powers_of_two(0, static_cast<int>(std::log2(samples.value)));
    std::vector<Moments> ratio(work.size()), unbiased(work.size());
    for (int r = 0; r < repeats; ++r) {
      if (r % 64 == 0 && !context.proceed(static_cast<double>(r) / repeats)) return interrupted();
      add_pixel(mix_bits(context.seed) + static_cast<uint64_t>(r), work, ratio, unbiased);
    }
    return summary(work, ratio, unbiased);
  }

 private:
  double integral() const { return image == PixelImage::square ? 7.0 / 24 : 1; }

  void add_pixel(uint64_t seed, std::span<const double> work, std::vector<Moments>& ratio,
                 std::vector<Moments>& unbiased) const {
    equations::RandomNumbers random(seed);
    double weights = 0, products = 0;
    size_t k = 0;
    for (int i = 1; k < work.size(); ++i) {
      const double x = random.uniform(), w = 2 * (1 - std::abs(2 * x - 1));
      weights += w;
      products += w * (image == PixelImage::square ? x * x : 1);
      if (i != static_cast<int>(work[k])) continue;
      ratio[k].add(weights > 0 ? products / weights : 0);
      unbiased[k].add(products / i);
      ++k;
    }
  }

  static double rms_error(const Moments& moments, double integral) {
    const double bias = moments.mean() - integral;
    return std::sqrt(moments.variance() + bias * bias);
  }

  ExperimentResult summary(std::span<const double> work, const std::vector<Moments>& ratio,
                           const std::vector<Moments>& unbiased) const {
    ExperimentResult result;
    result.table.columns = {"samples", "bias of the ratio", "standard error", "RMS error of the ratio",
                            "RMS error of the unbiased estimator"};
    std::vector<double> ratio_errors, unbiased_errors, biases;
    for (size_t k = 0; k < work.size(); ++k) {
      biases.push_back(ratio[k].mean() - integral());
      ratio_errors.push_back(rms_error(ratio[k], integral()));
      unbiased_errors.push_back(rms_error(unbiased[k], integral()));
      result.table.rows.push_back({work[k], biases[k], ratio[k].mean_error(), ratio_errors[k], unbiased_errors[k]});
      result.checks.push_back({"mean of the unbiased estimator, N = " + metrics::short_number(work[k]),
                               unbiased[k].mean(), integral(), kStandardErrors * unbiased[k].mean_error()});
    }
    add_ratio_checks(work, ratio, result);
    result.charts = {
        ErrorChart{.title = "Error of two estimators of a pixel",
                   .work = "samples",
                   .curves = {error_curve("ratio", work, ratio_errors), error_curve("unbiased", work, unbiased_errors),
                              error_curve("bias of the ratio", work, biases)}}};
    return result;
  }

  void add_ratio_checks(std::span<const double> work, const std::vector<Moments>& ratio,
                        ExperimentResult& result) const {
    const auto add = [&](size_t k, double expected, double tolerance) {
      result.checks.push_back({"mean of the ratio, N = " + metrics::short_number(work[k]), ratio[k].mean(), expected,
                               kStandardErrors * ratio[k].mean_error() + tolerance});
    };
    if (image == PixelImage::flat) {
      for (size_t k = 0; k < work.size(); ++k) add(k, 1, 1e-12);
      return;
    }
    add(0, 1.0 / 3, 0);
    if (work.size() > 1) add(1, 0.3087353, 1e-7);
    // Terms beyond 1/N are below 1/N^2.
    for (size_t k = 4; k < work.size(); ++k) add(k, integral() + 1 / (45 * work[k]), 1 / (work[k] * work[k]));
  }
};

}  // namespace

Experiment ratio_estimator_experiment() { return make_experiment<RatioEstimator>(); }

}  // namespace etendue::experiments
