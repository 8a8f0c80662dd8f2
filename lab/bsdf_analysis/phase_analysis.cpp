#include "bsdf_analysis/phase_analysis.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdio>
#include <numbers>

#include "base/hash.h"

namespace etendue::bsdf_analysis {
namespace {

// Integrates over x from `low` to 1 - v with intervals that shrink towards both ends, where p may be steep.
class GradedRule {
 public:
  GradedRule() {
    double end = 0;
    for (double v = 1e-10; v < 1.5; v *= 1.02) {
      const double next = std::min(v, 1.0);
      add_interval(end, next);
      end = next;
    }
  }

  struct Point {
    double x, weight;
  };
  const std::vector<Point>& points() const { return points_; }

 private:
  // Three points of Gauss-Legendre quadrature, at 1 - v and at v - 1.
  void add_interval(double from, double to) {
    if (!(from < to)) return;
    constexpr std::array<std::array<double, 2>, 3> kRule{
        {{-0.7745966692414834, 5.0 / 9}, {0, 8.0 / 9}, {0.7745966692414834, 5.0 / 9}}};
    for (const auto& [node, weight] : kRule) {
      const double v = 0.5 * (from + to) + 0.5 * (to - from) * node, w = 0.5 * (to - from) * weight;
      points_.push_back({1 - v, w});
      points_.push_back({v - 1, w});
    }
  }

  std::vector<Point> points_;
};

std::string text(const char* format, double a, double b) {
  std::array<char, 120> out;
  std::snprintf(out.data(), out.size(), format, a, b);
  return out.data();
}

double sampling_deviation(const PhaseFunction& phase, uint32_t count) {
  std::vector<double> samples(count);
  for (uint32_t i = 0; i < count; ++i) {
    const double random = static_cast<double>(mix_bits(uint64_t{i} + 1) >> 11) * 0x1p-53;
    samples[i] = phase.sample_cosine(random);
  }
  std::ranges::sort(samples);
  static const std::vector<GradedRule::Point> rule = [] {
    auto points = GradedRule().points();
    std::ranges::sort(points, {}, &GradedRule::Point::x);
    return points;
  }();
  double below = 0, largest = 0;
  size_t taken = 0;
  // The distribution function of p at the end of each quadrature interval, between its points.
  for (size_t i = 0; i + 1 < rule.size(); ++i) {
    below += 2 * std::numbers::pi * rule[i].weight * phase.eval(rule[i].x);
    if ((i + 1) % 3 != 0) continue;
    const double end = 0.5 * (rule[i].x + rule[i + 1].x);
    while (taken < samples.size() && samples[taken] <= end) ++taken;
    largest = std::max(largest, std::abs(below - static_cast<double>(taken) / count));
  }
  return largest * std::sqrt(static_cast<double>(count));
}

}  // namespace

PhaseAnalysis analyze(const PhaseFunction& phase, uint32_t samples) {
  PhaseAnalysis a;
  a.minimum = phase.eval(0);
  bool finite = true;
  static const GradedRule rule;
  for (const auto& [x, weight] : rule.points()) {
    const double p = phase.eval(x), share = 2 * std::numbers::pi * weight * p;
    a.integral += share;
    a.mean_cosine += share * x;
    if (x < 0) a.backward += share;
    a.minimum = std::min(a.minimum, p);
    a.maximum = std::max(a.maximum, p);
    finite = finite && std::isfinite(p);
  }
  a.stated_mean_cosine = phase.mean_cosine();
  a.samples = samples;
  a.sampling_deviation = sampling_deviation(phase, samples);
  a.checks = {
      {"non-negative", "Non-negative", "Negative values", finite && a.minimum >= 0,
       text("p is between %.4g and %.4g 1/sr", a.minimum, a.maximum)},
      {"normalised", "Normalised", "Not normalised", std::abs(a.integral - 1) <= PhaseAnalysis::kTolerance,
       text("the integral over all directions is %.7f; the tolerance is %.0e", a.integral, PhaseAnalysis::kTolerance)},
      {"mean-cosine", "Mean cosine as stated", "Mean cosine differs",
       std::abs(a.mean_cosine - a.stated_mean_cosine) <= PhaseAnalysis::kTolerance,
       text("by quadrature %.6f, stated %.6f", a.mean_cosine, a.stated_mean_cosine)},
      {"well-sampled", "Samples follow p", "Samples do not follow p",
       a.sampling_deviation <= PhaseAnalysis::kMaxSamplingDeviation,
       text("Kolmogorov-Smirnov statistic %.2f, limit %.2f", a.sampling_deviation,
            PhaseAnalysis::kMaxSamplingDeviation)}};
  return a;
}

Slice phase_slice(const PhaseFunction& phase, int steps) {
  Slice slice;
  slice.degrees = 180;  // light arrives from the opposite side
  for (int i = 0; i < steps; ++i) {
    const double degrees = -180 + 360.0 * i / (steps - 1);
    slice.angles.push_back(degrees);
    slice.values.emplace_back(static_cast<float>(phase.eval(std::cos(degrees * std::numbers::pi / 180))));
  }
  return slice;
}

}  // namespace etendue::bsdf_analysis
