// Light vertices of paths in media that emit.
#pragma once
#include "integrator/markov_chain/chain_random.h"
#include "integrator/mlt/light_path.h"
#include "integrator/shared/emission_starts.h"
#include "transport/wavefront/volume_vertex.h"

namespace etendue::integrator {

// Samples the start of a light path on a light or, with the probability `media_share`, in a medium; `stack` is set in
// media only. `media`: the model has media that emit. `receiver`: see sample_light_start.
template <bool media>
Emission sample_emission(const scene::CompiledScene& scene, float media_share, ChainRandom& random, float time,
                         [[maybe_unused]] scene::MediumStack& stack, const LightReceiver* receiver) {
  const float choice = random.next();
  const Vec2 point = random.next_2d(), direction = random.next_2d();
  const EmissionRandom numbers(choice, point, direction, time);
  Emission e;
  if constexpr (media)
    if (media_share > 0) {
      sample_start(scene, numbers, random.next(), media_share, e, stack, receiver);
      return e;
    }
  sample_light_start(scene, numbers, receiver, e);
  return e;
}

template <class M>
void place_in_medium(PathVertex<M>& x) {
  const Vec3 position = x.point.position;
  transport::set_volume_point({.position = position}, Vec3(0, 0, 1), x.point);
}

// Makes a point of a medium that emits the light vertex. Camera subpaths do not hit it: it is no surface.
template <class M>
void start_in_medium(const Emission& e, const scene::MediumStack& stack, LightPath<M>& path) requires(M::kScattering) {
  path.light = {LightKind::medium, LightPath<M>::Light::kUnlisted, false, false, e.density.first, e.density.second};
  PathVertex<M>& x = path[0];
  x.delta = false;
  x.media.interface.clear(stack);
  x.media.in_volume = false;  // the path is not scattered there
  x.media.scattering = x.media.extinction = typename M::Color(1);
  x.point.position = e.position;
  place_in_medium(x);
}

// The emission coefficient at a light vertex in a medium, radiance per metre.
template <class M>
Rgb emission_in_medium([[maybe_unused]] const scene::CompiledScene& scene, [[maybe_unused]] const PathVertex<M>& x) {
  if constexpr (M::kScattering)
    return scene.solids().emission_at(x.media.interface.side(true), x.point.position);
  else
    return Rgb(0);
}

}  // namespace etendue::integrator
