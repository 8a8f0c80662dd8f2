// Where two scenes differ, as a file of glTF can tell them apart: one line, empty if nowhere.
//
// Not compared: the name of the file and of its other scenes, warnings, what the loader puts at the end for primitives
// without a material, meshes without triangles, strengths of normal maps that are not there.
#pragma once
#include <string>

#include "scene/scene.h"

namespace etendue::test {

std::string difference(const scene::Scene& a, const scene::Scene& b);

}  // namespace etendue::test
