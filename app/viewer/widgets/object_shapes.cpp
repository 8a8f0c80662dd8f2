#include "viewer/widgets/object_shapes.h"

#include <imgui.h>

#include <algorithm>
#include <cmath>

namespace etendue::viewer {
namespace {

ImVec2 point(Vec2 at, float x, float y) { return {at.x + x, at.y + y}; }

// A cube in parallel projection.
void draw_mesh(ImDrawList& draw, Vec2 at, float r, uint32_t color) {
  const float a = 0.72f * r, b = 0.36f * r, width = std::max(1.0f, 0.16f * r);
  const ImVec2 top[] = {point(at, 0, -r * 0.8f), point(at, a, -b), point(at, 0, 0), point(at, -a, -b)};
  draw.AddPolyline(top, 4, color, ImDrawFlags_Closed, width);
  const ImVec2 sides[] = {point(at, -a, -b), point(at, -a, b), point(at, 0, 0.8f * r), point(at, a, b),
                          point(at, a, -b)};
  draw.AddPolyline(sides, 5, color, 0, width);
  draw.AddLine(point(at, 0, 0), point(at, 0, 0.8f * r), color, width);
}

// A disk with rays.
void draw_light(ImDrawList& draw, Vec2 at, float r, uint32_t color) {
  draw.AddCircleFilled({at.x, at.y}, 0.38f * r, color);
  for (int i = 0; i < 8; ++i) {
    const float phi = kPi / 4 * static_cast<float>(i);
    const Vec2 direction(std::cos(phi), std::sin(phi));
    const Vec2 from = at + direction * (0.52f * r), to = at + direction * (0.82f * r);
    draw.AddLine({from.x, from.y}, {to.x, to.y}, color, 1.5f);
  }
}

// A box with the cone of a lens.
void draw_camera(ImDrawList& draw, Vec2 at, float r, uint32_t color) {
  draw.AddRectFilled(point(at, -0.65f * r, -0.4f * r), point(at, 0.2f * r, 0.4f * r), color, 2);
  draw.AddTriangleFilled(point(at, 0.25f * r, 0), point(at, 0.7f * r, -0.4f * r), point(at, 0.7f * r, 0.4f * r), color);
}

// Three connected squares.
void draw_group(ImDrawList& draw, Vec2 at, float r, uint32_t color) {
  const float half = 0.2f * r, width = std::max(1.0f, 0.12f * r);
  const Vec2 root = at + Vec2(-0.5f, -0.5f) * r;
  for (const float y : {-0.1f, 0.55f}) {
    const Vec2 child = at + Vec2(0.4f, y) * r;
    draw.AddLine({root.x, root.y}, {root.x, child.y}, color, width);
    draw.AddLine({root.x, child.y}, {child.x, child.y}, color, width);
    draw.AddRectFilled(point(child, -half, -half), point(child, half, half), color);
  }
  draw.AddRectFilled(point(root, -half, -half), point(root, half, half), color);
}

}  // namespace

void draw_object_shape(ImDrawList& draw, ObjectKind kind, Vec2 at, float r, uint32_t color) {
  constexpr decltype(&draw_mesh) kShapes[] = {draw_group, draw_mesh, draw_light, draw_camera};
  kShapes[static_cast<size_t>(kind)](draw, at, r, color);
}

}  // namespace etendue::viewer
