#include "viewer/tasks/pixel_statistics.h"

#include <algorithm>
#include <cmath>

namespace etendue::viewer {

Histogram histogram_of(const std::vector<float>& values) {
  Histogram h;
  std::vector<float> positive;
  for (const float v : values)
    if (v > 0) positive.push_back(v);
  h.zeros = static_cast<uint32_t>(values.size() - positive.size());
  if (positive.empty()) return h;
  std::ranges::sort(positive);
  const auto quantile = [&](double q) {
    return double{positive[static_cast<size_t>(q * static_cast<double>(positive.size() - 1))]};
  };
  // A logarithmic axis is used if the samples spread widely or if there are outliers.
  h.logarithmic = quantile(0.95) > 30 * quantile(0.05) || quantile(1) > 5 * quantile(0.95);
  h.low = h.logarithmic ? quantile(0) : 0;
  h.high = std::max(quantile(1), h.low * 1.01);
  const size_t bins = std::clamp<size_t>(static_cast<size_t>(std::sqrt(static_cast<double>(positive.size()))), 8, 48);
  h.counts.resize(bins);
  for (const float v : positive) {
    const double position =
        h.logarithmic ? std::log(v / h.low) / std::log(h.high / h.low) : (v - h.low) / (h.high - h.low);
    ++h.counts[std::min(static_cast<size_t>(position * static_cast<double>(bins)), bins - 1)];
  }
  return h;
}

}  // namespace etendue::viewer
