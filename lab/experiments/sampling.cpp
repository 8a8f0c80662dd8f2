// Samples of a density by inversion, transformation, rejection and Metropolis sampling, and their histogram
// [Lang, sec. 6.3]
//
//   inversion       X = F^-1(U); in two dimensions the marginal, then the conditional distribution
//   transformation  a function of variables that are easily sampled
//   rejection       X uniform, accepted with probability p(X) / M; the acceptance rate is 1/M for p <= M
//   Metropolis      X' uniform in a square around X, accepted with probability min(1, p(X') / p(X)); after a rejection the
//                   old state counts again
//
// The chi-square test compares the histogram with integrals of the density. Its p value is uniform in [0, 1] if the
// samples are independent and have the density. The states of a Markov chain are correlated: every k-th state is counted
// (`thinning`). With a small `step` the chain moves too little between two counts, or does not cross the gap between
// two peaks, and the p value becomes zero.
//
// A second chart shows the first samples of a density in two dimensions.
//
// In theory, the share of accepted proposals of a stationary chain is the integral of min(p(x), p(x')) over x and over x'
// in the square around x, divided by the area of the square. The value in the table is computed with quasi-random points.
#include <optional>

#include "equations/pearson_test.h"
#include "experiments/densities.h"
#include "experiments/experiment.h"
#include "experiments/moments.h"
#include "experiments/uniform_points.h"

namespace etendue::experiments {

enum class SamplingMethod { inversion, transformation, rejection, metropolis };

}  // namespace etendue::experiments

template <>
struct etendue::Options<etendue::experiments::SamplingMethod> {
  static constexpr std::array<etendue::Option, 4> kOptions{{{"inversion", "Inversion"},
                                                            {"transformation", "Transformation"},
                                                            {"rejection", "Rejection"},
                                                            {"metropolis", "Metropolis"}}};
};

namespace etendue::experiments {
namespace {

constexpr int kBins1D = 50, kBins2D = 16;  // per axis
constexpr size_t kShownPoints = 1000;      // of a density in two dimensions
constexpr int kBatches = 32;               // of proposals, for the standard error of the acceptance rate

// Counts of samples in cells of equal size, and the integrals of the density over them.
class DensityHistogram {
 public:
  explicit DensityHistogram(const SampledDensity& density)
      : density_(density),
        bins_(density.dimension == 1 ? kBins1D : kBins2D),
        masses_(masses()),
        counts_(cells(), 0.0) {}

  void add(const SampledPoint& x) {
    counts_[index(x[0]) + (density_.dimension == 1 ? 0 : static_cast<size_t>(bins_) * index(x[1]))] += 1;
    ++samples_;
    if (shown_.size() < kShownPoints) shown_.push_back({x[0], x[1]});
  }

  // The histogram, and the first points in two dimensions.
  std::vector<experiments::Chart> charts() const {
    if (density_.dimension == 1) return {histogram_chart()};
    return {
        histogram_chart(),
        metrics::FunctionChart{.title = "First samples",
                               .x_label = "x",
                               .y_label = "y",
                               .curves = {{.name = "samples", .style = metrics::CurveStyle::dots, .points = shown_}}}};
  }

  equations::ChiSquareTest test() const {
    std::vector<double> expected = masses_;
    for (double& e : expected) e *= samples_;
    return equations::chi_square_test(counts_, expected);
  }

 private:
  // The density along the first axis, averaged over the second one.
  metrics::FunctionChart histogram_chart() const {
    metrics::FunctionCurve bars{.name = "histogram", .style = metrics::CurveStyle::bars, .points = {}};
    metrics::FunctionCurve theory{.name = "density", .points = {}};
    for (int i = 0; i < bins_; ++i) {
      double count = 0, expected = 0;
      for (size_t c = static_cast<size_t>(i); c < counts_.size(); c += static_cast<size_t>(bins_)) {
        count += counts_[c];
        expected += masses_[c];
      }
      bars.points.push_back({static_cast<double>(i) / bins_, samples_ > 0 ? count / samples_ * bins_ : 0});
      theory.points.push_back({(i + 0.5) / bins_, expected * bins_});
    }
    bars.points.push_back({1, 0});
    return {.title = density_.dimension == 1 ? "Histogram" : "Histogram of the first coordinate",
            .x_label = "x",
            .y_label = "density",
            .curves = {bars, theory}};
  }

