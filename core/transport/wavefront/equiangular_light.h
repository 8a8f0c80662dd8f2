// Light of point lights that is scattered once on a segment of a camera path: distances on the segment are sampled by
// their angle as seen from a light.                                                        [Kulla and Fajardo 2012]
//
// Free flights sample distances in proportion to the transmittance, light samples at collisions then contain the
// inverse square of the light's distance without bound. Here a light is chosen first, and a distance in proportion to
// that inverse square. Both techniques sample the first part of the segment in a scattering medium, and are combined
// by multiple importance sampling:
//
//   free flight    p(t) P(light | x_t)    a collision at distance t, then a light sample there
//   equiangular    p(t | light) P(light)
#pragma once
#include "medium/equiangular.h"
#include "transport/wavefront/path_estimators.h"

namespace etendue::transport {

template <class M>
class EquiangularLight {
 public:
  EquiangularLight(PathWavefront<M>& paths, LightSampling sampling, const DirectLightMis& mis)
      : paths_(paths),
        lights_(paths.scene().lights()),
        sampling_(sampling),
        mis_(mis.with_one_light_sample()),
        collision_samples_(static_cast<float>(mis.light_samples)) {}

  // One point on each segment that ends at a current hit.
  void add_light_before_hits() {
    if (!lights_.has_point_lights()) return;
    paths_.select_rng_stream(PathWavefront<M>::kSegmentStream);
    paths_.draw(kNumbers);
    paths_.reserve_connections(2 * paths_.hit_count());  // one more for the light sample at the hit
    for (int i = 0; i < paths_.hit_count(); ++i) add_light(paths_.path_at(i), i);
    paths_.select_rng_stream(0);
  }
  // One point on each segment that left the scene. To be called before the first hits are processed.
  void add_light_of_misses() {
    if (!lights_.has_point_lights()) return;
    paths_.draw_of_misses(PathWavefront<M>::kSegmentStream, kNumbers);
    paths_.reserve_connections(paths_.miss_count());
    for (int i = 0; i < paths_.miss_count(); ++i) add_light(paths_.path_of_miss(i), i);
  }

  // The MIS weight of a sample of a light without extent at a current hit.
  float weight_of_light_sample(int hit, const LightSample& light) const {
    const scene::SurfacePoint& point = paths_.point(hit);
    if (!point.in_volume || light.kind != LightKind::placed || !std::isfinite(light.distance)) return 1;
    const int path = paths_.path_at(hit);
    const Part& part = paths_.media().first_interval(path);
    const Segment segment(paths_.media().ray(path));
    const float distance = glm::distance(segment.origin, point.position);
    if (!part.contains(distance)) return 1;
    const auto source = lights_.point_light(light.light, paths_.state(path).time);
    if (!source) return 1;
    const DistanceInterval lit = segment.lit_part(part, *source);
    if (lit.empty()) return 1;
    return mis_.bsdf_weight(collision_samples_ * flight_density(path, part, distance) * light.pdf,
                            segment.distances(lit, *source).pdf(distance) * source->probability);
  }

 private:
  using Color = typename M::Color;
  using Part = BasicScatteringInterval<Color>;
  static constexpr int kLightNumber = vertex_dimension::kLightChoice, kDistanceNumber = vertex_dimension::kLightPoint;
  static constexpr DimensionSet kNumbers = dimensions(kLightNumber, 1) | dimensions(kDistanceNumber, 1);

  struct Segment {
    Vec3 origin, direction;

    explicit Segment(const Ray& ray) : origin(ray.origin), direction(glm::normalize(ray.direction)) {}
    // The part inside the cone of the light.
    DistanceInterval lit_part(const Part& part, const LightTable::PointLight& light) const {
      return inside_cone(origin, direction, {part.from, part.to}, light.position, light.axis, light.cone_cosine);
    }
    EquiangularDistance distances(const DistanceInterval& interval, const LightTable::PointLight& light) const {
      return {origin, direction, interval, light.position};
    }
  };

  // The density of a free flight's collision, per metre.
  float flight_density(int path, const Part& part, float distance) const {
    return paths_.media().flight(path, 0).collision_density(paths_.media().coefficients(path, *part.medium),
                                                            distance - part.from);
  }

  // `lane` is the index of the random numbers.
  void add_light(int path, int lane) {
    const Part& part = paths_.media().first_interval(path);
    if (!part.medium) return;
    auto& state = paths_.state(path);
    const auto choice = lights_.choose_point_light(paths_.random(kLightNumber, lane), state.time);
    if (!choice) return;
    const Segment segment(paths_.media().ray(path));
    const DistanceInterval lit = segment.lit_part(part, *choice);
    if (lit.empty()) return;
    const EquiangularDistance distances = segment.distances(lit, *choice);
    const float distance = distances.sample(paths_.random(kDistanceNumber, lane)), pdf = distances.pdf(distance);
    if (!(pdf > 0) || !part.contains(distance)) return;
    const Vec3 point = segment.origin + segment.direction * distance;
    const LightSample light = lights_.sample_placed(choice->light, point, state.time);
    if (light.pdf == 0) return;
    const float other_pdf = collision_samples_ * flight_density(path, part, distance) *
                            lights_.probability(choice->light, point, sampling_);
    const float weight = mis_.light_weight_over_pdf(pdf * choice->probability, other_pdf);
    const float phase = part.medium->phase->eval(-segment.direction, light.wi);
    const auto& medium = paths_.media().coefficients(path, *part.medium);
    const Color throughput = paths_.media().unattenuated(path) * part.transmittance *
                             medium.transmittance(distance - part.from) * medium.scattering;
    Color contribution = throughput *
                         paths_.color().emission(path, light.radiance, spectrum_of<M>(paths_.scene(), light)) *
                         (phase * weight);
    if constexpr (M::kClasses) contribution *= paths_.shares().volume_connection_share(path);
    if (is_black(contribution)) return;
    paths_.connect_from(path, point, part.stack, light.wi, light.distance) = contribution;
    if (paths_.recorder()) [[unlikely]]
      record(path, light, weight * pdf * choice->probability, phase, contribution);
  }

  // The light sample is recorded at the vertex at the end of the segment.
  [[gnu::cold, gnu::noinline]] void record(int path, const LightSample& light, float mis_weight, float phase,
                                           const Color& contribution) {
    paths_.recorder()->add_light(path,
                                 {.sample = light,
                                  .radiance = light.radiance,
                                  .f_cos = Rgb(phase),
                                  .bsdf_pdf = phase,
                                  .mis_weight = mis_weight,
                                  .unoccluded = paths_.color().to_rgb(path, contribution)},
                                 paths_.last_connection());
  }

  PathWavefront<M>& paths_;
  const LightTable& lights_;
  LightSampling sampling_;
  DirectLightMis mis_;       // of the sample on the segment, in place of a light sample, and the one at a collision
  float collision_samples_;  // light samples at a collision
};

}  // namespace etendue::transport
