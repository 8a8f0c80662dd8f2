// Where the light of a scene goes: light paths that record the flux that objects emit, receive and absorb.
//
// The flux of a light path is followed to its end. At each surface vertex a BSDF sample of weight w leaves the part w of
// the flux in the path and gives the part 1 - w to the object. Flux that leaves the scene escapes; what a path loses
// between two vertices is absorbed by the media there. In expectation
//
//   emitted = absorbed by objects + absorbed by media + escaped
//
// as Russian roulette preserves the mean of the flux. An object that scatters more flux than it receives creates energy.
#pragma once
#include <array>
#include <vector>

#include "integrator/integrator.h"

namespace etendue::integrator {

// Sums over light paths, in lm by channel.
struct ObjectFlux {
  std::array<double, 3> emitted{}, received{}, absorbed{};
};

struct EnergySums {
  std::vector<ObjectFlux> objects;  // by node of the scene
  ObjectFlux media;                 // emission and absorption between surfaces
  std::array<double, 3> point_lights{}, environment{}, escaped{};
  // Flux that the range of point lights (KHR_lights_punctual) removes.
  std::array<double, 3> beyond_range{};
};

// Traces `count` light paths of a sample and adds their flux, each path divided by `count`. Paths have at most kMostVertices
// vertices. False if it was cancelled.
bool add_energy(const RenderContext& context, uint32_t sample, uint32_t first_path, int count,
                const TaskContext& task_context, EnergySums& sums);

inline constexpr int kMostVertices = 4096;

}  // namespace etendue::integrator
