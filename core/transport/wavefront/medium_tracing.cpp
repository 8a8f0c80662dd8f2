#include "transport/wavefront/medium_tracing.h"

#include "scene/facet.h"

namespace etendue::transport {
namespace {

Rgb transmittance_of(const scene::Solids& solids, const scene::MediumStack& stack, float distance) {
  const scene::Solid* medium = solids.find(stack.top());
  return medium ? medium->transmittance(std::max(distance, 0.0f)) : Rgb(1);
}

}  // namespace

void complete_segment(const scene::CompiledScene& scene, const Ray& ray, float length, uint32_t seed, float time,
                      scene::MediumStack stack, MediumSegment& segment) {
  const scene::Solids& solids = scene.solids();
  Hit& hit = segment.hit;
  const float scale = std::sqrt(length_squared(ray.direction));
  Ray rest = ray;
  float start = 0;                 // parameter of the origin of `rest` along the ray
  float medium_start = ray.tnear;  // parameter along the ray where the current medium starts
  segment.interface.clear(stack);
  while (hit) {
    const scene::InstanceData& instance = scene.instances()[hit.instance];
    if (instance.solid == scene::kNoSolid) {
      segment.interface.clear(stack);
      break;
    }
    bool is_vertex = scene.find_interface(stack, time, hit, segment.interface);
    const scene::InstanceData& surface = scene.instances()[hit.instance];
    if (is_vertex && solids[surface.solid].has_alpha)
      is_vertex = scene.blocks_ray(hit.instance, hit.triangle, hit.u, hit.v, seed);
    if (is_vertex) break;

    const Facet f = scene::facet_of(surface, hit.triangle, time);
    const Vec3 e1 = f.p1 - f.p0, e2 = f.p2 - f.p0, position = f.p0 + e1 * hit.u + e2 * hit.v,
               normal = scene::normal_of(f);
    const float cosine = glm::dot(normal, ray.direction) / scale;
    const scene::MediumStack beyond = segment.interface.side(cosine > 0);
    const float passed = start + hit.t;
    if (beyond.top() != stack.top()) {
      segment.transmittance *= transmittance_of(solids, stack, (passed - medium_start) * scale);
      medium_start = passed;
    }
    stack = beyond;
    const float offset = std::max(segment.interface.offset, scene::offset_bound(position, e1, e2));
    rest.origin = position + normal * (cosine > 0 ? offset : -offset);
    rest.tnear = 0;
    start = passed + std::abs(cosine) * offset / scale;
    rest.tfar = ray.tfar - start;
    hit = scene.intersect_solids(rest, seed, time);
    ++segment.rays;
    segment.interface.clear(stack);
  }
  if (hit) hit.t += start;
  const float rest_of_medium = hit ? (hit.t - medium_start) * scale : length - medium_start * scale;
  segment.transmittance *= transmittance_of(solids, stack, rest_of_medium);
}

void trace_segment(const scene::CompiledScene& scene, const Ray& ray, float length, uint32_t seed, float time,
                   const scene::MediumStack& stack, MediumSegment& segment) {
  segment.hit = scene.intersect_solids(ray, seed, time);
  complete_segment(scene, ray, length, seed, time, stack, segment);
}

Rgb connection_transmittance(const scene::CompiledScene& scene, const Ray& ray, float length, uint32_t seed, float time,
                             const scene::MediumStack& stack, uint64_t& rays) {
  MediumSegment segment;
  trace_segment(scene, ray, length, seed, time, stack, segment);
  rays += 1 + segment.rays;
  return segment.hit ? Rgb(0) : segment.transmittance;
}

}  // namespace etendue::transport
