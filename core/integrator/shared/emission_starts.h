// Starts of light paths: on lights, and in media that emit.
#pragma once
#include "scene/compiled_scene.h"

namespace etendue::integrator {

// The probability that a light path starts in a medium, in proportion to the powers.
inline float share_of_media(const scene::CompiledScene& scene) {
  const float media = scene.solids().emission_points().power(), lights = scene.lights().power();
  return media > 0 ? media / (media + lights) : 0;
}

// A start at a point of a medium that emits, sampled by its power, in a uniform direction. The flux per volume is 4 pi
// times the emission coefficient. `third` is a further uniform number. Returns the solids around the point.
inline scene::MediumStack sample_start_in_medium(const scene::CompiledScene& scene, const EmissionRandom& random,
                                                 float third, float media_share, Emission& e) {
  const MediumEmitters::Point point =
      scene.solids().emission_points().sample_point(random.choice, Vec3(random.point, third));
  const scene::MediumStack stack = scene.solids().containing(scene.instances(), point.position, random.time);
  e.kind = LightKind::medium;
  e.light = scene::InstanceData::kNotALight;
  e.time = random.time;
  e.position = point.position;
  e.direction = square_to_sphere(random.direction);
  e.radiance = scene.solids().emission_at(stack, point.position);
  e.density = {point.pdf * media_share, 1 / (4 * kPi), false, false};
  if (point.pdf > 0) e.weight = 4 * kPi / e.density.first;
  return stack;
}

// A start on a light, which the light tree chooses for a receiver. Without a receiver, it is chosen by its power.
inline void sample_light_start(const scene::CompiledScene& scene, const EmissionRandom& random,
                               const LightReceiver* receiver, Emission& e) {
  receiver ? scene.lights().sample_emission_by_tree(*receiver, random, e) : scene.lights().sample_emission(random, e);
}

// A start in a medium with the probability `media_share`, otherwise on a light. The kind of the emission states which;
// `stack` is set in media only.
inline void sample_start(const scene::CompiledScene& scene, EmissionRandom random, float third, float media_share,
                         Emission& e, scene::MediumStack& stack, const LightReceiver* receiver = nullptr) {
  if (random.choice < media_share) {
    random.choice /= media_share;
    stack = sample_start_in_medium(scene, random, third, media_share, e);
    return;
  }
  const float light_share = 1 - media_share;
  random.choice = std::min((random.choice - media_share) / light_share, kOneMinusEpsilon);
  sample_light_start(scene, random, receiver, e);
  e.weight /= light_share;
  e.density.first *= light_share;
}

}  // namespace etendue::integrator
