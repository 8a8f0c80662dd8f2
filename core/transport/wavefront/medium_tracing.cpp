#include "transport/wavefront/medium_tracing.h"

#include "scene/facet.h"

namespace etendue::transport {
namespace {

// A part of a segment in one medium: it starts at the parameter `from` of the ray and is `length` metres long.
struct SegmentPart {
  const scene::Solid* solid;  // null outside of all solids
  float from, length;
};

// Completes a segment as complete_segment does. pass(part) is called for its parts in different media, from the start;
// if it returns false, the segment ends there. `stack` becomes that of the end.
template <class Pass>
void traverse(const scene::CompiledScene& scene, const Ray& ray, float length, uint32_t seed, float time,
              scene::MediumStack& stack, MediumSegment& segment, Pass&& pass) {
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
      if (!pass(SegmentPart{solids.find(stack.top()), medium_start, (passed - medium_start) * scale})) return;
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
  pass(SegmentPart{solids.find(stack.top()), medium_start, rest_of_medium});
}

// Where a part lies in a solid that scatters or in the atmosphere, and that medium; null if it lies in neither.
struct ScatteringPart {
  const HomogeneousMedium* medium = nullptr;
  float offset = 0;  // metres from the start of the part to that of the medium
  float length = 0;  // metres
};

ScatteringPart scattering_part(const scene::Solids& solids, const Ray& ray, float scale, const SegmentPart& part) {
  if (part.solid) {
    if (!part.solid->medium.scatters()) return {};
    return {&part.solid->medium, 0, part.length};
  }
  const scene::AtmosphereMedium* atmosphere = solids.atmosphere();
  if (!atmosphere) return {};
  const scene::RayInterval inside = atmosphere->inside(ray, {part.from, part.from + part.length / scale});
  if (inside.empty()) return {};
  return {&atmosphere->medium, (inside.from - part.from) * scale, (inside.to - inside.from) * scale};
}

}  // namespace

void complete_segment(const scene::CompiledScene& scene, const Ray& ray, float length, uint32_t seed, float time,
                      scene::MediumStack stack, MediumSegment& segment) {
  const scene::AtmosphereMedium* atmosphere = scene.solids().atmosphere();
  const auto pass = [&](const Rgb& transmittance, bool scatters) {
    segment.transmittance *= transmittance;
    if (scatters) segment.scattering_transmittance *= transmittance;
  };
  traverse(scene, ray, length, seed, time, stack, segment, [&](const SegmentPart& part) {
    if (part.solid)
      pass(part.solid->transmittance(std::max(part.length, 0.0f)), part.solid->medium.scatters());
    else if (atmosphere)
      pass(atmosphere->transmittance(ray,
                                     {part.from, part.from + part.length / std::sqrt(length_squared(ray.direction))}),
           atmosphere->medium.scatters());
    return true;
  });
}

void sample_segment(const scene::CompiledScene& scene, const Ray& ray, float length, uint32_t seed, float time,
                    const scene::MediumStack& start, FreeFlight flight, FlightSegment& segment) {
  const float scale = std::sqrt(length_squared(ray.direction));
  scene::MediumStack stack = start;
  segment.collision = {};
  segment.first.medium = nullptr;
  Rgb transmittance(1);  // of the media before the first scattering medium
  traverse(scene, ray, length, seed, time, stack, segment, [&](const SegmentPart& part) {
    const ScatteringPart scattering = scattering_part(scene.solids(), ray, scale, part);
    if (!scattering.medium) {
      if (!part.solid) return true;
      const Rgb passed = part.solid->transmittance(std::max(part.length, 0.0f));
      transmittance *= passed;
      flight.attenuate(passed);
      return true;
    }
    const float part_length = std::max(scattering.length, 0.0f);
    if (!scattering.medium->scatters()) {
      const Rgb passed = scattering.medium->transmittance(part_length);
      transmittance *= passed;
      flight.attenuate(passed);
      return true;
    }
    if (!segment.first.medium) {
      const float from = part.from * scale + scattering.offset;
      segment.first = {scattering.medium, from, from + part_length, transmittance, stack};
    }
    const auto distance = flight.pass(*scattering.medium, part_length);
    if (!distance) return true;
    segment.collision.position = ray.origin + ray.direction * (part.from + (scattering.offset + *distance) / scale);
    segment.collision.phase = scattering.medium->phase.get();
    return false;
  });
  segment.transmittance = flight.weight();
  segment.survival = flight.survival();
  if (!segment.collision.phase) return;
  segment.hit = {};
  segment.interface.clear(stack);
}

void trace_segment(const scene::CompiledScene& scene, const Ray& ray, float length, uint32_t seed, float time,
                   const scene::MediumStack& stack, MediumSegment& segment) {
  segment.hit = scene.intersect_solids(ray, seed, time);
  complete_segment(scene, ray, length, seed, time, stack, segment);
}

Passage connection_passage(const scene::CompiledScene& scene, const Ray& ray, float length, uint32_t seed, float time,
                           const scene::MediumStack& stack, uint64_t& rays) {
  MediumSegment segment;
  trace_segment(scene, ray, length, seed, time, stack, segment);
  rays += 1 + segment.rays;
  if (segment.hit) return {Rgb(0), 0};
  return {segment.transmittance, average(segment.scattering_transmittance)};
}

}  // namespace etendue::transport
