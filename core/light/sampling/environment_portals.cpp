#include "light/sampling/environment_portals.h"

#include <algorithm>
#include <cmath>

namespace etendue {
namespace {

bool faces(const EnvironmentPortal& portal, const Vec3& from) {
  return glm::dot(from - portal.centre, portal.normal) > 0;
}

float area_of(const EnvironmentPortal& portal) { return 4 * glm::length(portal.half_x) * glm::length(portal.half_y); }

// The density of a point uniform over the portal, per solid angle; 0 if the direction misses it.
float pdf_through(const EnvironmentPortal& portal, const Vec3& from, const Vec3& direction) {
  const float facing = -glm::dot(direction, portal.normal);
  const float height = glm::dot(from - portal.centre, portal.normal);
  if (!(facing > 0) || !(height > 0)) return 0;
  const float distance = height / facing;
  const Vec3 at = from + distance * direction - portal.centre;
  const float x = glm::dot(at, portal.half_x) / length_squared(portal.half_x);
  const float y = glm::dot(at, portal.half_y) / length_squared(portal.half_y);
  if (std::abs(x) > 1 || std::abs(y) > 1) return 0;
  const float pdf = sqr(distance) / (facing * area_of(portal));
  return pdf < kInfinity ? pdf : 0;
}

}  // namespace

EnvironmentPortals::EnvironmentPortals(std::vector<EnvironmentPortal> portals) : portals_(std::move(portals)) {
  std::erase_if(portals_, [](const EnvironmentPortal& p) { return !(area_of(p) > 0) || !(area_of(p) < kInfinity); });
}

int EnvironmentPortals::facing(const Vec3& from) const {
  return static_cast<int>(std::ranges::count_if(portals_, [&](const auto& portal) { return faces(portal, from); }));
}

Vec3 EnvironmentPortals::sample(const Vec3& from, Vec2 u) const {
  const int count = facing(from);
  const float scaled = u.x * static_cast<float>(count);
  int skip = std::min(static_cast<int>(scaled), count - 1);
  const float x = 2 * (scaled - static_cast<float>(skip)) - 1;
  for (const EnvironmentPortal& portal : portals_)
    if (faces(portal, from) && skip-- == 0)
      return normalize_or(portal.centre + x * portal.half_x + (2 * u.y - 1) * portal.half_y - from, -portal.normal);
  return Vec3(0, 1, 0);
}

float EnvironmentPortals::pdf(const Vec3& from, const Vec3& direction) const {
  float sum = 0;
  for (const EnvironmentPortal& portal : portals_) sum += pdf_through(portal, from, direction);
  const int count = facing(from);
  return count > 0 ? sum / static_cast<float>(count) : 0;
}

}  // namespace etendue
