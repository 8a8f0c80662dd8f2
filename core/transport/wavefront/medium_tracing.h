// Segments of paths through solids: which surface ends them, and how much of the light attenuation leaves.
//
// A segment has one medium, that of its start: the boundaries that it passes without an event divide equal media. Only
// boundaries that rays may pass by opacity change the medium of a segment.
#pragma once
#include "scene/compiled_scene.h"

namespace etendue::transport {

// A segment from the start of a ray to the next surface with an event.
struct MediumSegment {
  Hit hit;                           // its distance is measured from the start of the ray
  scene::MediumInterface interface;  // there
  Rgb transmittance{1};
  uint64_t rays = 0;  // traced beyond the first hit
};

// Completes a segment that starts in the solids of `stack`. `segment.hit` is what CompiledScene::intersect_solids found
// with the same seed and time. `length` is the distance, in metres, up to which the medium attenuates light that hits
// nothing.
void complete_segment(const scene::CompiledScene& scene, const Ray& ray, float length, uint32_t seed, float time,
                      scene::MediumStack stack, MediumSegment& segment);

// The same, traced from the beginning.
void trace_segment(const scene::CompiledScene& scene, const Ray& ray, float length, uint32_t seed, float time,
                   const scene::MediumStack& stack, MediumSegment& segment);

// The light that is left of a connection to a point at this distance; black where something lies in between. The
// direction of the ray may have any length. `rays` grows by the number of rays that are traced.
Rgb connection_transmittance(const scene::CompiledScene& scene, const Ray& ray, float length, uint32_t seed, float time,
                             const scene::MediumStack& stack, uint64_t& rays);

// The same for connections that CompiledScene::occluded has traced.
class TracedConnections {
 public:
  explicit TracedConnections(const scene::CompiledScene& scene) : scene_(scene) {}

  // Whether `occluded` decides anything: boundaries that rays may pass by opacity need every ray followed.
  bool use_packets() const { return !scene_.solids().porous(); }

  Rgb transmittance(bool blocked, const Ray& ray, float length, uint32_t seed, float time,
                    const scene::MediumStack& stack, uint64_t& rays) const {
    const scene::Solids& solids = scene_.solids();
    const scene::Solid* medium = solids.find(stack.top());
    if (use_packets()) {
      if (!blocked) return medium ? medium->transmittance(length) : Rgb(1);
      // In a vacuum every boundary is a surface.
      if (!medium || !medium->meets) return Rgb(0);
    }
    return connection_transmittance(scene_, ray, length, seed, time, stack, rays);
  }

 private:
  const scene::CompiledScene& scene_;
};

}  // namespace etendue::transport
