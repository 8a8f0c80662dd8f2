#include "light/environments/builtin_environment.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <mutex>

#include "light/environments/overcast.h"
#include "light/environments/studio.h"
#include "light/environments/sunset.h"
#include "light/environments/uniform.h"

namespace etendue {
namespace {

constexpr BuiltinEnvironment kEnvironments[] = {kStudio, kOvercast, kSunset, kUniform};

constexpr int kWidth = 512, kHeight = 256;

std::shared_ptr<const image::Image> make_map(const BuiltinEnvironment& builtin) {
  auto map = std::make_shared<image::Image>();
  map->width = kWidth;
  map->height = kHeight;
  map->channels = 3;
  map->type = image::PixelType::float32;
  map->floats.reserve(size_t{3} * kWidth * kHeight);
  for (int y = 0; y < kHeight; ++y)
    for (int x = 0; x < kWidth; ++x) {
      const float phi = ((static_cast<float>(x) + 0.5f) / kWidth - 0.5f) * 2 * kPi;
      const float theta = (static_cast<float>(y) + 0.5f) / kHeight * kPi;
      const Vec3 direction(std::cos(phi) * std::sin(theta), std::cos(theta), std::sin(phi) * std::sin(theta));
      const Rgb radiance = builtin.radiance(direction);
      map->floats.insert(map->floats.end(), {radiance.r, radiance.g, radiance.b});
    }
  return map;
}

}  // namespace

std::span<const BuiltinEnvironment> builtin_environments() { return kEnvironments; }

const BuiltinEnvironment* find_builtin_environment(std::string_view name) {
  const auto found = std::ranges::find(kEnvironments, name, &BuiltinEnvironment::name);
  return found == std::end(kEnvironments) ? nullptr : found;
}

Environment make_environment(const BuiltinEnvironment& builtin) {
  if (!builtin.radiance) return {.map = nullptr, .file = "", .tint = Rgb(1)};
  static std::array<std::shared_ptr<const image::Image>, std::size(kEnvironments)> maps;
  static std::array<std::once_flag, std::size(kEnvironments)> made;
  const auto index = static_cast<size_t>(find_builtin_environment(builtin.name) - std::begin(kEnvironments));
  std::call_once(made[index], [&] { maps[index] = make_map(builtin); });
  return {.map = maps[index], .file = builtin.name, .tint = Rgb(1)};
}

}  // namespace etendue
