// The scenes that the program brings along; "cornell" opens when no file is named. Each is there because methods of
// light transport differ on it.
#pragma once
#include <string>
#include <string_view>
#include <vector>

#include "base/result.h"
#include "scene/scene.h"

namespace etendue::scene {

struct Builtin {
  const char* name;   // as a command takes it in the place of a file
  const char* label;  // as a menu shows it
  const char* doc;    // one sentence: why it is there
  Scene (*make)();
};

// All of them, the simplest first.
const std::vector<Builtin>& builtins();
const Builtin* find_builtin(std::string_view name);
// Their names with commas between them.
std::string builtin_names();

// A scene by file name, or by the name of a built-in one.
Result<Scene> load(const std::string& file_or_name);

}  // namespace etendue::scene