  size_t cells() const { return static_cast<size_t>(density_.dimension == 1 ? bins_ : bins_ * bins_); }
  size_t index(double x) const { return static_cast<size_t>(std::clamp(static_cast<int>(x * bins_), 0, bins_ - 1)); }

  // Integrals over the cells by the midpoint rule, fine enough for the boundary of the disk.
  std::vector<double> masses() const {
    const int steps = density_.dimension == 1 ? 512 : 48;
    const double width = 1.0 / (bins_ * steps);
    std::vector<double> mass(cells(), 0.0);
    const int fine = bins_ * steps;
    for (int i = 0; i < fine; ++i) {
      if (density_.dimension == 1) {
        mass[static_cast<size_t>(i / steps)] += width * density_.pdf({(i + 0.5) * width, 0});
        continue;
      }
      for (int j = 0; j < fine; ++j)
        mass[static_cast<size_t>(i / steps + bins_ * (j / steps))] +=
            width * width * density_.pdf({(i + 0.5) * width, (j + 0.5) * width});
    }
    return mass;
  }

  const SampledDensity& density_;
  int bins_;
  std::vector<double> masses_;  // integrals of the density over the cells
  std::vector<double> counts_;
  double samples_ = 0;
  std::vector<metrics::Point> shown_;
};

// Shares of accepted proposals, in batches.
class AcceptanceCounter {
 public:
  explicit AcceptanceCounter(double expected_proposals) : batch_size_(std::max(1.0, expected_proposals / kBatches)) {}
  void add(bool accepted) {
    accepted_ += accepted ? 1 : 0;
    if (++proposals_ < batch_size_) return;
    batches_.add(accepted_ / proposals_);
    accepted_ = proposals_ = 0;
  }
  double rate() const { return batches_.mean(); }
  double error() const { return batches_.mean_error(); }

 private:
  double batch_size_, accepted_ = 0, proposals_ = 0;
  Moments batches_;
};

struct Sampling {
  static constexpr ExperimentDescription kDescription{
      .name = "sampling",
      .label = "Sampling of densities",
      .summary =
          "Histogram, chi-square test and acceptance rate of inversion, transformation, rejection and Metropolis "
          "sampling",
      .source = "[Lang, sec. 6.3, eq. 6.223, 6.317, 6.334, 6.357]"};

  Choice<DensityKind> density{"density", "Density", DensityKind::power,
                              "A density on the unit interval or unit square"};
  Choice<SamplingMethod> method{"method", "Method", SamplingMethod::rejection, "How samples are made"};
  Number<int> samples{"samples", "Samples",         50000, {100, 10000000}, "Number of samples in the histogram",
                      "",        Scale::logarithmic};
  Number<float> step{"step", "Step", 0.5f, {0.001f, 1}, "Half of the width of the proposals of Metropolis sampling"};
  Number<int> thinning{"thinning", "Thinning", 20, {1, 1000}, "Metropolis sampling counts every k-th state"};
  Number<int> burn_in{"burn-in", "Burn-in", 1000, {0, 1000000}, "States at the start of the chain that do not count"};
  auto parameters() { return std::tie(density, method, samples, step, thinning, burn_in); }

  Result<ExperimentResult> run(const RunContext& context) const {
    const SampledDensity d = make_density(density);
    DensityHistogram histogram(d);
    AcceptanceCounter acceptance(method == SamplingMethod::metropolis ? static_cast<double>(samples) * thinning
                                                                      : d.bound * samples);
    auto sample = make_sampler_of(d, context.seed, acceptance);
    if (!sample) return sample.error();
    constexpr int kPublications = 32, kProgressInterval = 256;
    for (int i = 0; i < samples; ++i) {
      if (i % kProgressInterval == 0 && !context.proceed(static_cast<double>(i) / samples)) return interrupted();
      histogram.add((*sample)());
      const bool publishes = int64_t{i + 1} * kPublications / samples > int64_t{i} * kPublications / samples;
      if (publishes && context.publish)
        context.publish({.charts = histogram.charts(), .table = {}, .checks = {}, .notes = {}});
    }
    return summary(d, histogram, acceptance);
  }

 private:
  using SampleFunction = std::function<SampledPoint()>;

