// The test surface of the analysis: the BSDF lobes at one surface point, and directions and random numbers to probe it.
#pragma once
#include <functional>

#include "material/gltf_surface.h"

namespace etendue::bsdf_analysis {

using Lobes = AllLobes<Rgb>;

// The lobes of a material without its textures: its constant factors only.
Lobes lobes_of(const Material& material);

// A unit direction at the polar angle `degrees` from the normal; above 90 it points below the surface.
Vec3 direction(double degrees, double azimuth_degrees = 0);

// Index of refraction below the surface divided by that above, determined from samples; 1 if no sample is refracted.
float relative_eta(const Lobes& lobes);

// True if samples at normal incidence cross the surface.
bool transmits_light(const Lobes& lobes);

// Random numbers of one sample of the lobes: point i of the additive recurrence R3 [Roberts 2018], shifted by a random
// offset that depends on the replicate.
LobeRandom draw_of(uint32_t replicate, uint32_t i);

// Called repeatedly during an analysis, which stops when it returns false; an empty function never stops it.
using KeepGoing = std::function<bool()>;
inline bool should_continue(const KeepGoing& keep_going) { return !keep_going || keep_going(); }

}  // namespace etendue::bsdf_analysis
