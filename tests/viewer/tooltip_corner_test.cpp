// Where tooltips are placed.
#include <gtest/gtest.h>

#include "viewer/widgets/tooltip_corner.h"

namespace etendue::viewer::tooltip_corner_test {
namespace {

constexpr float kGap = 5;

bool covers(const Placement& tooltip, const Placement& item) {
  const Vec2 common = intersection(tooltip, item).size;
  return common.x > 0 && common.y > 0;
}

// Items of many sizes at many places of the window, corners and edges included, with the pointer anywhere on them.
TEST(TooltipCorner, NoItemIsCovered) {
  const Vec2 sizes[] = {{20, 16}, {60, 20}, {370, 20}, {100, 100}, {256, 256}, {6, 500}, {400, 300}};
  const Vec2 tooltips[] = {{60, 30}, {380, 60}, {276, 310}};
  int placed = 0;
  for (const Vec2 screen : {Vec2(800, 600), Vec2(1280, 720)})
    for (const Vec2 size : sizes)
      for (const Vec2 tooltip : tooltips)
        for (const Vec2 place : {Vec2(0, 0), Vec2(1, 0), Vec2(0, 1), Vec2(1, 1), Vec2(0.5f, 0.5f), Vec2(0, 0.5f),
                                 Vec2(1, 0.5f), Vec2(0.5f, 1), Vec2(0.8f, 0.3f)})
          for (const Vec2 share : {Vec2(0, 0), Vec2(0.99f, 0.99f), Vec2(0.5f, 0.5f)}) {
            const Placement item{place * (screen - size), size};
            const Vec2 pointer = item.corner + share * size;
            const auto corner = tooltip_corner(item, tooltip, screen, pointer, kGap);
            if (!corner) continue;
            ++placed;
            EXPECT_FALSE(covers({*corner, tooltip}, item)) << item.corner.x << ", " << item.corner.y;
            EXPECT_GE(corner->x, 0);
            EXPECT_GE(corner->y, 0);
            EXPECT_LE(corner->x + tooltip.x, screen.x);
            EXPECT_LE(corner->y + tooltip.y, screen.y);
          }
  EXPECT_GT(placed, 1000) << "nearly all have a place";
}

TEST(TooltipCorner, BelowOtherwiseAboveOtherwiseBeside) {
  const Vec2 screen(800, 600);
  const auto place = [&](const Placement& item, Vec2 size) {
    return tooltip_corner(item, size, screen, item.corner + item.size * 0.5f, kGap).value_or(Vec2(-1));
  };
  EXPECT_EQ(place({{300, 100}, {100, 20}}, {60, 30}), Vec2(320, 125)) << "below, centred at the pointer";
  EXPECT_EQ(place({{300, 100}, {100, 20}}, {200, 30}), Vec2(300, 125)) << "not to the left of the item";
  EXPECT_EQ(place({{740, 100}, {50, 20}}, {200, 30}), Vec2(600, 125)) << "in the window";
  EXPECT_EQ(place({{300, 570}, {100, 20}}, {60, 30}), Vec2(320, 535)) << "above";
  EXPECT_EQ(place({{0, 100}, {500, 400}}, {276, 300}), Vec2(505, 150)) << "to the right";
  EXPECT_EQ(place({{300, 100}, {500, 400}}, {276, 300}), Vec2(19, 150)) << "to the left";
  EXPECT_EQ(place({{700, 20}, {6, 500}}, {60, 30}), Vec2(711, 255)) << "beside an upright item, at the pointer";
}

TEST(TooltipCorner, NothingWithoutRoom) {
  EXPECT_FALSE(tooltip_corner({{10, 10}, {780, 580}}, {60, 30}, {800, 600}, {400, 300}, kGap));
  EXPECT_FALSE(tooltip_corner({{10, 10}, {60, 20}}, {900, 30}, {800, 600}, {20, 20}, kGap));
}

}  // namespace
}  // namespace etendue::viewer::tooltip_corner_test
