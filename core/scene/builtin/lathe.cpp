#include "scene/builtin/lathe.h"

namespace etendue::scene {

std::shared_ptr<const Mesh> lathe(std::span<const OutlinePoint> outline, int segments) {
  auto mesh = std::make_shared<Mesh>();
  // Points on the axis have one vertex, all others a ring.
  std::vector<uint32_t> first;
  const auto on_axis = [&](size_t i) { return outline[i].position.x == 0; };
  for (size_t i = 0; i < outline.size(); ++i) {
    first.push_back(static_cast<uint32_t>(mesh->positions.size()));
    const auto& [p, n] = outline[i];
    for (int j = 0; j < (on_axis(i) ? 1 : segments); ++j) {
      const float phi = 2 * kPi * static_cast<float>(j) / static_cast<float>(segments);
      const float x = std::cos(phi), z = -std::sin(phi);
      mesh->positions.emplace_back(p.x * x, p.y, p.x * z);
      mesh->normals.push_back(glm::normalize(Vec3(n.x * x, n.y, n.x * z)));
    }
  }
  const auto at = [&](size_t i, int j) { return first[i] + static_cast<uint32_t>(on_axis(i) ? 0 : j % segments); };
  for (size_t i = 0; i + 1 < outline.size(); ++i) {
    if (outline[i].position == outline[i + 1].position) continue;
    for (int j = 0; j < segments; ++j) {
      if (!on_axis(i)) mesh->triangles.push_back({at(i, j), at(i, j + 1), at(i + 1, j + 1)});
      if (!on_axis(i + 1)) mesh->triangles.push_back({at(i, j), at(i + 1, j + 1), at(i + 1, j)});
    }
  }
  mesh->positions.reserve(mesh->positions.size() + 1);
  return mesh;
}

std::shared_ptr<const Mesh> ball(float radius, int rings) { return egg(radius, radius, radius, rings); }

std::shared_ptr<const Mesh> egg(float radius, float below, float above, int rings) {
  std::vector<OutlinePoint> outline;
  for (int i = 0; i <= rings; ++i) {
    const float latitude = kPi * (static_cast<float>(i) / static_cast<float>(rings) - 0.5f);
    const float height = latitude < 0 ? below : above;
    const float x = i == 0 || i == rings ? 0 : std::cos(latitude), y = std::sin(latitude);
    outline.push_back({{radius * x, height * y}, {x / radius, y / height}});
  }
  return lathe(outline, 2 * rings);
}

std::vector<OutlinePoint> smooth_outline(std::span<const Vec2> points, int steps) {
  std::vector<OutlinePoint> outline;
  // Beyond its ends the curve continues as its mirror image about the axis.
  const auto point = [&](size_t i) {
    if (i == 0) return Vec2(-points[1].x, points[1].y);
    if (i > points.size()) return Vec2(-points[points.size() - 2].x, points[points.size() - 2].y);
    return points[i - 1];
  };
  for (size_t i = 1; i < points.size(); ++i) {
    const Vec2 p0 = point(i - 1), p1 = point(i), p2 = point(i + 1), p3 = point(i + 2);
    const Vec2 m1 = 0.5f * (p2 - p0), m2 = 0.5f * (p3 - p1);
    for (int k = i == 1 ? 0 : 1; k <= steps; ++k) {
      const float t = static_cast<float>(k) / static_cast<float>(steps), u = 1 - t;
      const Vec2 p = (1 + 2 * t) * u * u * p1 + t * u * u * m1 + t * t * (3 - 2 * t) * p2 - t * t * u * m2;
      const Vec2 d = 6 * t * u * (p2 - p1) + u * (1 - 3 * t) * m1 - t * (2 - 3 * t) * m2;
      outline.push_back({{std::max(0.0f, p.x), p.y}, {d.y, -d.x}});
    }
  }
  return outline;
}

}  // namespace etendue::scene
