#include "transport/wavefront/medium_tracing.h"

#include "medium/emission_on_ray.h"
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
template <class Color, class Pass>
void traverse(const scene::CompiledScene& scene, const Ray& ray, float length, uint32_t seed, float time,
              scene::MediumStack& stack, BasicMediumSegment<Color>& segment, Pass&& pass) {
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

// The medium of a part: at most one of the two is set. Both are null in a vacuum and in media that only absorb.
struct MediumPart {
  const HomogeneousMedium* homogeneous = nullptr;
  const HeterogeneousMedium* heterogeneous = nullptr;
  float offset = 0;  // metres from the start of the part to that of the medium
  float length = 0;  // metres
};

// Metres from the start of the part to the point where its ray leaves the bounds; 0 if it does not meet them.
float distance_to_exit(const Bounds& bounds, const Ray& ray, float scale, float from) {
  float enter = from, exit = kInfinity;
  for (int axis = 0; axis < 3; ++axis) {
    const float a = (bounds.min[axis] - ray.origin[axis]) / ray.direction[axis];
    const float b = (bounds.max[axis] - ray.origin[axis]) / ray.direction[axis];
    enter = std::fmax(enter, std::fmin(a, b));
    exit = std::fmin(exit, std::fmax(a, b));
  }
  return enter < exit ? (exit - from) * scale : 0;
}

MediumPart medium_part(const scene::Solids& solids, const Ray& ray, float scale, const SegmentPart& part) {
  float length = std::max(part.length, 0.0f);
  if (part.solid) {
    // Light that leaves an open boundary meets no surface: the medium ends at the bounds of the solid.
    if (std::isinf(length) && part.solid->is_volume())
      length = distance_to_exit(part.solid->bounds, ray, scale, part.from);
    if (part.solid->heterogeneous) return {nullptr, part.solid->heterogeneous.get(), 0, length};
    if (part.solid->is_volume()) return {&part.solid->medium, nullptr, 0, length};
    return {};
  }
  const scene::AtmosphereMedium* atmosphere = solids.atmosphere();
  if (!atmosphere) return {};
  const scene::RayInterval inside = atmosphere->inside(ray, {part.from, part.from + length / scale});
  if (inside.empty()) return {};
  const float offset = (inside.from - part.from) * scale, inside_length = (inside.to - inside.from) * scale;
  if (atmosphere->heterogeneous) return {nullptr, atmosphere->heterogeneous.get(), offset, inside_length};
  return {&atmosphere->medium, nullptr, offset, inside_length};
}

RaySpan span_of(const Ray& ray, float scale, const SegmentPart& part, const MediumPart& medium) {
  const float from = part.from + medium.offset / scale;
  return {ray.origin, ray.direction, from, from + medium.length / scale};
}

// The numbers for tracking along a segment. Segments of one path that start in different directions have different
// numbers.
RandomStream stream_of(const Ray& ray, uint32_t seed) {
  const uint32_t x = hash_combine(seed, std::bit_cast<uint32_t>(ray.direction.x));
  return RandomStream(hash_combine(hash_combine(x, std::bit_cast<uint32_t>(ray.direction.y)),
                                   std::bit_cast<uint32_t>(ray.direction.z)));
}

template <class Color>
Color transmittance_of(const MediumPart& medium, const Ray& ray, float scale, const SegmentPart& part,
                       RandomStream& random, const MediumColors<Color>& colors,
                       MediumDetail detail = MediumDetail::transmittance) {
  if (const HeterogeneousMedium* m = medium.heterogeneous) {
    const auto estimator = detail == MediumDetail::exact ? TransmittanceEstimator::regular : m->estimator;
    return estimated_transmittance<Color>(*m, colors.of(*m), span_of(ray, scale, part, medium), estimator, random);
  }
  if (medium.homogeneous) return colors.of(*medium.homogeneous).transmittance(medium.length);
  return part.solid ? colors.transmittance(*part.solid, std::max(part.length, 0.0f)) : Color(1);
}

// The probabilities that flights pass a part without a collision. Media that only absorb have no collisions.
template <class Color>
Color survival_of(const MediumPart& medium, const Ray& ray, float scale, const SegmentPart& part,
                  const Color& transmittance, const MediumColors<Color>& colors, MediumDetail detail) {
  if (medium.homogeneous) return medium.homogeneous->scatters() ? transmittance : Color(1);
  const HeterogeneousMedium* m = medium.heterogeneous;
  if (!m || !m->scatters() || detail == MediumDetail::transmittance) return Color(1);
  if (detail == MediumDetail::exact) return transmittance;
  const auto& coefficients = colors.of(*m);
  return exponential_of(approximate_depth<Color>(*m, coefficients, span_of(ray, scale, part, medium)));
}

// Passes through a part; returns the metres from its start to a collision inside it.
template <class Color>
std::optional<float> pass_part(const MediumPart& medium, const Ray& ray, float scale, const SegmentPart& part,
                               RandomStream& random, const MediumColors<Color>& colors, BasicFreeFlight<Color>& flight,
                               const PhaseFunction*& phase) {
  if (const HeterogeneousMedium* m = medium.heterogeneous) {
    const RaySpan span = span_of(ray, scale, part, medium);
    const auto& coefficients = colors.of(*m);
    if (!m->scatters()) {
      Color emitted(0);
      const Color transmittance = transmittance_and_emission<Color>(*m, coefficients, span, random, emitted);
      flight.add_emission(emitted);
      flight.attenuate(transmittance);
      return {};
    }
    phase = m->phase.get();
    const auto at = flight.pass(*m, coefficients, span, random);
    return at ? std::optional((*at - part.from) * scale) : std::nullopt;
  }
  if (const HomogeneousMedium* m = medium.homogeneous) {
    const auto& coefficients = colors.of(*m);
    if (m->emits()) flight.add_emission(coefficients.emitted(medium.length));
    if (!m->scatters()) {
      flight.attenuate(coefficients.transmittance(medium.length));
      return {};
    }
    phase = m->phase.get();
    const auto distance = flight.pass(coefficients, medium.length);
    return distance ? std::optional(medium.offset + *distance) : std::nullopt;
  }
  if (part.solid) flight.attenuate(colors.transmittance(*part.solid, std::max(part.length, 0.0f)));
  return {};
}

// The media on a segment before the first homogeneous medium that scatters.
template <class Color>
struct MediaBeforeInterval {
  MediumColors<Color> colors;
  Color transmittance{1};
  bool is_exact = true;  // false: a heterogeneous medium was passed, whose transmittance is only estimated

  // Sets the interval if it starts in this part, which lies in these solids.
  void find_interval(const SegmentPart& part, const MediumPart& medium, float scale, const scene::MediumStack& stack,
                     BasicScatteringInterval<Color>& first) {
    is_exact &= !medium.heterogeneous;
    if (first.medium || !is_exact) return;
    const HomogeneousMedium* m = medium.homogeneous;
    if (m && m->scatters()) {
      const float from = part.from * scale + medium.offset;
      first = {m, from, from + medium.length, transmittance, stack};
    } else if (m) {
      transmittance *= colors.of(*m).transmittance(medium.length);
    } else if (part.solid) {
      transmittance *= colors.transmittance(*part.solid, std::max(part.length, 0.0f));
    }
  }
};

// The fraction of the extinction that is due to scattering, by channel.
template <class Coefficients>
auto albedo_of(const Coefficients& coefficients) {
  auto albedo = coefficients.scattering;
  for (int c = 0; c < kChannels<decltype(albedo)>; ++c)
    albedo[c] = coefficients.extinction[c] > 0 ? albedo[c] / coefficients.extinction[c] : 0;
  return albedo;
}

// Adds a part of a ray beyond those that `light` describes.
template <class Color>
void add_part(const MediumPart& medium, const Ray& ray, float scale, const SegmentPart& part, EmissionPoints points,
              RandomStream& random, const MediumColors<Color>& colors, BasicMediumLightOnRay<Color>& light) {
  Color emitted(0), transmittance, albedo(0);
  if (const HeterogeneousMedium* m = medium.heterogeneous) {
    const auto& coefficients = colors.of(*m);
    const RaySpan span = span_of(ray, scale, part, medium);
    albedo = albedo_of(coefficients);
    if (!m->emits())
      transmittance = estimated_transmittance<Color>(*m, coefficients, span, m->estimator, random);
    else if (points == EmissionPoints::of_voxels)
      transmittance = transmittance_and_emission_by_voxels<Color>(*m, coefficients, span, random, emitted);
    else
      transmittance = transmittance_and_emission<Color>(*m, coefficients, span, random, emitted);
  } else if (medium.homogeneous) {
    const auto& coefficients = colors.of(*medium.homogeneous);
    albedo = albedo_of(coefficients);
    transmittance = coefficients.transmittance(medium.length);
    emitted = coefficients.emitted(medium.length);
  } else {
    transmittance = transmittance_of(medium, ray, scale, part, random, colors);
  }
  light.emitted += light.transmitted * emitted;
  // Light from the end passes this part first.
  const Color lost = Color(1) - transmittance;
  light.absorbed = lost * (Color(1) - albedo) + transmittance * light.absorbed;
  light.scattered = lost * albedo + transmittance * light.scattered;
  light.transmitted *= transmittance;
}

}  // namespace

