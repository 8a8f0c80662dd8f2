#include "viewer/viewport/reliability_overlay.h"

#include <imgui.h>

#include <algorithm>

#include "render/document.h"
#include "render/reliability.h"
#include "viewer/state/app_state.h"

namespace etendue::viewer {
namespace {

// Orange, which is visible on most images, for unreliable tiles. The opacity grows with the tail index from 0.5 to 1.
ImU32 tile_color(const render::TileReliability& tile) {
  constexpr double kLow = 0.5;
  constexpr double kHigh = 1;
  const double tail_index = tile.tail.khat.value_or(0);
  const double severity = std::clamp((tail_index - kLow) / (kHigh - kLow), 0.0, 1.0);
  const double opacity = tile.heavy ? 0.35 + 0.35 * severity : 0;
  return IM_COL32(230, 159, 0, static_cast<int>(255 * opacity));
}

}  // namespace

void draw_reliability_overlay(const AppState& state, const render::Reliability& reliability, ImDrawList* draw) {
  const auto& d = state.document();
  const Placement& image = state.viewport.image;
  const Vec2 image_size(d.width, d.height);
  const Vec2 pixel = image.size / image_size;
  const Vec2 tile_size(render::TailStatistics::kWidth, render::TailStatistics::kHeight);
  for (int i = 0; i < static_cast<int>(reliability.tiles.size()); ++i) {
    const Vec2 first = Vec2(i % reliability.columns, i / reliability.columns) * tile_size;
    const Vec2 end = glm::min(first + tile_size, image_size);
    const Vec2 a = image.corner + first * pixel;
    const Vec2 b = image.corner + end * pixel;
    const render::TileReliability& tile = reliability.tiles[static_cast<size_t>(i)];
    draw->AddRectFilled({a.x, a.y}, {b.x, b.y}, tile_color(tile));
    if (tile.heavy) draw->AddRect({a.x, a.y}, {b.x, b.y}, IM_COL32(230, 159, 0, 255));
  }
}

}  // namespace etendue::viewer
