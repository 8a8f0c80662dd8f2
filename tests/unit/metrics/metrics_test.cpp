// Error metrics of images against closed forms, and the Viridis colour map.
#include "metrics/metrics.h"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>

#include "spectrum/colormap.h"

namespace etendue::test {
namespace {

using image::LayeredImage;
using metrics::compare;

LayeredImage picture(int width, int height, std::vector<float> rgb) {
  LayeredImage image;
  image.width = width;
  image.height = height;
  image.layers.push_back({"", {"R", "G", "B"}, std::move(rgb)});
  return image;
}

LayeredImage constant(int width, int height, float value) {
  return picture(width, height, std::vector<float>(static_cast<size_t>(width * height * 3), value));
}

TEST(Metrics, ConstantImagesHaveClosedForms) {
  const auto m = compare(constant(8, 4, 1.5f), constant(8, 4, 2));
  ASSERT_TRUE(m) << m.error().message;
  EXPECT_DOUBLE_EQ(m->mse, 0.25);
  EXPECT_DOUBLE_EQ(m->rmse, 0.5);
  EXPECT_NEAR(m->relmse, 0.25 / 4.01, 1e-12);
  EXPECT_DOUBLE_EQ(m->mae, 0.5);
  EXPECT_NEAR(m->smape, 0.5 / 1.75, 1e-9);
  EXPECT_NEAR(m->psnr, 10 * std::log10(16.0), 1e-9);
  EXPECT_DOUBLE_EQ(m->bias, -0.5);
}

TEST(Metrics, MeansAreOverPixelsAndChannels) {
  // Differences 1, -2, 0, 0, 0, 4 with references 0, 2, 1, 1, 1, 4.
  const auto m = compare(picture(2, 1, {1, 0, 1, 1, 1, 8}), picture(2, 1, {0, 2, 1, 1, 1, 4}));
  ASSERT_TRUE(m) << m.error().message;
  EXPECT_DOUBLE_EQ(m->mse, 21.0 / 6);
  EXPECT_DOUBLE_EQ(m->mae, 7.0 / 6);
  EXPECT_DOUBLE_EQ(m->bias, 3.0 / 6);
  EXPECT_NEAR(m->relmse, (1 / 0.01 + 4 / 4.01 + 16 / 16.01) / 6, 1e-9);
  EXPECT_NEAR(m->smape, (2 + 2 + 4.0 / 6) / 6, 1e-9);
  EXPECT_NEAR(m->psnr, 10 * std::log10(16 / 3.5), 1e-9);
}

TEST(Metrics, EqualImagesHaveNoError) {
  const auto m = compare(picture(2, 1, {0, 0, 0, 1, 2, 3}), picture(2, 1, {0, 0, 0, 1, 2, 3}));
  ASSERT_TRUE(m) << m.error().message;
  EXPECT_EQ(m->mse, 0);
  EXPECT_EQ(m->smape, 0);
  EXPECT_EQ(m->bias, 0);
  EXPECT_TRUE(std::isinf(m->psnr) && m->psnr > 0);
}

TEST(Metrics, EqualBlackImagesHaveNoError) {
  const auto m = compare(constant(2, 2, 0), constant(2, 2, 0));
  ASSERT_TRUE(m) << m.error().message;
  EXPECT_EQ(m->relmse, 0);
  EXPECT_EQ(m->smape, 0);
  EXPECT_TRUE(std::isinf(m->psnr) && m->psnr > 0);
}

TEST(Metrics, SmallErrorsOfManyPixelsAreSummedAccurately) {
  // Each squared difference is far below the resolution of a float sum.
  const int side = 1000;
  const auto m = compare(constant(side, side, 1 + 0x1p-10f), constant(side, side, 1));
  ASSERT_TRUE(m) << m.error().message;
  EXPECT_NEAR(m->mse, std::ldexp(1.0, -20), 1e-15);
  EXPECT_NEAR(m->bias, std::ldexp(1.0, -10), 1e-12);
}

TEST(Metrics, IncomparableImagesAreErrors) {
  EXPECT_FALSE(compare(constant(4, 2, 1), constant(2, 4, 1)));
  EXPECT_FALSE(compare(LayeredImage(), LayeredImage()));
  EXPECT_FALSE(compare(picture(1, 1, {0, std::numeric_limits<float>::quiet_NaN(), 0}), constant(1, 1, 1)));
  EXPECT_FALSE(compare(constant(1, 1, 1), picture(1, 1, {std::numeric_limits<float>::infinity(), 0, 0})));
}

TEST(Viridis, HasThePublishedColours) {
  // Entries 0, 68, 153, 204 and 255 of the published table, whose colours are at equal steps of x.
  const std::pair<float, Rgb> published[] = {{0, {0.267004f, 0.004874f, 0.329415f}},
                                             {68 / 255.0f, {0.221989f, 0.339161f, 0.548752f}},
                                             {153 / 255.0f, {0.134692f, 0.658636f, 0.517649f}},
                                             {204 / 255.0f, {0.477504f, 0.821444f, 0.318195f}},
                                             {1, {0.993248f, 0.906157f, 0.143936f}}};
  for (const auto& [x, expected] : published)
    for (int c = 0; c < 3; ++c) EXPECT_NEAR(viridis(x)[c], expected[c], 0.02f) << x;
}

TEST(Viridis, IsClampedAndIncreasesInLuminance) {
  EXPECT_EQ(viridis(-1), viridis(0));
  EXPECT_EQ(viridis(2), viridis(1));
  for (float x = 0; x < 1; x += 0.05f) {
    const auto linear = [](const Rgb& c) {
      return luminance(Rgb(srgb_to_linear(c.r), srgb_to_linear(c.g), srgb_to_linear(c.b)));
    };
    EXPECT_LT(linear(viridis(x)), linear(viridis(x + 0.05f))) << x;
  }
}

}  // namespace
}  // namespace etendue::test