template <class Color>
BasicMediumLightOnRay<Color> medium_light_on_ray(const scene::CompiledScene& scene, const Ray& ray, uint32_t seed,
                                                 float time, const scene::MediumStack& start, EmissionPoints points,
                                                 const MediumColors<Color>& colors) {
  const float scale = std::sqrt(length_squared(ray.direction));
  scene::MediumStack stack = start;
  RandomStream random = stream_of(ray, seed);
  BasicMediumSegment<Color> segment;
  segment.hit = scene.intersect_solids(ray, seed, time);
  BasicMediumLightOnRay<Color> light;
  traverse(scene, ray, ray.tfar, seed, time, stack, segment, [&](const SegmentPart& part) {
    add_part(medium_part(scene.solids(), ray, scale, part), ray, scale, part, points, random, colors, light);
    return true;
  });
  light.rays = 1 + segment.rays;
  return light;
}

template <class Color>
void complete_segment(const scene::CompiledScene& scene, const Ray& ray, float length, uint32_t seed, float time,
                      scene::MediumStack stack, BasicMediumSegment<Color>& segment, const MediumColors<Color>& colors,
                      MediumDetail detail) {
  const float scale = std::sqrt(length_squared(ray.direction));
  RandomStream random = scene.solids().any_heterogeneous() ? stream_of(ray, seed) : RandomStream(seed);
  traverse(scene, ray, length, seed, time, stack, segment, [&](const SegmentPart& part) {
    const MediumPart medium = medium_part(scene.solids(), ray, scale, part);
    const Color transmittance = transmittance_of(medium, ray, scale, part, random, colors, detail);
    segment.transmittance *= transmittance;
    segment.survival *= survival_of(medium, ray, scale, part, transmittance, colors, detail);
    return true;
  });
}

