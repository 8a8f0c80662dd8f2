#include "scene/atmosphere_medium.h"

#include <algorithm>
#include <cmath>

namespace etendue::scene {

RayInterval AtmosphereMedium::inside(const Ray& ray, const RayInterval& interval) const {
  if (!std::isfinite(radius)) return interval;
  const Vec3 offset = ray.origin - centre;
  const double a = glm::dot(ray.direction, ray.direction), b = glm::dot(offset, ray.direction),
               c = static_cast<double>(glm::dot(offset, offset)) - static_cast<double>(radius) * radius;
  const double discriminant = b * b - a * c;
  if (!(discriminant > 0)) return {};
  const double root = std::sqrt(discriminant);
  return {std::max(interval.from, static_cast<float>((-b - root) / a)),
          std::min(interval.to, static_cast<float>((-b + root) / a))};
}

float AtmosphereMedium::length_inside(const Ray& ray, const RayInterval& interval) const {
  const RayInterval part = inside(ray, interval);
  if (part.empty()) return 0;
  return (part.to - part.from) * std::sqrt(glm::dot(ray.direction, ray.direction));
}

}  // namespace etendue::scene
