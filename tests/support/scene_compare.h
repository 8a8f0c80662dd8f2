// The first difference between two scenes that a glTF file can express, as one line; empty if there is none.
//
// Not compared: the names of the file and of its other scenes, warnings, the appended default material, meshes without
// triangles, and the scale of missing normal maps.
#pragma once
#include <string>

#include "scene/scene.h"

namespace etendue::test {

std::string difference(const scene::Scene& a, const scene::Scene& b);

}  // namespace etendue::test
