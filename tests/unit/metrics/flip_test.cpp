// FLIP against closed forms for constant colours, and its properties [Andersson et al. 2020].
#include "metrics/flip.h"

#include <gtest/gtest.h>

#include <cmath>
#include <numeric>

#include "base/hash.h"

namespace etendue::test {
namespace {

using metrics::flip_map;
using metrics::Kernel;
using metrics::mean_of;
using metrics::Plane;

using Pixels = std::vector<float>;

Pixels plain(int width, int height, const Rgb& c) {
  Pixels rgb;
  for (int i = 0; i < width * height; ++i) rgb.insert(rgb.end(), {c.r, c.g, c.b});
  return rgb;
}

template <class F>
Pixels drawn(int width, int height, F&& grey) {
  Pixels rgb;
  for (int y = 0; y < height; ++y)
    for (int x = 0; x < width; ++x) rgb.insert(rgb.end(), 3, static_cast<float>(grey(x, y)));
  return rgb;
}

Pixels noise(int width, int height, uint32_t seed) {
  Pixels rgb(static_cast<size_t>(width * height * 3));
  for (size_t i = 0; i < rgb.size(); ++i) rgb[i] = to_unit_float(hash_combine(seed, static_cast<uint32_t>(i)));
  return rgb;
}

Pixels mixed(const Pixels& a, const Pixels& b, float t) {
  Pixels c(a.size());
  for (size_t i = 0; i < a.size(); ++i) c[i] = (1 - t) * a[i] + t * b[i];
  return c;
}

double flip(int width, int height, const Pixels& a, const Pixels& b) { return mean_of(flip_map(width, height, a, b)); }
double flip_of_colors(const Rgb& a, const Rgb& b) { return flip(4, 4, plain(4, 4, a), plain(4, 4, b)); }

TEST(Flip, EqualImagesHaveNone) {
  const Pixels a = noise(40, 30, 1);
  for (const float v : flip_map(40, 30, a, a)) EXPECT_EQ(v, 0);
}

// For images of constant colour only the colour difference remains.
TEST(Flip, ConstantColoursHaveClosedForms) {
  // 0.95 + 0.05 (100^0.7 - 0.4 c) / (0.6 c), c = HyAB(green, blue)^0.7 with L*a*b* of green (87.74, -86.18, 83.18) and
  // blue (32.30, 79.20, -107.86), a* and b* multiplied by 0.01 L*.
  const double green[3] = {87.74, -86.18 * 0.8774, 83.18 * 0.8774}, blue[3] = {32.30, 79.20 * 0.3230, -107.86 * 0.3230};
  const double hyab = green[0] - blue[0] + std::hypot(green[1] - blue[1], green[2] - blue[2]);
  const double c = std::pow(hyab, 0.7);
  EXPECT_NEAR(flip_of_colors(Rgb(0), Rgb(1)), 0.95 + 0.05 * (std::pow(100, 0.7) - 0.4 * c) / (0.6 * c), 1e-4);
  EXPECT_NEAR(flip_of_colors(Rgb(0), Rgb(1)), 0.9674, 1e-4);
  EXPECT_NEAR(flip_of_colors(Rgb(0, 1, 0), Rgb(0, 0, 1)), 1, 1e-4);
  // Below the knee: L* of linear 0.18 is 49.50, that of 0.2 is 51.84.
  EXPECT_NEAR(flip_of_colors(Rgb(0.18f), Rgb(0.2f)), 0.95 / (0.4 * c) * std::pow(51.837 - 49.496, 0.7), 1e-3);
}

TEST(Flip, IsSymmetric) {
  const Pixels a = noise(40, 30, 1), b = noise(40, 30, 2);
  EXPECT_EQ(flip_map(40, 30, a, b), flip_map(40, 30, b, a));
}

TEST(Flip, IsInTheUnitInterval) {
  for (const float v :
       flip_map(64, 64, noise(64, 64, 1), drawn(64, 64, [](int x, int y) { return (x / 7 + y) % 2; }))) {
    EXPECT_GE(v, 0);
    EXPECT_LE(v, 1);
  }
}

TEST(Flip, IncreasesWithTheOffset) {
  const Pixels a = noise(48, 48, 1), white = plain(48, 48, Rgb(1));
  double last = 0;
  for (const float t : {0.01f, 0.02f, 0.05f, 0.1f, 0.2f, 0.5f}) {
    const double now = flip(48, 48, a, mixed(a, white, t));
    EXPECT_GT(now, last) << t;
    last = now;
  }
}

TEST(Flip, IncreasesWithBlur) {
  const auto edge = [](double softness) {
    return drawn(64, 64, [&](int x, int) { return 1 / (1 + std::exp(-(x - 31.5) / softness)); });
  };
  double last = 0;
  for (const double softness : {0.4, 0.8, 1.6, 3.2, 6.4}) {
    const double now = flip(64, 64, edge(0.1), edge(softness));
    EXPECT_GT(now, last) << softness;
    last = now;
  }
}

TEST(Flip, IsTranslationInvariant) {
  const auto spot = [](int dx, int dy, float height) {
    return drawn(80, 80, [&](int x, int y) { return std::hypot(x - 30 - dx, y - 30 - dy) < 5 ? height : 0.3f; });
  };
  const auto here = flip_map(80, 80, spot(0, 0, 0.8f), spot(0, 0, 0.6f));
  const auto there = flip_map(80, 80, spot(9, 14, 0.8f), spot(9, 14, 0.6f));
  for (int y = 0; y < 66; ++y)
    for (int x = 0; x < 71; ++x) {
      const auto at = [&](const auto& map, int i, int j) { return map[static_cast<size_t>(j * 80 + i)]; };
      EXPECT_NEAR(at(here, x, y), at(there, x + 9, y + 14), 1e-5f) << x << " " << y;
    }
}

// At 67 pixels per degree a checkerboard of single pixels appears grey, and one of 16 pixels does not. A shift by one
// pixel is nearly invisible in the first, although every pixel changes from black to white.
TEST(Flip, ShiftOfAFineCheckerboardIsHardToSee) {
  const auto board = [](int cell, int shift) {
    return drawn(96, 96, [=](int x, int y) { return ((x + shift) / cell + y / cell) % 2; });
  };
  const double fine = flip(96, 96, board(1, 0), board(1, 1)), coarse = flip(96, 96, board(16, 0), board(16, 1));
  const double inverted = flip(96, 96, board(16, 0), board(16, 16));
  EXPECT_LT(fine, 0.1);
  EXPECT_GT(coarse, 0.02);
  EXPECT_LT(coarse, inverted);
  EXPECT_GT(inverted, 0.8);
}

TEST(Flip, AppliesToneCurveAndExposure) {
  const auto layered = [](float value) {
    image::LayeredImage image;
    image.width = image.height = 4;
    image.layers.push_back({"", {"R", "G", "B"}, plain(4, 4, Rgb(value))});
    return image;
  };
  const auto at = [&](float exposure, image::ToneCurve curve) {
    return mean_of(*flip_map(layered(4), layered(8), {exposure, curve, metrics::kPixelsPerDegree}));
  };
  EXPECT_EQ(at(0, image::ToneCurve::none), 0);  // both are white
  EXPECT_GT(at(-4, image::ToneCurve::none), 0.3);
  EXPECT_GT(at(0, image::ToneCurve::aces), 0);
  EXPECT_FALSE(flip_map(layered(1), image::LayeredImage(), metrics::ViewingConditions()));
}

double sum_of(const std::vector<float>& taps) { return std::accumulate(taps.begin(), taps.end(), 0.0); }

TEST(FlipFilters, ContrastWeightsSumToOne) {
  for (const double resolution : {20.0, metrics::kPixelsPerDegree, 150.0})
    for (const auto& filter : metrics::contrast_filters(resolution)) {
      double sum = 0;
      for (const Kernel& kernel : filter.gaussians) sum += sum_of(kernel.taps) * sum_of(kernel.taps);
      EXPECT_NEAR(sum, 1, 1e-6);
    }
}

// sigma = sqrt(b / (2 pi^2)) degrees: 1.03, 1.10, 3.02 and 2.39 pixels at 67 pixels per degree.
TEST(FlipFilters, ContrastWidthsMatchThePublication) {
  const auto filters = metrics::contrast_filters(metrics::kPixelsPerDegree);
  const auto sigma = [](const Kernel& k) {
    const auto middle = static_cast<size_t>(k.radius());
    return std::sqrt(-0.5 / std::log(static_cast<double>(k.taps[middle + 1] / k.taps[middle])));
  };
  EXPECT_NEAR(sigma(filters[0].gaussians[0]), 1.034, 2e-3);
  EXPECT_NEAR(sigma(filters[1].gaussians[0]), 1.098, 2e-3);
  EXPECT_NEAR(sigma(filters[2].gaussians[0]), 3.017, 2e-3);
  EXPECT_NEAR(sigma(filters[2].gaussians[1]), 2.385, 2e-3);
  EXPECT_EQ(filters[0].gaussians[0].radius(), 10);
  // The heights at the centre are proportional to a sqrt(pi / b).
  const auto height = [](const Kernel& k) { return static_cast<double>(k.taps[10] * k.taps[10]); };
  EXPECT_NEAR(height(filters[2].gaussians[0]) / height(filters[2].gaussians[1]), 34.1 / 13.5 * std::sqrt(0.025 / 0.04),
              1e-5);
}

TEST(FlipFilters, DerivativesHaveZeroSum) {
  const auto k = metrics::feature_kernels(metrics::kPixelsPerDegree);
  EXPECT_EQ(k.gaussian.radius(), 9);
  EXPECT_NEAR(sum_of(k.gaussian.taps), 1, 1e-6);
  for (const Kernel* kernel : {&k.edge, &k.point}) {
    double positive = 0, negative = 0;
    for (const float v : kernel->taps) (v > 0 ? positive : negative) += v;
    EXPECT_NEAR(positive, 1, 1e-6);
    EXPECT_NEAR(negative, -1, 1e-6);
  }
}

TEST(Separable, EqualsTheDirectSum) {
  const int w = 23, h = 17;
  Plane in(w, h);
  for (size_t i = 0; i < in.values.size(); ++i) in.values[i] = to_unit_float(mix_bits(static_cast<uint32_t>(i)));
  const auto k = metrics::feature_kernels(40);
  const Plane out = metrics::convolve(in, k.edge, k.point);
  const int r = k.edge.radius();
  for (int y = 0; y < h; ++y)
    for (int x = 0; x < w; ++x) {
      double sum = 0;
      for (int j = -r; j <= r; ++j)
        for (int i = -r; i <= r; ++i)
          sum += static_cast<double>(k.edge.taps[static_cast<size_t>(i + r)]) *
                 k.point.taps[static_cast<size_t>(j + r)] *
                 in.row(std::clamp(y + j, 0, h - 1))[std::clamp(x + i, 0, w - 1)];
      EXPECT_NEAR(out.row(y)[x], sum, 1e-5) << x << " " << y;
    }
}

TEST(Separable, KernelsMayBeWiderThanTheImage) {
  Plane in(2, 1);
  in.values = {1, 1};
  const auto k = metrics::feature_kernels(metrics::kPixelsPerDegree);
  for (const float v : metrics::convolve(in, k.gaussian, k.gaussian).values) EXPECT_NEAR(v, 1, 1e-5);
}

}  // namespace
}  // namespace etendue::test