template <class Color>
void sample_segment(const scene::CompiledScene& scene, const Ray& ray, float length, uint32_t seed, float time,
                    const scene::MediumStack& start, BasicFreeFlight<Color> flight, BasicFlightSegment<Color>& segment,
                    const MediumColors<Color>& colors) {
  const float scale = std::sqrt(length_squared(ray.direction));
  scene::MediumStack stack = start;
  RandomStream random = stream_of(ray, seed);
  segment.collision = {};
  segment.first.medium = nullptr;
  MediaBeforeInterval<Color> before{colors};
  traverse(scene, ray, length, seed, time, stack, segment, [&](const SegmentPart& part) {
    const MediumPart medium = medium_part(scene.solids(), ray, scale, part);
    before.find_interval(part, medium, scale, stack, segment.first);
    const PhaseFunction* phase = nullptr;
    const auto distance = pass_part(medium, ray, scale, part, random, colors, flight, phase);
    if (!distance) return true;
    segment.collision.position = ray.origin + ray.direction * (part.from + *distance / scale);
    segment.collision.phase = phase;
    if constexpr (std::is_same_v<Color, Rgb>) segment.collision.scattering = flight.scattering_at_collision();
    return false;
  });
  segment.transmittance = flight.weight();
  segment.emitted = flight.emitted();
  segment.survival_to_end = flight.survival();
  segment.densities = flight.densities();
  if (!segment.collision.phase) return;
  segment.hit = {};
  segment.interface.clear(stack);
}

