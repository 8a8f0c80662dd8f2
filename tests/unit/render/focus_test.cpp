// The focus of a session: a region that receives all samples.
#include <gtest/gtest.h>

#include <cmath>
#include <cstring>

#include "film/film_crop.h"
#include "render/session.h"
#include "support/scenes.h"

namespace etendue {
namespace {

using render::PixelRect;

constexpr int kSize = 96;
constexpr PixelRect kFocus{40, 20, 30, 25};
// The blocks of 32 x 16 pixels that contain the focus.
constexpr PixelRect kBlocks{32, 16, 64, 32};

bool contains(const PixelRect& rect, int x, int y) {
  return x >= rect.x && x < rect.right() && y >= rect.y && y < rect.bottom();
}

bool same_pixel(const film::Film& a, const film::Film& b, int x, int y) {
  for (uint32_t half = 0; half < film::kHalfBuffers; ++half)
    if (a.sum(x, y, half) != b.sum(x, y, half) || a.half_buffer_samples(x, y, half) != b.half_buffer_samples(x, y, half))
      return false;
  return true;
}

render::Document document(const char* integrator, uint32_t samples) {
  auto d = test::cornell(kSize);
  d.method.integrator = integrator;
  d.limits.samples = samples;
  return d;
}

TEST(Focus, EnclosingBlocks) {
  EXPECT_EQ(render::enclosing_blocks(kFocus, kSize, kSize), kBlocks);
  EXPECT_EQ(render::enclosing_blocks({90, 90, 6, 6}, 96, 98), (PixelRect{64, 80, 32, 16}));
  EXPECT_EQ(render::enclosing_blocks({90, 90, 6, 8}, 97, 98), (PixelRect{64, 80, 32, 18}));
}

// Pixels inside have the bits of an image with the samples of the region, those outside the bits of an image with the
// samples from before. When the focus ends, all pixels have the bits of an image that never had one.
TEST(Focus, PixelsHaveTheBitsOfImagesWithTheirSampleCounts) {
  for (const char* integrator : {"path", "photonmap", "igi"}) {
    const auto d = document(integrator, 9);
    ASSERT_EQ(render::focus_incompatibility(d), "");
    const auto few = test::rendered(d, render::kSamplesBeforeFocus), all = test::rendered(d, 9);
    render::Session session({.threads = 2});
    session.set_focus(kFocus);
    session.submit(d);
    session.finish();
    const auto film = session.film_copy();
    EXPECT_EQ(session.status().samples, render::kSamplesBeforeFocus);
    EXPECT_EQ(session.status().focus->samples, 9u);
    for (int y = 0; y < kSize; ++y)
      for (int x = 0; x < kSize; ++x)
        ASSERT_TRUE(same_pixel(film, contains(kBlocks, x, y) ? all : few, x, y)) << integrator << ' ' << x << ' ' << y;
    session.set_focus(std::nullopt);
    session.finish();
    EXPECT_EQ(session.status().samples, 9u);
    EXPECT_FALSE(session.status().focus);
    EXPECT_TRUE(test::same_bits(session.film_copy(), all)) << integrator;
  }
}

TEST(Focus, ChangesInTheMiddleOfAnImageLeaveTheSameBits) {
  auto d = document("path", 40);
  const auto all = test::rendered(d, 40);
  render::Session session({.threads = 2});
  session.submit(d);
  for (int i = 0; i < 20; ++i) {
    session.set_focus(PixelRect{2 * i, 3 * i % 40, 20, 20});
    (void)session.film_copy();
  }
  session.set_focus(std::nullopt);
  session.finish();
  EXPECT_TRUE(test::same_bits(session.film_copy(), all));
}

// The error of the region is the root of the mean variance of its pixels, and the error limit refers to it.
TEST(Focus, ErrorOfTheRegion) {
  auto d = document("path", 0);
  constexpr double kLimit = 0.02;
  d.limits.error = kLimit;
  render::Session session({.threads = 2});
  session.set_focus(kFocus);
  session.submit(d);
  session.finish();
  const auto film = session.film_copy();
  double squares = 0;
  for (int y = kFocus.y; y < kFocus.bottom(); ++y)
    for (int x = kFocus.x; x < kFocus.right(); ++x)
      for (int c = 0; c < 3; ++c) squares += static_cast<double>(film.variance_of_mean(x, y)[c]);
  const double expected = std::sqrt(squares / (3.0 * kFocus.width * kFocus.height));
  const auto status = session.status();
  EXPECT_NEAR(status.focus->error.value, expected, 1e-5 * expected);
  EXPECT_LE(status.focus->error.value, kLimit);
  EXPECT_GT(status.measured_error.value, kLimit);  // of the whole image, which has two samples per pixel
}

TEST(Focus, RegionsOutsideTheImageAreIgnored) {
  const auto d = document("path", 5);
  render::Session session({.threads = 2});
  session.set_focus(PixelRect{80, 80, 20, 20});
  session.submit(d);
  session.finish();
  EXPECT_TRUE(test::same_bits(session.film_copy(), test::rendered(d, 5)));
}

TEST(Focus, IncompatibleMethodsSampleTheWholeImage) {
  auto d = document("path", 4);
  EXPECT_EQ(render::focus_incompatibility(d), "");
  d.method.adaptive = render::Adaptive::rmse;
  EXPECT_NE(render::focus_incompatibility(d).find("render.adaptive"), std::string::npos);
  d = document("bdpt", 4);
  render::Session session({.threads = 2});
  session.set_focus(kFocus);
  session.submit(d);
  session.finish();
  EXPECT_EQ(session.status().samples, 4u);
  EXPECT_EQ(session.status().focus->incompatibility, render::focus_incompatibility(d));
  EXPECT_NE(session.status().focus->incompatibility, "");
}

TEST(Focus, CroppedFilmHasTheMeansAndVariancesOfItsPixels) {
  const auto film = test::rendered(test::cornell(32), 6);
  const auto part = film::cropped(film, 3, 5, 20, 11);
  ASSERT_EQ(part.width(), 20);
  ASSERT_EQ(part.height(), 11);
  for (int y = 0; y < 11; ++y)
    for (int x = 0; x < 20; ++x) {
      EXPECT_EQ(part.mean(x, y), film.mean(x + 3, y + 5));
      EXPECT_EQ(part.variance_of_mean(x, y), film.variance_of_mean(x + 3, y + 5));
    }
}

}  // namespace
}  // namespace etendue
