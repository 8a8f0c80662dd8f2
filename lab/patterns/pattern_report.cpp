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

template <class Set>
QualityValue mean_over(const std::vector<Set>& sets, std::string name, const std::function<double(const Set&)>& quality) {
  double sum = 0, squares = 0;
  const auto n = static_cast<double>(sets.size());
  for (const Set& set : sets) {
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
    values.push_back(mean_over<PointSet>(sets, std::move(name), quality));
  };
  const size_t points = sets.front().size();
  if (points <= kMostPointsOfPairs) {
    add("star discrepancy", star_discrepancy);
    if (points <= kMostPointsOfExtreme) add("extreme discrepancy", extreme_discrepancy);
    add("L2 star discrepancy", [](const PointSet& s) { return l2_star_discrepancy(s); });
    add("smallest distance", [](const PointSet& s) { return least_distance(s); });
    add("smallest distance on the torus", [](const PointSet& s) { return least_toroidal_distance(s); });
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

namespace {

// Grids of more dimensions are too coarse for bounds that say anything, and need 2^s nodes.
constexpr size_t kMostBoundedDimensions = 6;

double product_error(const CubePoints& set) {
  double sum = 0;
  for (const auto& p : set) {
    double product = 1;
    for (const double x : p) product *= x;
    sum += product;
  }
  return std::abs(sum / static_cast<double>(set.size()) - std::ldexp(1.0, -static_cast<int>(set.front().size())));
}

}  // namespace

std::vector<QualityValue> report_of(const std::vector<CubePoints>& sets) {
  std::vector<QualityValue> values;
  const auto add = [&](std::string name, const std::function<double(const CubePoints&)>& quality) {
    values.push_back(mean_over<CubePoints>(sets, std::move(name), quality));
  };
  if (sets.front().front().size() <= kMostBoundedDimensions) {
    add("star discrepancy, at least", [](const CubePoints& s) { return star_discrepancy_bounds(s).lower; });
    add("star discrepancy, at most", [](const CubePoints& s) { return star_discrepancy_bounds(s).upper; });
  }
  if (sets.front().size() <= kMostPointsOfPairs) {
    add("L2 star discrepancy", [](const CubePoints& s) { return l2_star_discrepancy(s); });
    add("smallest distance", [](const CubePoints& s) { return least_distance(s); });
    add("smallest distance on the torus", [](const CubePoints& s) { return least_toroidal_distance(s); });
  }
  if (net_quality(sets.front(), 2)) add("t in base 2", [](const CubePoints& s) { return *net_quality(s, 2); });
  add("error of the product", product_error);
  return values;
}

}  // namespace etendue::patterns
