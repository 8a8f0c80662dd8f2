// Where the picture has tails: a veil over the tiles that the verdict of its health rests on.
#include <imgui.h>

#include "viewer/layout/interface.h"

namespace etendue::viewer {
namespace {

// From a hint of doubt to certainty; orange on any picture, more of it where the tail is heavier.
ImU32 veil(const render::TileReliability& tile) {
  constexpr double kDoubt = 0.5, kSure = 1;
  const double khat = tile.tail.khat.value_or(0), doubt = std::clamp((khat - kDoubt) / (kSure - kDoubt), 0.0, 1.0);
  const double opacity = tile.heavy ? 0.35 + 0.35 * doubt : 0.25 * doubt;
  return IM_COL32(230, 159, 0, static_cast<int>(255 * opacity));
}

}  // namespace

void draw_health_map(const Workbench& w, const render::Reliability& health, ImDrawList* draw) {
  const auto& d = w.editor.document();
  const Placement& p = w.view.picture;
  const Vec2 pixel = p.size / Vec2(d.width, d.height);
  for (int tile = 0; tile < static_cast<int>(health.tiles.size()); ++tile) {
    const Vec2 first(tile % health.across * render::TailStatistics::kWidth,
                     tile / health.across * render::TailStatistics::kHeight);
    const Vec2 end = glm::min(first + Vec2(render::TailStatistics::kWidth, render::TailStatistics::kHeight),
                              Vec2(d.width, d.height));
    const Vec2 a = p.corner + first * pixel, b = p.corner + end * pixel;
    const render::TileReliability& state = health.tiles[static_cast<size_t>(tile)];
    draw->AddRectFilled({a.x, a.y}, {b.x, b.y}, veil(state));
    if (state.heavy) draw->AddRect({a.x, a.y}, {b.x, b.y}, IM_COL32(230, 159, 0, 255));
  }
}

}  // namespace etendue::viewer
