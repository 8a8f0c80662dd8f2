#include "film/denoise.h"

#include <algorithm>
#include <cmath>

#include "base/vectorize.h"
#include "film/denoise_regression.h"

namespace etendue::film {
namespace {

constexpr int kRadius = 6;          // of the window of the regression, pixels
constexpr int kPatchRadius = 2;     // of the patches that are compared
constexpr int kVarianceRadius = 3;  // of the averaging of variances
constexpr float kBandwidth = 0.6f;  // larger: more smoothing, more blur
constexpr float kMinVariance = 1e-10f;

bool is_finite(const Rgb& c) { return std::isfinite(c.r) && std::isfinite(c.g) && std::isfinite(c.b); }

// Means over windows of kVarianceRadius, cut off at the borders.
std::vector<float> box_filtered(const std::vector<float>& values, int width, int height) {
  std::vector<float> rows(values.size());
  std::vector<float> result(values.size());
  const auto mean = [](const std::vector<float>& from, size_t start, size_t step, int i, int length) {
    const int first = std::max(0, i - kVarianceRadius);
    const int last = std::min(length - 1, i + kVarianceRadius);
    double sum = 0;
    for (int k = first; k <= last; ++k) sum += double{from[start + static_cast<size_t>(k) * step]};
    return static_cast<float>(sum / (last - first + 1));
  };
  const auto stride = static_cast<size_t>(width);
  for (int y = 0; y < height; ++y)
    for (int x = 0; x < width; ++x)
      rows[static_cast<size_t>(y) * stride + static_cast<size_t>(x)] =
          mean(values, static_cast<size_t>(y) * stride, 1, x, width);
  for (int y = 0; y < height; ++y)
    for (int x = 0; x < width; ++x)
      result[static_cast<size_t>(y) * stride + static_cast<size_t>(x)] =
          mean(rows, static_cast<size_t>(x), stride, y, height);
  return result;
}

// One neighbour of each of kLanes pixels: weights, features relative to the centres, and colours.
struct Neighbours {
  using Lanes = RegressionLanes::Lanes;
  Lanes weight;
  std::array<Lanes, kDenoiseFeatures> feature;
  std::array<Lanes, 3> color;
};

// Adds the neighbours to the normal equations.
ETENDUE_VECTORIZE void accumulate(const Neighbours& n, RegressionLanes& sums) {
  constexpr size_t kLanes = RegressionLanes::kLanes;
  size_t entry = 0;
  for (size_t row = 0; row < RegressionLanes::kUnknowns; ++row) {
    RegressionLanes::Lanes weighted;
    for (size_t i = 0; i < kLanes; ++i) weighted[i] = row == 0 ? n.weight[i] : n.weight[i] * n.feature[row - 1][i];
    for (size_t column = 0; column <= row; ++column, ++entry)
      for (size_t i = 0; i < kLanes; ++i)
        sums.matrix[entry][i] += column == 0 ? weighted[i] : weighted[i] * n.feature[column - 1][i];
    for (size_t c = 0; c < 3; ++c)
      for (size_t i = 0; i < kLanes; ++i) sums.right[c][row][i] += weighted[i] * n.color[c][i];
  }
}

}  // namespace

std::array<std::vector<float>, kDenoiseFeatures> denoise_features(std::span<const float> albedo,
                                                                  std::span<const float> normal,
                                                                  std::span<const float> depth) {
  std::array<std::vector<float>, kDenoiseFeatures> features;
  float max_depth = 0;
  for (const float d : depth)
    if (std::isfinite(d)) max_depth = std::max(max_depth, d);
  for (size_t i = 0; i < depth.size(); ++i) {
    for (size_t k = 0; k < 3; ++k) {
      features[k].push_back(albedo[3 * i + k]);
      features[3 + k].push_back(normal[3 * i + k]);
    }
    features[6].push_back(max_depth > 0 ? depth[i] / max_depth : 0);
  }
  return features;
}

DenoiseInput denoise_input(const Film& film, std::array<std::vector<float>, kDenoiseFeatures> features) {
  DenoiseInput input{.width = film.width(), .height = film.height(), .half_buffers = {}, .features = std::move(features)};
  for (int y = 0; y < film.height(); ++y)
    for (int x = 0; x < film.width(); ++x)
      for (uint32_t h = 0; h < kHalfBuffers; ++h)
        input.half_buffers[h].push_back(film.half_buffer_samples(x, y, h) > 0 ? film.half_buffer_mean(x, y, h)
                                                                               : film.mean(x, y));
  return input;
}

// The work arrays of one row.
struct Denoiser::RowBuffers {
  std::vector<float> column_sums;  // distances, summed over the rows of a patch
  std::vector<float> weights;
  std::vector<RegressionLanes> sums;
};

Denoiser::Denoiser(DenoiseInput input) : input_(std::move(input)) {
  const size_t pixels = input_.half_buffers[0].size();
  valid_.assign(pixels, 1);
  std::vector<float> variances(pixels);
  for (size_t i = 0; i < pixels; ++i) {
    bool is_valid = is_finite(input_.half_buffers[0][i]) && is_finite(input_.half_buffers[1][i]);
    for (auto& feature : input_.features) is_valid = is_valid && std::isfinite(feature[i]);
    if (!is_valid) {
      valid_[i] = 0;
      for (auto& half_buffer : input_.half_buffers) half_buffer[i] = Rgb(0);
      for (auto& feature : input_.features)
        if (!std::isfinite(feature[i])) feature[i] = 0;
      continue;
    }
    const Rgb d = input_.half_buffers[0][i] - input_.half_buffers[1][i];
    variances[i] = (d.r * d.r + d.g * d.g + d.b * d.b) / 6;
  }
  variance_ = box_filtered(variances, input_.width, input_.height);
}

// The weights of the pixels of row y for their neighbours at (dx, dy), from the colours of half-buffer `guide`. The
// squared difference of two pixels, minus what noise explains, is compared with their variance [Rousselle et al. 2012].
void Denoiser::compute_weights(int y, size_t guide, int dx, int dy, RowBuffers& buffers) const {
  const int width = input_.width;
  const auto& colors = input_.half_buffers[guide];
  std::ranges::fill(buffers.column_sums, 0.0f);
  int rows = 0;
  for (int v = std::max(0, y - kPatchRadius); v <= std::min(input_.height - 1, y + kPatchRadius); ++v) {
    if (v + dy < 0 || v + dy >= input_.height) continue;
    ++rows;
    for (int x = std::max(0, -dx); x < std::min(width, width - dx); ++x) {
      const auto p = static_cast<size_t>(v * width + x);
      const auto q = static_cast<size_t>((v + dy) * width + x + dx);
      if (!valid_[p] || !valid_[q]) continue;
      const Rgb d = colors[p] - colors[q];
      const float square = (d.r * d.r + d.g * d.g + d.b * d.b) / 3;
      const float noise = variance_[p] + std::min(variance_[p], variance_[q]);
      buffers.column_sums[static_cast<size_t>(x)] +=
          (square - noise) / (kMinVariance + kBandwidth * kBandwidth * (variance_[p] + variance_[q]));
    }
  }
  for (int x = 0; x < width; ++x) {
    float& weight = buffers.weights[static_cast<size_t>(x)];
    weight = 0;
    if (x + dx < 0 || x + dx >= width || !valid_[static_cast<size_t>((y + dy) * width + x + dx)]) continue;
    const int first = std::max(0, x - kPatchRadius);
    const int last = std::min(width - 1, x + kPatchRadius);
    float distance = 0;
    for (int u = first; u <= last; ++u) distance += buffers.column_sums[static_cast<size_t>(u)];
    weight = std::exp(-std::max(0.0f, distance / static_cast<float>(rows * (last - first + 1))));
  }
}

void Denoiser::filter_row(int y, size_t half_buffer, RowBuffers& buffers, std::span<Rgb> row) const {
  constexpr size_t kLanes = RegressionLanes::kLanes;
  const int width = input_.width;
  const auto& colors = input_.half_buffers[half_buffer];
  std::ranges::fill(buffers.sums, RegressionLanes());
  Neighbours neighbours{};
  for (int dy = -kRadius; dy <= kRadius; ++dy) {
    if (y + dy < 0 || y + dy >= input_.height) continue;
    for (int dx = -kRadius; dx <= kRadius; ++dx) {
      compute_weights(y, 1 - half_buffer, dx, dy, buffers);
      for (size_t group = 0; group < buffers.sums.size(); ++group) {
        for (size_t i = 0; i < kLanes; ++i) {
          const int x = static_cast<int>(group * kLanes + i);
          const bool is_inside = x < width && x + dx >= 0 && x + dx < width;
          neighbours.weight[i] = is_inside ? buffers.weights[static_cast<size_t>(x)] : 0;
          if (!is_inside) continue;
          const auto p = static_cast<size_t>(y * width + x);
          const auto q = static_cast<size_t>((y + dy) * width + x + dx);
          for (size_t k = 0; k < kDenoiseFeatures; ++k)
            neighbours.feature[k][i] = input_.features[k][q] - input_.features[k][p];
          for (size_t c = 0; c < 3; ++c) neighbours.color[c][i] = colors[q][static_cast<int>(c)];
        }
        accumulate(neighbours, buffers.sums[group]);
      }
    }
  }
  for (size_t x = 0; x < row.size(); ++x) {
    const Rgb fit = buffers.sums[x / kLanes].solve(x % kLanes);
    row[x] += Rgb(std::max(fit.r, 0.0f), std::max(fit.g, 0.0f), std::max(fit.b, 0.0f)) / static_cast<float>(kHalfBuffers);
  }
}

void Denoiser::filter_rows(int first, int end, std::span<Rgb> output) const {
  const auto width = static_cast<size_t>(input_.width);
  RowBuffers buffers{.column_sums = std::vector<float>(width),
                     .weights = std::vector<float>(width),
                     .sums = std::vector<RegressionLanes>((width + RegressionLanes::kLanes - 1) / RegressionLanes::kLanes)};
  for (int y = first; y < end; ++y) {
    const auto row = output.subspan(static_cast<size_t>(y) * width, width);
    std::ranges::fill(row, Rgb(0));
    for (size_t h = 0; h < kHalfBuffers; ++h) filter_row(y, h, buffers, row);
  }
}

}  // namespace etendue::film
