#include "viewer/widgets/tooltip_corner.h"

#include <array>

namespace etendue::viewer {

std::optional<Vec2> tooltip_corner(const Placement& item, Vec2 size, Vec2 screen, Vec2 pointer, float gap) {
  constexpr float kUpright = 2;  // ratio of height to width
  const Vec2 end = item.corner + item.size;
  // Along a side of the item: centred at the pointer, in the window, and not in front of the item's corner.
  const Vec2 along = glm::max(glm::min(glm::max(item.corner, pointer - size * 0.5f), screen - size), Vec2(0));
  const Vec2 below(along.x, end.y + gap), above(along.x, item.corner.y - gap - size.y);
  const Vec2 right(end.x + gap, along.y), left(item.corner.x - gap - size.x, along.y);
  const bool is_upright = item.size.y > kUpright * item.size.x;
  const auto places = is_upright ? std::array{right, left, below, above} : std::array{below, above, right, left};
  for (const Vec2& corner : places)
    if (corner.x >= 0 && corner.y >= 0 && corner.x + size.x <= screen.x && corner.y + size.y <= screen.y) return corner;
  return std::nullopt;
}

}  // namespace etendue::viewer
