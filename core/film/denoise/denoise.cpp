#include "film/denoise/denoise.h"

#include <algorithm>

#include "film/denoise/box_filter.h"
#include "film/denoise/candidate_choice.h"
#include "film/denoise/feature_filter.h"
#include "film/denoise/local_regression.h"
#include "film/denoise/patch_weights.h"

namespace etendue::film {
namespace {

constexpr int kColorVarianceRadius = 3;        // of the averaging of variances
constexpr double kRelativeMinVariance = 1e-7;  // of the squared mean of the image

// The half-buffers, where a missing value is replaced by that of the other one, or by 0.
HalfImages completed(const HalfImages& half_buffers) {
  HalfImages result = half_buffers;
  for (size_t i = 0; i < result[0].size(); ++i)
    for (size_t h = 0; h < kHalfBuffers; ++h)
      if (!is_finite(half_buffers[h][i]))
        result[h][i] = is_finite(half_buffers[1 - h][i]) ? half_buffers[1 - h][i] : Rgb(0);
  return result;
}

// 1 for the pixels of the image with a value in both half-buffers, else 0.
PaddedPlane valid_pixels(const DenoiseInput& input) {
  PaddedPlane valid(input.width, input.height, 1, 0);
  for (int y = 0; y < input.height; ++y)
    for (int x = 0; x < input.width; ++x) {
      const size_t i = static_cast<size_t>(y) * static_cast<size_t>(input.width) + static_cast<size_t>(x);
      if (!is_finite(input.half_buffers[0][i]) || !is_finite(input.half_buffers[1][i])) *valid.at(x, y) = 0;
    }
  return valid;
}

std::vector<PaddedPlane> color_planes(const std::vector<Rgb>& image, int width, int height) {
  std::vector<PaddedPlane> planes;
  for (int c = 0; c < 3; ++c) {
    std::vector<float> values;
    values.reserve(image.size());
    for (const Rgb& color : image) values.push_back(color[c]);
    planes.emplace_back(width, height, values);
  }
  return planes;
}

// The variance of a half-buffer, mean of the channels, averaged over a window.
PaddedPlane variance_of(const HalfImages& images, int width, int height) {
  std::vector<float> variance;
  variance.reserve(images[0].size());
  for (size_t i = 0; i < images[0].size(); ++i) {
    const Rgb d = images[0][i] - images[1][i];
    variance.push_back((d.r * d.r + d.g * d.g + d.b * d.b) / 6);
  }
  return {width, height, box_filtered(variance, width, height, kColorVarianceRadius)};
}

float min_variance_of(const HalfImages& images) {
  double sum = 0;
  for (const Rgb& c : images[0]) sum += double{c.r} + double{c.g} + double{c.b};
  const double mean = sum / (3 * static_cast<double>(images[0].size()));
  return static_cast<float>(std::max(kRelativeMinVariance * mean * mean, 1e-30));
}

class Regression {
 public:
  Regression(const DenoiseInput& input, const HalfImages& images, const ForEach& for_each)
      : width_(input.width),
        height_(input.height),
        features_(filtered_features(input, for_each)),
        colors_{color_planes(images[0], width_, height_), color_planes(images[1], width_, height_)},
        valid_(valid_pixels(input)),
        variance_(variance_of(images, width_, height_)),
        min_variance_(min_variance_of(images)) {
    for (HalfImages& candidate : candidates_)
      for (auto& image : candidate) image.resize(images[0].size());
  }

  void filter_tile(int number) {
    const TilePosition tile = tile_position(number, width_);
    std::vector<float> weights;
    for (size_t h = 0; h < kHalfBuffers; ++h) {
      patch_weights({.channels = colors_[1 - h], .variance = &variance_, .min_variance = min_variance_}, valid_, tile,
                    kRegressionRadius, weights);
      for (int row = 0; row < std::min(kTileHeight, height_ - tile.y); ++row)
        for (int column = 0; column < kTileWidth; column += static_cast<int>(kRegressionLanes))
          filter_lanes(h, tile.x + column, tile.y + row, weights.data() + row * kTileWidth + column);
    }
  }

  const std::array<HalfImages, kBandwidths>& candidates() const { return candidates_; }

 private:
  void filter_lanes(size_t half_buffer, int x, int y, const float* weights) {
    if (x >= width_) return;
    RegressionResult result;
    fit_windows({.features = features_, .colors = colors_[half_buffer]}, x, y, weights, result);
    const size_t start = static_cast<size_t>(y) * static_cast<size_t>(width_) + static_cast<size_t>(x);
    const auto count = std::min(kRegressionLanes, static_cast<size_t>(width_ - x));
    for (size_t b = 0; b < kBandwidths; ++b)
      for (size_t i = 0; i < count; ++i)
        candidates_[b][half_buffer][start + i] = {result[b][0][i], result[b][1][i], result[b][2][i]};
  }

  int width_, height_;
  std::vector<PaddedPlane> features_;
  std::array<std::vector<PaddedPlane>, kHalfBuffers> colors_;
  PaddedPlane valid_;
  PaddedPlane variance_;
  float min_variance_;
  std::array<HalfImages, kBandwidths> candidates_;
};

}  // namespace

FeaturePlanes feature_planes(const std::vector<float>& albedo, const std::vector<float>& normal,
                             const std::vector<float>& depth, float depth_scale) {
  FeaturePlanes planes;
  for (size_t i = 0; i < depth.size(); ++i) {
    for (size_t k = 0; k < 3; ++k) {
      planes[k].push_back(albedo[3 * i + k]);
      planes[3 + k].push_back(normal[3 * i + k]);
    }
    planes[6].push_back(depth[i] * depth_scale);
  }
  return planes;
}

std::array<std::vector<Rgb>, kHalfBuffers> half_buffer_means(const Film& film) {
  HalfImages images;
  for (int y = 0; y < film.height(); ++y)
    for (int x = 0; x < film.width(); ++x)
      for (uint32_t h = 0; h < kHalfBuffers; ++h)
        images[h].push_back(film.half_buffer_samples(x, y, h) > 0 ? film.half_buffer_mean(x, y, h) : film.mean(x, y));
  return images;
}

std::vector<Rgb> denoise(const DenoiseInput& input, const ForEach& for_each) {
  if (input.half_buffers[0].empty()) return {};
  const HalfImages images = completed(input.half_buffers);
  Regression regression(input, images, for_each);
  for_each(tile_count(input.width, input.height), [&](int tile) { regression.filter_tile(tile); });
  return best_of(regression.candidates(), images, input.width, input.height);
}

}  // namespace etendue::film
