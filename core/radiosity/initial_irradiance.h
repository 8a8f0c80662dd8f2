// Direct irradiance of elements: the light of all lights, sampled by shadow rays.          [Lang, eq. 10.25, 9.21-9.23]
//
// Area lights, lights without extent and the environment enter the radiosity equation in this way, so that shadows of
// direct light do not depend on form factors.
#pragma once
#include <span>

#include "radiosity/patch_mesh.h"
#include "sampling/sampler.h"
#include "spectrum/rgb.h"

namespace etendue::radiosity {

// The mean irradiance of an element, W/m^2, from `samples` pairs of a point and a light sample. `rays` is increased by
// the number of shadow rays.
Rgb direct_irradiance(const scene::CompiledScene& scene, const PatchMesh& mesh, const Sampler& sampler,
                      uint32_t element, uint32_t samples, uint64_t seed, uint64_t& rays);

// The irradiance at up to 64 points of an element, with the same random numbers at all of them: differences then come
// from shadows, distances and angles, and less from noise.
void irradiance_at_points(const scene::CompiledScene& scene, const PatchMesh& mesh, const Sampler& sampler,
                          uint32_t element, std::span<const Vec3> points, uint32_t samples, uint64_t seed,
                          std::span<Rgb> irradiance, uint64_t& rays);

}  // namespace etendue::radiosity
