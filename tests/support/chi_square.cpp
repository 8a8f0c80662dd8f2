#include "support/chi_square.h"

#include <cmath>
#include <vector>

#include "equations/pearson_test.h"
#include "support/sphere_partition.h"

namespace etendue::test {
namespace {

// One sample in kPilotDivisor is a pilot sample: it determines the sizes of the cells and is not counted.
constexpr int kPilotDivisor = 5;
constexpr size_t kCells = 250;  // approximate number of cells
constexpr int kFinerLevels = 5;

}  // namespace

ChiSquare chi_square_on_sphere(const std::function<bool(Vec3&)>& sample, const std::function<double(const Vec3&)>& pdf,
                               int samples) {
  std::vector<Vec3> pilot;
  for (int i = 0; i < samples / kPilotDivisor; ++i)
    if (Vec3 w; sample(w)) pilot.push_back(w);
  const SpherePartition cells(pilot, std::max<size_t>(4, static_cast<size_t>(samples / kPilotDivisor) / kCells));

  std::vector<double> counts(cells.size() + 1, 0.0), expected(cells.size() + 1, 0.0);
  for (int i = 0; i < samples; ++i) {
    Vec3 w;
    ++counts[sample(w) ? cells.cell_of(w) : cells.size()];
  }
  // Refines until a step changes the value by less than 0.3 standard deviations of the count. The error of the finer
  // value is then much smaller.
  const auto enough = [&](double coarse, double fine) {
    return std::abs(fine - coarse) < 0.3 * std::sqrt(std::max(fine, 1e-9) / samples);
  };
  double total = 0;
  for (size_t k = 0; k < cells.size(); ++k) {
    expected[k] = samples * cells.integrate(k, pdf, enough);
    // A narrow ridge or peak of the density may lie between a few Gauss points. Cells whose counts differ are therefore
    // integrated again with more points.
    if (std::abs(counts[k] - expected[k]) > 2.5 * std::sqrt(std::max(counts[k], 1.0)))
      expected[k] = samples * cells.integrate(k, pdf, enough, kFinerLevels);
    total += expected[k];
  }
  expected.back() = std::max(0.0, samples - total);

  ChiSquare result;
  double pooled_count = 0, pooled_expected = 0;
  int kinds = 0;
  const auto add = [&](double count, double expectation) {
    result.statistic += (count - expectation) * (count - expectation) / expectation;
    ++kinds;
  };
  for (size_t i = 0; i < counts.size(); ++i) {
    if (expected[i] >= 5) {
      add(counts[i], expected[i]);
    } else {
      pooled_count += counts[i];
      pooled_expected += expected[i];
    }
  }
  if (pooled_expected >= 5) add(pooled_count, pooled_expected);
  // Samples in regions of zero density.
  if (pooled_expected < 5 && pooled_count > 5 * (pooled_expected + 5)) result.statistic += 1e9;
  result.degrees = std::max(1, kinds - 1);
  result.p_value = equations::chi_square_survival(result.statistic, result.degrees);
  return result;
}

}  // namespace etendue::test