  Result<SampleFunction> make_sampler_of(const SampledDensity& d, uint64_t seed, AcceptanceCounter& acceptance) const {
    equations::RandomNumbers random(seed);
    switch (method) {
      case SamplingMethod::inversion:
      case SamplingMethod::transformation: {
        const auto& make = method == SamplingMethod::inversion ? d.inversion : d.transformation;
        if (!make)
          return usage_error("method: the density '" + name_of(density) + "' has no " + name_of(method) +
                             " in closed form; use rejection or metropolis");
        return SampleFunction([make, random]() mutable { return make(random); });
      }
      case SamplingMethod::rejection:
        return SampleFunction([&d, &acceptance, random]() mutable {
          for (;;) {
            const SampledPoint x{random.uniform(), d.dimension == 1 ? 0 : random.uniform()};
            const bool accepted = random.uniform() * d.bound < d.pdf(x);
            acceptance.add(accepted);
            if (accepted) return x;
          }
        });
      case SamplingMethod::metropolis:
        break;
    }
    return metropolis_chain(d, random, acceptance);
  }

  SampleFunction metropolis_chain(const SampledDensity& d, equations::RandomNumbers random,
                                  AcceptanceCounter& acceptance) const {
    // The start must have a positive density.
    SampledPoint x{0.3, d.dimension == 1 ? 0 : 0.4};
    const auto move = [this, &d](SampledPoint& state, equations::RandomNumbers& u) {
      SampledPoint y = state;
      for (size_t c = 0; c < static_cast<size_t>(d.dimension); ++c)
        y[c] += static_cast<double>(step) * (2 * u.uniform() - 1);
      const bool inside = std::min(y[0], y[1]) >= 0 && std::max(y[0], y[1]) < 1;
      const bool accepted = inside && u.uniform() * d.pdf(state) < d.pdf(y);
      if (accepted) state = y;
      return accepted;
    };
    for (int i = 0; i < burn_in; ++i) move(x, random);
    return [this, move, x, random, &acceptance]() mutable {
      for (int i = 0; i < thinning; ++i) acceptance.add(move(x, random));
      return x;
    };
  }

  // The acceptance rate of theory; nothing for methods without proposals.
  std::optional<double> expected_acceptance(const SampledDensity& d) const {
    if (method == SamplingMethod::rejection) return 1 / d.bound;
    if (method != SamplingMethod::metropolis) return std::nullopt;
    constexpr uint32_t kPoints = 1 << 17;
    const UniformPoints points("sobol", kPoints);
    std::array<double, 4> u{};
    double sum = 0;
    for (uint32_t i = 0; i < kPoints; ++i) {
      points.point(1, i, u);
      SampledPoint x{u[0], u[1]}, y = x;
      if (d.dimension == 1) x[1] = y[1] = 0;
      for (size_t c = 0; c < static_cast<size_t>(d.dimension); ++c)
        y[c] += static_cast<double>(step) * (2 * u[c + 2] - 1);
      if (std::min(y[0], y[1]) >= 0 && std::max(y[0], y[1]) < 1) sum += std::min(d.pdf(x), d.pdf(y));
    }
    return sum / kPoints;
  }

  ExperimentResult summary(const SampledDensity& d, const DensityHistogram& histogram,
                           const AcceptanceCounter& acceptance) const {
    ExperimentResult result;
    result.charts = histogram.charts();
    const auto test = histogram.test();
    result.table.columns = {"quantity", "value"};
    result.table.rows = {{"chi-square", test.statistic},
                         {"degrees of freedom", static_cast<double>(test.degrees)},
                         {"p value", test.p_value}};
    constexpr double kFalseAlarms = 1e-4;
    result.checks.push_back({"p value above 0.0001", test.p_value, 0.5 + kFalseAlarms / 2, 0.5 - kFalseAlarms / 2});
    if (const auto expected = expected_acceptance(d)) {
      result.table.rows.push_back({"acceptance rate", acceptance.rate()});
      result.table.rows.push_back({"acceptance rate, theory", *expected});
      constexpr double kQuasiRandomError = 5e-4;
      result.checks.push_back(
          {"acceptance rate", acceptance.rate(), *expected, kStandardErrors * acceptance.error() + kQuasiRandomError});
    }
    return result;
  }

  template <class E>
  static std::string name_of(const Choice<E>& choice) {
    return Options<E>::kOptions[static_cast<size_t>(choice.value)].name;
  }
};

}  // namespace

Experiment sampling_experiment() { return make_experiment<Sampling>(); }

}  // namespace etendue::experiments
