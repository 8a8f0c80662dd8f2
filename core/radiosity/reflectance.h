// Reflectances of patches.                                                              [Lang, eq. 10.28-10.31]
#pragma once
#include <string>
#include <vector>

#include "radiosity/patch_mesh.h"
#include "spectrum/rgb.h"

namespace etendue::radiosity {

// The reflectance of every patch: the mean of the base colour over the patch, from a few points if it
// has a texture or vertex colours. Both elements of a patch have the same reflectance.
std::vector<Rgb> patch_reflectances(const scene::CompiledScene& scene, const PatchMesh& mesh);

// The name of a used material that is not Lambertian; empty if all are.
std::string non_diffuse_material(const scene::CompiledScene& scene);

}  // namespace etendue::radiosity
