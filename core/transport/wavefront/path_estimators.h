// What gathering methods do at the vertices of a front of walks: the terms of thesis (9.26)-(9.29).
//
// Each goes over all vertices that the last step reached. A method that finds the same light in two ways names the
// heuristic by which they share it; without one the way at hand counts alone. In a model with path classes only the
// part that belongs to the classes asked for is added (class_shares.h).
#pragma once
#include <optional>

#include "transport/mis/mis.h"
#include "transport/wavefront/path_wavefront.h"

namespace etendue::transport {

using Combination = std::optional<MisHeuristic>;

// Roulette never lets a path live with certainty, so that a lossless room ends too (digest: albedo 1). A walk that
// keeps r of its throughput and lives with the probability q has a finite variance only if r^2 < q: what was made
// heavier than one by living is therefore hardly played for any more.
inline constexpr float kMaxSurvival = 0.95f, kMaxSurvivalOfTheHeavy = 0.995f;

// The weight of emission that the walk's own direction found.
template <class Color>
float weight_of_hit(const PathState<Color>& path, const scene::CompiledScene& scene, const scene::SurfacePoint& point,
                    Combination shared, LightStrategy strategy) {
  if (!shared || path.pdf == 0) return 1;
  const uint32_t light = scene.light_at(point);
  if (light == scene::InstanceData::kNotALight) return 1;
  return mis_weight(*shared, path.pdf,
                    scene.lights().pdf_triangle(light, path.from, point.position, path.time, strategy));
}

// The part of the throughput that counts if walk number `index` ends on a light here.
template <class M>
typename M::Color admitted(PathWavefront<M>& paths, const typename M::Color& throughput, int index) {
  if constexpr (M::kClasses)
    return throughput * paths.shares().of_end(index);
  else
    return throughput;
}

// Light that surfaces emit towards the walks, times weigh(arrival). An unlit surface shows itself and lights nothing.
template <class M, class Weigh>
void add_emission_weighted(PathWavefront<M>& paths, Weigh&& weigh) {
  const scene::CompiledScene& scene = paths.scene();
  for (int i = 0; i < paths.hit_count(); ++i) {
    const scene::SurfacePoint& point = paths.point(i);
    if (!point.material->is_emissive) continue;
    auto& path = paths.state_at(i);
    if (point.material->description.unlit && !path.all_specular) continue;
    const Rgb emitted = scene.emitted(point, paths.wo(i));
    if (is_black(emitted)) continue;
    path.radiance += admitted(paths, path.throughput, paths.path_at(i)) * emitted * weigh(i);
  }
}

template <class M>
void add_emission(PathWavefront<M>& paths, Combination shared = {}, LightStrategy strategy = LightStrategy::automatic) {
  add_emission_weighted(
      paths, [&](int i) { return weight_of_hit(paths.state_at(i), paths.scene(), paths.point(i), shared, strategy); });
}

// Light from infinity along the last direction of the walks that left, times weigh(escape).
template <class M, class Weigh>
void add_environment_weighted(PathWavefront<M>& paths, Weigh&& weigh) {
  const LightTable& lights = paths.scene().lights();
  const EnvironmentMap& map = lights.environment();
  if (map.black() || (paths.length() == 1 && !map.visible())) return;
  for (int i = 0; i < paths.miss_count(); ++i) {
    auto& path = paths.missed_path(i);
    const Vec3& direction = paths.miss_direction(i);
    path.radiance += admitted(paths, path.throughput, paths.path_of_miss(i)) * map.radiance(direction) * weigh(i);
  }
}

template <class M>
void add_environment(PathWavefront<M>& paths, Combination shared = {},
                     LightStrategy strategy = LightStrategy::automatic) {
  const LightTable& lights = paths.scene().lights();
  add_environment_weighted(paths, [&](int i) {
    const float own = paths.missed_path(i).pdf;
    if (!shared || own == 0) return 1.0f;
    return mis_weight(*shared, own, lights.pdf_environment(paths.miss_direction(i), strategy));
  });
}

// Whether shadow rays are traced: thesis 8.2 knows local illumination without them.
enum class Shadows { cast, ignored };

// Which of the present vertices a term is for: all of them, unless a method says otherwise.
struct EveryHit {
  constexpr bool operator()(int) const { return true; }
};

// Light from these points, one for each vertex that is wanted, times weigh(arrival, light sample, value of the
// scattering function), which is a weight over the density of the sample.
template <class M, class Weigh, class Selected = EveryHit>
void add_light_samples_weighted(PathWavefront<M>& paths, std::span<const LightSample> samples, Shadows shadows,
                                Weigh&& weigh, const Selected& selected = {}) {
  const scene::CompiledScene& scene = paths.scene();
  for (int i = 0; i < paths.hit_count(); ++i) {
    if (!selected(i)) continue;
    const LightSample& light = samples[static_cast<size_t>(i)];
    const Bsdf<M>& bsdf = paths.bsdf(i);
    if (light.pdf == 0 || !bsdf.has_non_delta_lobe()) continue;
    auto scattered = bsdf.evaluate(paths.wo(i), light.wi);
    if constexpr (M::kClasses)
      scattered.f_cos = paths.shares().of_connection(paths.path_at(i), bsdf, paths.wo(i), light.wi, scattered.f_cos);
    if (is_black(scattered.f_cos)) continue;
    const float weight = weigh(i, light, scattered);
    if (weight == 0) continue;
    auto& path = paths.state_at(i);
    const bool can_be_shadowed = shadows == Shadows::cast && light.distance > 0;
    auto& gain = can_be_shadowed ? paths.connect(i, light.wi, light.distance) : path.radiance;
    gain += path.throughput * scattered.f_cos * scene.radiance_of(light) * weight;
  }
}

// `branches` is the number of directions that the walk then takes, each of which may find the same light.
template <class M>
void add_light_samples(PathWavefront<M>& paths, std::span<const LightSample> samples, Combination shared,
                       Shadows shadows, float branches) {
  add_light_samples_weighted(paths, samples, shadows, [&](int, const LightSample& light, const auto& scattered) {
    return shared && !light.delta ? mis_weight_over_pdf(*shared, light.pdf, branches * scattered.pdf) : 1 / light.pdf;
  });
}

// Next event estimation: one point on one light for each vertex, as it would be found by walks from the lights.
template <class M, class Weigh, class Selected = EveryHit>
void add_direct_light_weighted(PathWavefront<M>& paths, Shadows shadows, Weigh&& weigh, const Selected& selected = {}) {
  if (paths.scene().lights().empty()) return;
  add_light_samples_weighted(paths, paths.sample_lights(LightStrategy::emission_pdf), shadows, weigh, selected);
}

// The same with one point on every light, added up: without noise where no light has an extent. thesis (8.14)-(8.19)
template <class M>
void add_light_of_every_source(PathWavefront<M>& paths, Combination shared, Shadows shadows = Shadows::cast,
                               float branches = 1) {
  for (size_t source = 0; source < paths.scene().lights().source_count(); ++source) {
    paths.reserve_connections();
    add_light_samples(paths, paths.sample_source(source), shared, shadows, branches);
  }
  paths.select_rng_stream(0);
}

template <class M>
void add_direct_light(PathWavefront<M>& paths, LightStrategy strategy, Combination shared,
                      Shadows shadows = Shadows::cast, float branches = 1) {
  if (paths.scene().lights().empty()) return;
  if (strategy == LightStrategy::every)
    add_light_of_every_source(paths, shared, shadows, branches);
  else
    add_light_samples(paths, paths.sample_lights(strategy), shared, shadows, branches);
}

// Russian roulette: a walk survives with the probability of its throughput's largest component (refraction's
// compression of radiance taken out), and is weighted so that the expectation does not change. thesis (9.10)
template <class Color>
bool survives_roulette(PathState<Color>& path, float random) {
  const float weight = max_component(path.throughput) * path.eta_scale;
  const float survival = std::min(weight, weight > 1 ? kMaxSurvivalOfTheHeavy : kMaxSurvival);
  if (!(random < survival)) return false;
  path.throughput /= survival;
  return true;
}

// What a walk remembers of the event by which it goes on.
template <class Color>
void leave(PathState<Color>& path, const Vec3& from, const LobeSample<Color>& s) {
  path.pdf = s.delta ? 0 : s.pdf_solid_angle;
  path.from = from;
  path.all_specular = path.all_specular && s.delta;
}

// What a walk takes of a direction that was sampled at an arrival: all of it. False if nothing that counts can come of
// it.
struct TakeAll {
  template <class M>
  bool operator()(PathWavefront<M>& paths, int hit, LobeSample<typename M::Color>& s) const {
    if constexpr (M::kClasses) return paths.shares().scatter(paths.path_at(hit), paths.bsdf(hit), paths.wo(hit), s);
    return true;
  }
};

// Chooses the next direction of every walk; those that are absorbed, or lose at roulette from the given vertex on, stay
// behind. Walks from lights carry importance's mode: what flows along them is power, which refraction does not
// compress.
// Those for which goes_on(arrival) says no stay behind too. `note` is called with the arrival and its sample where the
// walk goes on.
template <class M, class GoesOn, class Note, class Take = TakeAll>
void sample_bsdf_where(PathWavefront<M>& paths, int roulette_from, TransportMode mode, GoesOn&& goes_on, Note&& note,
                       const Take& take = {}) {
  const bool roulette = paths.length() >= roulette_from;
  paths.draw_lobes();
  if (roulette) paths.draw(dimensions(vertex_dimension::kRoulette, 1));
  for (int i = 0; i < paths.hit_count(); ++i) {
    if (!goes_on(i)) continue;
    LobeSample<typename M::Color> s;
    if (!paths.bsdf(i).sample(paths.wo(i), paths.lobe_draw(i), mode, s)) continue;
    if (!take(paths, i, s)) continue;
    auto& path = paths.state_at(i);
    path.throughput *= s.weight;
    if (mode == TransportMode::radiance) path.eta_scale *= sqr(s.eta);
    if (roulette && !survives_roulette(path, paths.random(vertex_dimension::kRoulette, i))) continue;
    leave(path, paths.point(i).position, s);
    note(i, s);
    paths.continue_path(i, s.wi);
  }
}

template <class M, class Note, class Take = TakeAll>
void sample_bsdf_and_record(PathWavefront<M>& paths, int roulette_from, TransportMode mode, Note&& note,
                            const Take& take = {}) {
  sample_bsdf_where(
      paths, roulette_from, mode, [](int) { return true; }, note, take);
}

template <class M, class Take = TakeAll>
void sample_bsdf(PathWavefront<M>& paths, int roulette_from, TransportMode mode = TransportMode::radiance,
                 const Take& take = {}) {
  sample_bsdf_and_record(
      paths, roulette_from, mode, [](int, const auto&) {}, take);
}

}  // namespace etendue::transport
