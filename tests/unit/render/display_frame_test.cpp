// Previews are enlarged by interpolation between the centres of their blocks.
#include "render/display_frame.h"

#include <gtest/gtest.h>

namespace etendue::render {
namespace {

// A preview whose blocks have these radiances, the same in all channels and rows.
Preview preview_of(std::initializer_list<float> columns, int height, int scale) {
  Preview preview{.width = static_cast<int>(columns.size()), .height = height, .scale = scale, .blocks = {}};
  for (int y = 0; y < height; ++y)
    for (const float x : columns) preview.blocks.emplace_back(x / (1 + x));
  return preview;
}

TEST(PreviewFrame, AConstantStaysConstantAlsoBeyondTheBlocks) {
  ThreadPool workers(2);
  const auto frame = FrameMaker(workers).enlarged(preview_of({3, 3, 3}, 2, 4), 14, 9);
  ASSERT_EQ(frame->pixels->size(), 14U * 9);
  for (const Rgb& pixel : *frame->pixels) EXPECT_NEAR(pixel.g, 3, 1e-5);
  EXPECT_EQ(frame->preview_scale, 4);
}

TEST(PreviewFrame, ValuesRunFromOneCentreToTheNext) {
  ThreadPool workers(1);
  constexpr int kScale = 8;
  const auto frame = FrameMaker(workers).enlarged(preview_of({0, 1, 0.25f}, 1, kScale), 3 * kScale, 1);
  const auto at = [&](int x) { return (*frame->pixels)[static_cast<size_t>(x)].r; };
  for (int x = 0; x < kScale / 2; ++x) EXPECT_EQ(at(x), 0) << x;
  for (int x = kScale / 2; x < kScale * 3 / 2; ++x) EXPECT_GT(at(x), at(x - 1)) << x;
  for (int x = kScale * 3 / 2 + 1; x < kScale * 5 / 2; ++x) EXPECT_LT(at(x), at(x - 1)) << x;
  // Half a pixel from the centre of the second block, whose compressed value is 1/2.
  const float beside = 0.5f * (1 - 0.5f / kScale);
  EXPECT_NEAR(at(kScale * 3 / 2 - 1), beside / (1 - beside), 1e-5);
  EXPECT_NEAR(at(3 * kScale - 1), 0.25f, 1e-6);
}

}  // namespace
}  // namespace etendue::render
