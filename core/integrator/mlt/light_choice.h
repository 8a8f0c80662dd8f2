// The choice of a light for the vertex that it is connected to: by the light tree where that pays, otherwise by power.
#pragma once
#include "integrator/mlt/light_path.h"
#include "transport/wavefront/receiver_normal.h"

namespace etendue::integrator {

inline constexpr LightStrategy kConnectedLight = LightStrategy::emission_auto;

// Whether the light tree pays in this scene.
inline bool chooses_lights_for_receivers(const scene::CompiledScene& scene) {
  return scene.lights().uses_normals(kConnectedLight);
}

// x_1 as a receiver of light, from its point and its direction to the camera.
template <class M>
LightReceiver receiver_of_light(const LightPath<M>& path) {
  const scene::SurfacePoint& point = path[1].point;
  return {point.position, transport::receiver_normal(point, path.direction_to_camera(1))};
}

// The probability with which the light of a path is chosen for x_1, relative to that by its power. 1 for lights that are
// chosen by neither, such as emitters that only camera subpaths hit.
template <class M>
float choice_for_receiver(const scene::CompiledScene& scene, const LightPath<M>& path) {
  if (path.edges() == 1 || !chooses_lights_for_receivers(scene)) return 1;
  const LightTable& lights = scene.lights();
  const uint32_t light = path.light.kind == LightKind::environment ? lights.environment_number() : path.light.number;
  if (light == LightPath<M>::Light::kUnlisted) return 1;
  const float by_power = lights.emission_probability(light);
  return by_power > 0 ? lights.probability(light, receiver_of_light(path), kConnectedLight) / by_power : 1;
}

}  // namespace etendue::integrator
