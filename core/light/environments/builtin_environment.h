// Environments that the program computes, so that a scene without lights can be seen.
//
// Each is one header with a description and its radiance, and one line in registry.cpp.
#pragma once
#include <span>
#include <string_view>

#include "base/vec.h"
#include "light/environment.h"

namespace etendue {

struct BuiltinEnvironment {
  const char* name;
  const char* label;
  const char* doc;
  // cd/m^2, from a unit direction; +y is up and +z is the front of an object. Null: 1 from all directions.
  Rgb (*radiance)(const Vec3& direction);
  // For an environment with parameters, instead of `radiance`: with their defaults.
  Environment (*make)() = nullptr;
};

// In the order in which they are offered; the first one lights scenes without lights.
std::span<const BuiltinEnvironment> builtin_environments();

// Null if there is none of this name.
const BuiltinEnvironment* find_builtin_environment(std::string_view name);

// The environment with its map, whose file is the name; a uniform one has no map. Maps are computed once.
Environment make_environment(const BuiltinEnvironment& builtin);

}  // namespace etendue
