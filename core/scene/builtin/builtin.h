// The built-in scenes. "cornell" opens when no file is named. Each scene shows a difference between integrators.
//
// To add one, write a header that ends with a constant of type Builtin and list the constant in builtin.cpp.
#pragma once
#include <string>
#include <string_view>
#include <vector>

#include "base/result.h"
#include "scene/gltf/load_gltf.h"
#include "scene/scene.h"

namespace etendue::scene {

struct Builtin {
  const char* name;   // accepted by commands in place of a file
  const char* label;  // shown in menus
  const char* doc;    // one sentence without a full stop: what the scene shows
  Scene (*make)();
};

// The name of the empty scene.
inline constexpr const char* kNewScene = "new";

// All built-in scenes, the simplest first.
const std::vector<Builtin>& builtins();
// Null if there is no scene with this name. "new" is the empty scene, which is not in the list.
const Builtin* find_builtin(std::string_view name);
// All names, separated by commas.
std::string builtin_names();

// Loads a built-in scene by its name, or a glTF file, to which the options apply.
Result<Scene> load(const std::string& file_or_name, const LoadOptions& options = {});

}  // namespace etendue::scene
