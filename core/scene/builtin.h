// The scenes that the program brings along; "cornell" opens when no file is named.
#pragma once
#include <string_view>

#include "base/result.h"
#include "scene/scene.h"

namespace etendue::scene {

// The Cornell box from its published geometry and reflectances (Cornell University Program of Computer Graphics, 1998).
Scene cornell_box();

// A scene by file name, or by the name of a built-in one ("cornell").
Result<Scene> load(const std::string& file_or_name);

}  // namespace etendue::scene
