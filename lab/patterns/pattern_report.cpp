#include "patterns/pattern_report.h"

#include <cmath>
#include <functional>
#include <numbers>

#include "patterns/discrepancy.h"
#include "patterns/distances.h"
#include "patterns/net_quality.h"

namespace etendue::patterns {
namespace {

// An integrand with its integral and its variation in the sense of Hardy and Krause [Lang, eq. 7.25].
struct Integrand {
  const char* name;
  double (*f)(double x, double y);
  double integral, variation;
};

constexpr double kE = std::numbers::e;
const Integrand kIntegrands[] = {{"x y", [](double x, double y) { return x * y; }, 0.25, 3},
                                 {"exp(x + y)", [](double x, double y) { return std::exp(x + y); }, (kE - 1) * (kE - 1),
                                  (kE - 1) * (kE - 1) + 2 * kE*(kE - 1)}};

double absolute_error(const Integrand& integrand, const PointSet& set) {
  double sum = 0;
  for (const PlanePoint& p : set) sum += integrand.f(p[0], p[1]);
  return std::abs(sum / static_cast<double>(set.size()) - integrand.integral);
}

QualityValue mean_over(const std::vector<PointSet>& sets, std::string name,
                       const std::function<double(const PointSet&)>& quality) {
  double sum = 0, squares = 0;
  const auto n = static_cast<double>(sets.size());
  for (const PointSet& set : sets) {
    const double value = quality(set);
    sum += value;
    squares += value * value;
  }
  const double mean = sum / n, variance = n > 1 ? std::max(0.0, (squares - n * mean * mean) / (n - 1)) : 0;
  return {std::move(name), mean, std::sqrt(variance / n)};
}

}  // namespace

std::vector<QualityValue> report_of(const std::vector<PointSet>& sets) {
  std::vector<QualityValue> values;
  const auto add = [&](std::string name, const std::function<double(const PointSet&)>& quality) {
    values.push_back(mean_over(sets, std::move(name), quality));
  };
  const size_t points = sets.front().size();
  if (points <= kMostPointsOfPairs) {
    add("star discrepancy", star_discrepancy);
    if (points <= kMostPointsOfExtreme) add("extreme discrepancy", extreme_discrepancy);
    add("L2 star discrepancy", l2_star_discrepancy);
    add("smallest distance", least_distance);
    add("smallest distance on the torus", least_toroidal_distance);
  }
  if (net_quality(sets.front(), 2)) add("t in base 2", [](const PointSet& s) { return *net_quality(s, 2); });
  for (const Integrand& integrand : kIntegrands) {
    const std::string name = std::string("error of ") + integrand.name;
    add(name, [&](const PointSet& s) { return absolute_error(integrand, s); });
    if (points <= kMostPointsOfPairs)
      add(name + ", bound", [&](const PointSet& s) { return integrand.variation * star_discrepancy(s); });
  }
  return values;
}

}  // namespace etendue::patterns
