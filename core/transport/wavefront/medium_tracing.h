// Path segments through solids: the surface at their end, and their transmittance.
//
// A segment skips boundaries between equal media. It therefore lies in one medium, unless stochastic opacity lets it
// pass a boundary between different media.
#pragma once
#include "scene/compiled_scene.h"

namespace etendue::transport {

// A segment from the start of a ray to the next vertex.
struct MediumSegment {
  Hit hit;                           // its distance is measured from the start of the ray
  scene::MediumInterface interface;  // at the hit
  Rgb transmittance{1};
  uint64_t rays = 0;  // traced beyond the first hit
};

// Completes a segment that starts in the solids of `stack`. `segment.hit` is the result of
// CompiledScene::intersect_solids for the same seed and time. A segment that hits nothing is attenuated over `length`
// metres.
void complete_segment(const scene::CompiledScene& scene, const Ray& ray, float length, uint32_t seed, float time,
                      scene::MediumStack stack, MediumSegment& segment);

// Traces a whole segment.
void trace_segment(const scene::CompiledScene& scene, const Ray& ray, float length, uint32_t seed, float time,
                   const scene::MediumStack& stack, MediumSegment& segment);

// The transmittance of a connection to a point at a distance of `length` metres; black if a surface blocks it. The
// direction of the ray may have any length. Adds the number of rays traced to `rays`.
Rgb connection_transmittance(const scene::CompiledScene& scene, const Ray& ray, float length, uint32_t seed, float time,
                             const scene::MediumStack& stack, uint64_t& rays);

// The transmittance of connections that CompiledScene::occluded has tested.
class TracedConnections {
 public:
  explicit TracedConnections(const scene::CompiledScene& scene) : scene_(scene) {}

  // Whether the results of `occluded` are used. With stochastic opacity on boundaries of solids every connection must
  // be traced from boundary to boundary.
  bool use_packets() const { return !scene_.solids().any_has_alpha(); }

  Rgb transmittance(bool blocked, const Ray& ray, float length, uint32_t seed, float time,
                    const scene::MediumStack& stack, uint64_t& rays) const {
    const scene::Solids& solids = scene_.solids();
    const scene::Solid* medium = solids.find(stack.top());
    if (use_packets()) {
      if (!blocked) return medium ? medium->transmittance(length) : Rgb(1);
      // A segment in a vacuum, or in a solid that overlaps no other, skips no boundary.
      if (!medium || !medium->may_overlap) return Rgb(0);
    }
    return connection_transmittance(scene_, ray, length, seed, time, stack, rays);
  }

 private:
  const scene::CompiledScene& scene_;
};

}  // namespace etendue::transport
