#include "film/denoise/feature_filter.h"

#include <algorithm>
#include <cmath>

#include "film/denoise/box_filter.h"
#include "film/denoise/patch_weights.h"

namespace etendue::film {
namespace {

constexpr int kFeatureRadius = 3;
constexpr int kFeatureVarianceRadius = 1;
constexpr float kMinFeatureVariance = 1e-6f;

// Features that share their weights: first plane and number of planes.
struct FeatureGroup {
  size_t first;
  size_t count;
};
constexpr std::array<FeatureGroup, 3> kGroups = {{{0, 3}, {3, 3}, {6, 1}}};

bool has_features(const DenoiseInput& input) {
  const auto pixels = input.half_buffers[0].size();
  return std::ranges::all_of(input.features, [&](const FeaturePlanes& planes) {
    return std::ranges::all_of(planes, [&](const auto& plane) { return plane.size() == pixels; });
  });
}

std::vector<float> finite_values(std::vector<float> values) {
  for (float& value : values)
    if (!std::isfinite(value)) value = 0;
  return values;
}

using HalfPlanes = std::array<std::vector<PaddedPlane>, kHalfBuffers>;

// The variance of a half-buffer, mean of the planes of a group.
PaddedPlane group_variance(const DenoiseInput& input, const HalfPlanes& planes, FeatureGroup group) {
  const auto width = static_cast<size_t>(input.width);
  std::vector<float> variance(input.half_buffers[0].size());
  for (size_t k = group.first; k < group.first + group.count; ++k)
    for (int y = 0; y < input.height; ++y)
      for (int x = 0; x < input.width; ++x) {
        const float d = *planes[0][k].at(x, y) - *planes[1][k].at(x, y);
        variance[static_cast<size_t>(y) * width + static_cast<size_t>(x)] +=
            d * d / (2 * static_cast<float>(group.count));
      }
  return {input.width, input.height, box_filtered(variance, input.width, input.height, kFeatureVarianceRadius)};
}

// Adds half of the filtered planes of a half-buffer.
void add_filtered(const std::vector<PaddedPlane>& planes, FeatureGroup group, TilePosition tile,
                  const std::vector<float>& weights, std::vector<PaddedPlane>& result) {
  std::array<float, kTilePixels> total{};
  std::array<std::array<float, kTilePixels>, 3> sums{};
  const float* weight = weights.data();
  for (int dy = -kFeatureRadius; dy <= kFeatureRadius; ++dy)
    for (int dx = -kFeatureRadius; dx <= kFeatureRadius; ++dx, weight += kTilePixels)
      for (int row = 0; row < kTileHeight; ++row) {
        const auto start = static_cast<size_t>(row * kTileWidth);
        for (size_t i = 0; i < kTileWidth; ++i) total[start + i] += weight[start + i];
        for (size_t k = 0; k < group.count; ++k) {
          const float* value = planes[group.first + k].at(tile.x + dx, tile.y + row + dy);
          for (size_t i = 0; i < kTileWidth; ++i) sums[k][start + i] += weight[start + i] * value[i];
        }
      }
  for (size_t k = 0; k < group.count; ++k)
    for (int row = 0; row < kTileHeight; ++row) {
      float* value = result[group.first + k].at(tile.x, tile.y + row);
      const auto start = static_cast<size_t>(row * kTileWidth);
      for (size_t i = 0; i < kTileWidth; ++i)
        if (total[start + i] > 0) value[i] += sums[k][start + i] / total[start + i] / static_cast<float>(kHalfBuffers);
    }
}

// The same plane with a border that repeats the pixels at the edge.
PaddedPlane with_border(const PaddedPlane& plane, int width, int height) {
  std::vector<float> values;
  values.reserve(static_cast<size_t>(width) * static_cast<size_t>(height));
  for (int y = 0; y < height; ++y) values.insert(values.end(), plane.at(0, y), plane.at(0, y) + width);
  return {width, height, values};
}

}  // namespace

std::vector<PaddedPlane> filtered_features(const DenoiseInput& input, const ForEach& for_each) {
  const int width = input.width, height = input.height;
  std::vector<PaddedPlane> result(kDenoiseFeatures, PaddedPlane(width, height, 0, 0));
  if (!has_features(input)) return result;
  HalfPlanes planes;
  for (size_t h = 0; h < kHalfBuffers; ++h)
    for (const auto& feature : input.features[h]) planes[h].emplace_back(width, height, finite_values(feature));
  std::vector<PaddedPlane> variances;
  variances.reserve(kGroups.size());
  for (const FeatureGroup group : kGroups) variances.push_back(group_variance(input, planes, group));
  const PaddedPlane valid(width, height, 1, 0);
  for_each(tile_count(width, height), [&](int number) {
    const TilePosition tile = tile_position(number, width);
    std::vector<float> weights;
    for (size_t g = 0; g < kGroups.size(); ++g)
      for (size_t h = 0; h < kHalfBuffers; ++h) {
        const FeatureGroup group = kGroups[g];
        patch_weights({.channels = std::span(planes[1 - h]).subspan(group.first, group.count),
                       .variance = &variances[g],
                       .min_variance = kMinFeatureVariance},
                      valid, tile, kFeatureRadius, weights);
        add_filtered(planes[h], group, tile, weights, result);
      }
  });
  for (PaddedPlane& plane : result) plane = with_border(plane, width, height);
  return result;
}

}  // namespace etendue::film