template <class Color>
BasicPassage<Color> passage_without_boundaries(const scene::CompiledScene& scene, const Ray& ray, float length,
                                               uint32_t seed, const scene::Solid* solid, MediumDetail detail,
                                               const MediumColors<Color>& colors) {
  RandomStream random = stream_of(ray, seed);
  const float scale = std::sqrt(length_squared(ray.direction));
  const SegmentPart part{solid, ray.tnear, length};
  const MediumPart medium = medium_part(scene.solids(), ray, scale, part);
  const Color transmittance = transmittance_of(medium, ray, scale, part, random, colors, detail);
  return {transmittance, average(survival_of(medium, ray, scale, part, transmittance, colors, detail))};
}

template <class Color>
void trace_segment(const scene::CompiledScene& scene, const Ray& ray, float length, uint32_t seed, float time,
                   const scene::MediumStack& stack, BasicMediumSegment<Color>& segment,
                   const MediumColors<Color>& colors, MediumDetail detail) {
  segment.hit = scene.intersect_solids(ray, seed, time);
  complete_segment(scene, ray, length, seed, time, stack, segment, colors, detail);
}

void trace_flight(const scene::CompiledScene& scene, const Ray& ray, uint32_t seed, float time,
                  const scene::MediumStack& stack, float random, BasicFlightSegment<Rgb>& segment) {
  const float scale = std::sqrt(length_squared(ray.direction));
  const Hit first = scene.intersect_solids(ray, seed, time);
  segment.hit = first;
  sample_segment(scene, ray, ray.tfar * scale, seed, time, stack, FreeFlight(Rgb(1), random), segment, {});
  // The same segment again, up to the end of the flight.
  Ray passed = ray;
  MediumSegment whole;
  whole.hit = first;
  if (segment.collision.phase) {
    passed.tfar = glm::distance(ray.origin, segment.collision.position) / scale;
    if (!(first && first.t < passed.tfar)) whole.hit = {};
  }
  complete_segment(scene, passed, passed.tfar * scale, seed, time, stack, whole, {}, MediumDetail::exact);
  segment.transmittance = whole.transmittance;
  segment.survival = whole.survival;
  segment.rays += whole.rays + 1;
}

template <class Color>
BasicPassage<Color> connection_passage(const scene::CompiledScene& scene, const Ray& ray, float length, uint32_t seed,
                                       float time, const scene::MediumStack& stack, uint64_t& rays, MediumDetail detail,
                                       const MediumColors<Color>& colors) {
  BasicMediumSegment<Color> segment;
  trace_segment(scene, ray, length, seed, time, stack, segment, colors, detail);
  rays += 1 + segment.rays;
  if (segment.hit) return {Color(0), 0};
  return {segment.transmittance, average(segment.survival)};
}

#define ETENDUE_INSTANTIATE(Color)                                                                                    \
  template void complete_segment(const scene::CompiledScene&, const Ray&, float, uint32_t, float, scene::MediumStack, \
                                 BasicMediumSegment<Color>&, const MediumColors<Color>&, MediumDetail);               \
  template void sample_segment(const scene::CompiledScene&, const Ray&, float, uint32_t, float,                       \
                               const scene::MediumStack&, BasicFreeFlight<Color>, BasicFlightSegment<Color>&,         \
                               const MediumColors<Color>&);                                                           \
  template BasicPassage<Color> passage_without_boundaries(const scene::CompiledScene&, const Ray&, float, uint32_t,   \
                                                          const scene::Solid*, MediumDetail,                          \
                                                          const MediumColors<Color>&);                                \
  template void trace_segment(const scene::CompiledScene&, const Ray&, float, uint32_t, float,                        \
                              const scene::MediumStack&, BasicMediumSegment<Color>&, const MediumColors<Color>&,      \
                              MediumDetail);                                                                          \
  template BasicPassage<Color> connection_passage(const scene::CompiledScene&, const Ray&, float, uint32_t, float,    \
                                                  const scene::MediumStack&, uint64_t&, MediumDetail,                 \
                                                  const MediumColors<Color>&);                                        \
  template BasicMediumLightOnRay<Color> medium_light_on_ray(const scene::CompiledScene&, const Ray&, uint32_t, float, \
                                                            const scene::MediumStack&, EmissionPoints,                \
                                                            const MediumColors<Color>&);
ETENDUE_INSTANTIATE(Rgb)
ETENDUE_INSTANTIATE(SampledSpectrum)
#undef ETENDUE_INSTANTIATE

}  // namespace etendue::transport
