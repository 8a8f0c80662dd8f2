#include "light/environments/builtin_environment.h"

#include <algorithm>
#include <array>
#include <mutex>

#include "light/environments/hosek_sky.h"
#include "light/environments/map_of_radiance.h"
#include "light/environments/overcast.h"
#include "light/environments/sky.h"
#include "light/environments/studio.h"
#include "light/environments/sunset.h"
#include "light/environments/uniform.h"

namespace etendue {
namespace {

constexpr BuiltinEnvironment kEnvironments[] = {kStudio, kOvercast, kSunset, kSky, kHosekSky, kUniform};

}  // namespace

std::span<const BuiltinEnvironment> builtin_environments() { return kEnvironments; }

const BuiltinEnvironment* find_builtin_environment(std::string_view name) {
  const auto found = std::ranges::find(kEnvironments, name, &BuiltinEnvironment::name);
  return found == std::end(kEnvironments) ? nullptr : found;
}

Environment make_environment(const BuiltinEnvironment& builtin) {
  if (builtin.make) return builtin.make();
  if (!builtin.radiance) return {.map = nullptr, .file = "", .tint = Rgb(1)};
  static std::array<std::shared_ptr<const image::Image>, std::size(kEnvironments)> maps;
  static std::array<std::once_flag, std::size(kEnvironments)> made;
  const auto index = static_cast<size_t>(find_builtin_environment(builtin.name) - std::begin(kEnvironments));
  std::call_once(made[index], [&] { maps[index] = environment_map_of(builtin.radiance); });
  return {.map = maps[index], .file = builtin.name, .tint = Rgb(1)};
}

}  // namespace etendue
