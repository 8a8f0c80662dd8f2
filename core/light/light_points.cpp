#include "light/light_points.h"

#include "base/frame.h"

namespace etendue {
namespace {

constexpr float kGolden = 0.6180340f;

// Of the node's own space, in which it shines along -z.
LightPlace point(const Light& light, int k) {
  const float part = (static_cast<float>(k) + 0.5f) / static_cast<float>(light.points);
  float turns = kGolden * static_cast<float>(k);
  turns -= std::floor(turns);
  const Vec2 around(std::cos(2 * kPi * turns), std::sin(2 * kPi * turns));
  LightPlace place;
  switch (light.type) {
    case LightType::disk:
      place.position = Vec3(light.radius * std::sqrt(part) * around, 0);
      break;
    case LightType::sphere: {
      const float z = 1 - 2 * part;
      place.direction = Vec3(safe_sqrt(1 - z * z) * around, z);
      place.position = light.radius * place.direction;
      break;
    }
    default:
      place.position =
          Vec3((part - 0.5f) * light.width, (turns + 0.5f / static_cast<float>(light.points) - 0.5f) * light.height, 0);
  }
  return place;
}

Mat4 node_of(const Vec3& position, const Vec3& direction) {
  const Frame frame(-direction);
  return {Vec4(frame.x, 0), Vec4(frame.y, 0), Vec4(frame.z, 0), Vec4(position, 1)};
}

}  // namespace

std::vector<PlacedLight> points_of(const Light& light, const Mat4& node, const std::shared_ptr<const Motion>& motion) {
  PlacedLight lamp;
  lamp.light.name = light.name;
  lamp.light.type = LightType::spot, lamp.light.profile = SpotProfile::cosine,
  lamp.light.exponent = 1 + light.cosine_exponent;
  lamp.light.inner_cone = lamp.light.outer_cone = kPi / 2;
  lamp.light.color = light.radiance(), lamp.light.intensity = light.area() / static_cast<float>(light.points);
  std::vector<PlacedLight> lamps;
  for (int k = 0; k < light.points; ++k) {
    const LightPlace at = point(light, k);
    for (int side = 0; side < light.sides(); ++side) {
      const Mat4 local = node_of(at.position, side == 0 ? at.direction : -at.direction);
      if (motion) {
        auto moved = std::make_shared<Motion>();
        for (const Mat4& m : motion->to_world) moved->to_world.push_back(without_scale(m) * local);
        lamp.place = LightPlace(moved->matrix_at(0.5f)), lamp.motion = std::move(moved);
      } else {
        lamp.place = LightPlace(without_scale(node) * local);
      }
      lamps.push_back(lamp);
    }
  }
  return lamps;
}

}  // namespace etendue
