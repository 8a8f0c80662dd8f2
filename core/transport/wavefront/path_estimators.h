// Estimators for the terms of the light transport equation, for the current vertices of a wavefront of paths from the
// camera.                                                                                     [Lang, eq. 9.26-9.29]
//
// Each function processes all current hits or misses. Integrators that find the same light by two techniques pass the
// heuristic by which they are combined; without one, the technique counts alone. In a model with path classes, only the
// share of the selected classes is added (path_expression/class_shares.h).
#pragma once
#include <optional>

#include "transport/mis/direct_light_mis.h"
#include "transport/wavefront/path_wavefront.h"
#include "transport/wavefront/roulette.h"

namespace etendue::transport {

// How light sampling and BSDF sampling are combined; empty: one technique alone.
using Combination = std::optional<DirectLightMis>;

// Records of a wavefront, which need a recorder. They are kept out of the loops, whose speed depends on
// their size, and take values, because references would keep the loops from using registers.
template <class M>
[[gnu::cold, gnu::noinline]] void record_emission(PathWavefront<M>& paths, int path, Rgb radiance, float weight,
                                                  typename M::Color contribution) {
  paths.recorder()->add_emission(path, {radiance, weight, paths.color().to_rgb(path, contribution)});
}
// `weight` is the MIS weight over the density of the sample. A sample that can be shadowed is the last connection.
template <class M>
[[gnu::cold, gnu::noinline]] void record_light(PathWavefront<M>& paths, int hit, const LightSample& light, float weight,
                                               typename Bsdf<M>::Value scattered, typename M::Color unoccluded,
                                               bool can_be_shadowed) {
  const int path = paths.path_at(hit);
  paths.recorder()->add_light(path,
                              {.sample = light,
                               .radiance = paths.scene().radiance_of(light),
                               .f_cos = paths.color().to_rgb(path, scattered.f_cos),
                               .bsdf_pdf = scattered.pdf,
                               .mis_weight = weight * light.pdf,
                               .unoccluded = paths.color().to_rgb(path, unoccluded)},
                              can_be_shadowed ? paths.last_connection() : -1);
}
template <class M>
[[gnu::cold, gnu::noinline]] void record_sample(PathWavefront<M>& paths, int hit, LobeSample<typename M::Color> s,
                                                PathEnd end) {
  const int path = paths.path_at(hit);
  paths.recorder()->scatter(
      path, {s.wi, paths.color().to_rgb(path, s.weight), s.pdf_solid_angle, s.eta, s.type, s.delta, s.transmitted});
  paths.recorder()->end(path, end);
}
// Why the last BSDF sample of a hit does not continue its path.
template <class M>
[[gnu::cold, gnu::noinline]] void record_end(PathWavefront<M>& paths, int hit, PathEnd end) {
  paths.recorder()->end(paths.path_at(hit), end);
}
template <class M>
[[gnu::cold, gnu::noinline]] void record_throughput(PathWavefront<M>& paths, int hit, typename M::Color throughput) {
  const int path = paths.path_at(hit);
  paths.recorder()->set_throughput(path, paths.color().to_rgb(path, throughput));
}
template <class M>
[[gnu::cold, gnu::noinline]] void record_roulette(PathWavefront<M>& paths, int path, float survival, float random) {
  paths.recorder()->play_roulette(path, {survival, random});
}

// The MIS weight of emission that BSDF sampling has hit.
template <class Color>
float emission_weight(const PathState<Color>& path, const scene::CompiledScene& scene, const scene::SurfacePoint& point,
                      Combination combination, LightSampling sampling) {
  if (!combination || path.pdf == 0) return 1;
  const uint32_t light = scene.light_at(point);
  if (light == scene::InstanceData::kNotALight) return 1;
  return combination->bsdf_weight(
      path.pdf, scene.lights().pdf_triangle(light, path.receiver(), point.position, path.time, sampling));
}

// The throughput of a path that ends at an emitter or the lens, restricted to the selected path classes.
template <class M>
typename M::Color terminal_throughput(PathWavefront<M>& paths, const typename M::Color& throughput, int index) {
  if constexpr (M::kClasses)
    return throughput * paths.shares().end_share(index);
  else
    return throughput;
}

// Adds the emission of the current hits, times weigh(hit). An unlit surface (KHR_materials_unlit) is directly visible
// but lights nothing.
template <class M, class Weigh>
void add_emission_weighted(PathWavefront<M>& paths, Weigh&& weigh) {
  const scene::CompiledScene& scene = paths.scene();
  const bool recording = paths.recorder() != nullptr;
  for (int i = 0; i < paths.hit_count(); ++i) {
    const scene::SurfacePoint& point = paths.point(i);
    if (!point.material->is_emissive) continue;
    auto& path = paths.state_at(i);
    if (point.material->description.unlit && !path.all_specular) continue;
    const Rgb emitted = scene.emitted(point, paths.wo(i));
    if (is_black(emitted)) continue;
    const float weight = weigh(i);
    const auto contribution = terminal_throughput(paths, path.throughput, paths.path_at(i)) *
                              paths.color().emission(paths.path_at(i), emitted, scene.emission_spectrum(point)) *
                              weight;
    path.radiance += contribution;
    if (recording) [[unlikely]]
      record_emission(paths, paths.path_at(i), emitted, weight, contribution);
  }
}

template <class M>
void add_emission(PathWavefront<M>& paths, Combination combination = {},
                  LightSampling sampling = LightStrategy::automatic) {
  add_emission_weighted(paths, [&](int i) {
    return emission_weight(paths.state_at(i), paths.scene(), paths.point(i), combination, sampling);
  });
}

// Whether the current misses see the environment.
template <class M>
bool sees_environment(const PathWavefront<M>& paths) {
  const EnvironmentMap& map = paths.scene().lights().environment();
  return !map.black() && (paths.length() > 1 || map.visible());
}

// The radiance that a miss sees. Camera rays see the backdrop in place of a hidden environment.
template <class M>
Rgb radiance_of_miss(const PathWavefront<M>& paths, int miss) {
  const EnvironmentMap& map = paths.scene().lights().environment();
  const Vec3& direction = paths.miss_direction(miss);
  return paths.length() == 1 ? map.seen_radiance(direction) : map.radiance(direction);
}

// Adds the radiance of the environment that a miss sees, times a weight.
template <class M>
void add_environment_of_miss(PathWavefront<M>& paths, int miss, const Rgb& radiance, float weight) {
  auto& path = paths.missed_path(miss);
  const int number = paths.path_of_miss(miss);
  const EnvironmentMap& map = paths.scene().lights().environment();
  const EmissionSpectrum* spectrum = paths.length() == 1 ? map.seen_spectrum() : map.spectrum();
  const auto contribution =
      terminal_throughput(paths, path.throughput, number) * paths.color().emission(number, radiance, spectrum) * weight;
  path.radiance += contribution;
  if (paths.recorder()) [[unlikely]]
    record_emission(paths, number, radiance, weight, contribution);
}

// Adds the environment radiance for the paths that left the scene, times weigh(miss).
template <class M, class Weigh>
void add_environment_weighted(PathWavefront<M>& paths, Weigh&& weigh) {
  if (!sees_environment(paths)) return;
  for (int i = 0; i < paths.miss_count(); ++i) add_environment_of_miss(paths, i, radiance_of_miss(paths, i), weigh(i));
}

template <class M>
void add_environment(PathWavefront<M>& paths, Combination combination = {},
                     LightSampling sampling = LightStrategy::automatic) {
  if (!sees_environment(paths)) return;
  const LightTable& lights = paths.scene().lights();
  for (int i = 0; i < paths.miss_count(); ++i) {
    const auto& path = paths.missed_path(i);
    if (!combination || path.pdf == 0) {
      add_environment_of_miss(paths, i, radiance_of_miss(paths, i), 1);
      continue;
    }
    const auto value = lights.environment_value(path.from, paths.miss_direction(i), sampling);
    add_environment_of_miss(paths, i, value.radiance, combination->bsdf_weight(path.pdf, value.pdf_solid_angle));
  }
}

// The spectrum of a sampled light; null if its colour determines it, and in RGB models.
template <class M>
const EmissionSpectrum* spectrum_of([[maybe_unused]] const scene::CompiledScene& scene,
                                    [[maybe_unused]] const LightSample& light) {
  if constexpr (M::kSpectral)
    return scene.emission_spectrum(light);
  else
    return nullptr;
}

// Whether shadow rays are traced; local illumination [Lang, sec. 8.2] has none.
enum class Shadows { cast, ignored };

// Selects the current hits to be processed: all.
struct EveryHit {
  constexpr bool operator()(int) const { return true; }
};

// Adds direct light from one light sample per selected hit, times weigh(hit, light sample, BSDF value), which is a
// weight divided by the density of the sample: a number, or a ConnectionWeight.
template <class M, class Weigh, class Selected = EveryHit>
void add_light_samples_weighted(PathWavefront<M>& paths, std::span<const LightSample> samples, Shadows shadows,
                                Weigh&& weigh, const Selected& selected = {}) {
  const scene::CompiledScene& scene = paths.scene();
  const bool recording = paths.recorder() != nullptr;
  for (int i = 0; i < paths.hit_count(); ++i) {
    if (!selected(i)) continue;
    const LightSample& light = samples[static_cast<size_t>(i)];
    const Bsdf<M>& bsdf = paths.bsdf(i);
    if (light.pdf == 0 || !bsdf.has_non_delta_lobe()) continue;
    auto scattered = bsdf.evaluate(paths.wo(i), light.wi);
    if constexpr (M::kClasses)
      scattered.f_cos = paths.shares().connection_value(paths.path_at(i), bsdf, paths.wo(i), light.wi, scattered.f_cos);
    if (is_black(scattered.f_cos)) continue;
    const auto connection_weight = weigh(i, light, scattered);
    const float weight = known_factor(connection_weight);
    if (weight == 0) continue;
    auto& path = paths.state_at(i);
    const bool can_be_shadowed = shadows == Shadows::cast && light.distance > 0;
    auto& contribution = can_be_shadowed ? paths.connect(i, light.wi, light.distance) : path.radiance;
    if (can_be_shadowed) paths.set_connection_weight(connection_weight);
    const auto unoccluded =
        path.throughput * scattered.f_cos *
        paths.color().emission(paths.path_at(i), scene.radiance_of(light), spectrum_of<M>(scene, light)) * weight;
    contribution += unoccluded;
    if (recording) [[unlikely]]
      record_light(paths, i, light, weight, scattered, unoccluded, can_be_shadowed);
  }
}

// The number of light samples per vertex.
inline int light_samples_of(const Combination& combination) { return combination ? combination->light_samples : 1; }

// The weights of samples of delta lights, which are found by no other technique.
struct OnlyTechnique {
  constexpr float operator()(int, const LightSample&) const { return 1; }
};

// Adds one of the light samples of every vertex. `branches` is the number of BSDF samples of the vertex, each of which
// can find the same light. delta_weight(hit, sample) is the MIS weight of a sample of a delta light.
template <class M, class DeltaWeight = OnlyTechnique>
void add_light_samples(PathWavefront<M>& paths, std::span<const LightSample> samples, Combination combination,
                       Shadows shadows, float branches, const DeltaWeight& delta_weight = {}) {
  const auto samples_per_vertex = static_cast<float>(light_samples_of(combination));
  add_light_samples_weighted(paths, samples, shadows, [&](int i, const LightSample& light, const auto& scattered) {
    return combination && !light.delta ? combination->light_weight_over_pdf(light.pdf, branches * scattered.pdf)
                                       : delta_weight(i, light) / (samples_per_vertex * light.pdf);
  });
}

// Next event estimation with one light sample per hit, by a strategy that selects a single light.
template <class M, class Weigh, class Selected = EveryHit>
void add_direct_light_weighted(PathWavefront<M>& paths, LightSampling sampling, Shadows shadows, Weigh&& weigh,
                               const Selected& selected = {}) {
  if (paths.scene().lights().empty()) return;
  add_light_samples_weighted(paths, paths.sample_lights(sampling), shadows, weigh, selected);
}

// Samples on every light: no variance if all lights are points. [Lang, eq. 8.14-8.19, corrected]
template <class M, class DeltaWeight = OnlyTechnique>
void add_light_of_all_sources(PathWavefront<M>& paths, LightSampling sampling, Combination combination,
                              Shadows shadows = Shadows::cast, float branches = 1,
                              const DeltaWeight& delta_weight = {}) {
  const size_t sources = paths.scene().lights().source_count(sampling);
  const size_t count = sources * static_cast<size_t>(light_samples_of(combination));
  for (size_t stream = 0; stream < count; ++stream) {
    paths.reserve_connections();
    add_light_samples(paths, paths.sample_source(stream % sources, sampling, stream), combination, shadows, branches,
                      delta_weight);
  }
  paths.select_rng_stream(0);
}

// Several samples of the strategy per vertex, each with random numbers of its own.
template <class M, class DeltaWeight>
[[gnu::noinline]] void add_repeated_light_samples(PathWavefront<M>& paths, LightSampling sampling,
                                                  Combination combination, Shadows shadows, float branches,
                                                  const DeltaWeight& delta_weight) {
  for (int k = 0; k < light_samples_of(combination); ++k) {
    paths.reserve_connections();
    paths.select_light_stream(static_cast<size_t>(k));
    add_light_samples(paths, paths.sample_lights(sampling), combination, shadows, branches, delta_weight);
  }
  paths.select_rng_stream(0);
}

template <class M, class DeltaWeight = OnlyTechnique>
void add_direct_light(PathWavefront<M>& paths, LightSampling sampling, Combination combination,
                      Shadows shadows = Shadows::cast, float branches = 1, const DeltaWeight& delta_weight = {}) {
  if (paths.scene().lights().empty(sampling)) return;
  if (sampling.strategy == LightStrategy::every)
    add_light_of_all_sources(paths, sampling, combination, shadows, branches, delta_weight);
  else if (light_samples_of(combination) > 1)
    add_repeated_light_samples(paths, sampling, combination, shadows, branches, delta_weight);
  else
    add_light_samples(paths, paths.sample_lights(sampling), combination, shadows, branches, delta_weight);
}

// Whether a current hit lies in a scattering medium that paths can leave.
template <class M>
bool is_in_bounded_medium(const PathWavefront<M>& paths, int hit) {
  if constexpr (M::kScattering)
    return paths.point(hit).in_volume && !paths.scene().atmosphere_is_unbounded();
  else
    return false;
}
// The path continues from a current hit by `s`; the result is recorded under the number of the hit's path.
template <class M>
bool survives_roulette(PathWavefront<M>& paths, const RouletteSettings& roulette, int hit,
                       PathState<typename M::Color>& path, const LobeSample<typename M::Color>& s, float random) {
  const float survival = survival_probability(roulette, path, s, is_in_bounded_medium(paths, hit));
  if (paths.recorder()) [[unlikely]]
    record_roulette(paths, paths.path_at(hit), survival, random);
  if (!(random < survival)) return false;
  path.throughput /= survival;
  return true;
}

// Records the scattering event that the path continues with. `normal` is that of the vertex as a receiver of light; a
// LightReceiver in place of both arguments would be composed of words and copied as a whole, which stalls.
template <class Color>
void record_scattering(PathState<Color>& path, const Vec3& position, PackedNormal normal, const LobeSample<Color>& s) {
  path.pdf = s.delta ? 0 : s.pdf_solid_angle;
  path.from = position;
  path.normal = normal;
  path.all_specular = path.all_specular && s.delta;
}

// The default filter of BSDF samples: accepts all of them, restricted to the selected path classes. Filters may change
// the sample; they return false if the path does not continue.
struct AcceptAll {
  template <class M>
  bool operator()(PathWavefront<M>& paths, int hit, LobeSample<typename M::Color>& s) const {
    if constexpr (M::kClasses) return paths.shares().scatter(paths.path_at(hit), paths.bsdf(hit), paths.wo(hit), s);
    return true;
  }
};

// Samples the next direction of every current path. Paths end if they are absorbed, rejected by `accept`, terminated by
// Russian roulette, or if continues(hit) is false. Paths from lights use
// TransportMode::importance: their power is not scaled by refraction as radiance is. record(hit, sample) is called for
// every path that continues.
template <class M, class Continues, class Record, class Accept = AcceptAll>
void sample_bsdf_where(PathWavefront<M>& paths, const RouletteSettings& roulette, TransportMode mode,
                       Continues&& continues, Record&& record, const Accept& accept = {}) {
  const bool may_end = paths.length() >= roulette.start;
  paths.draw_lobes();
  if (may_end) paths.draw(dimensions(vertex_dimension::kRoulette, 1));
  const bool recording = paths.recorder() != nullptr;
  for (int i = 0; i < paths.hit_count(); ++i) {
    if (!continues(i)) continue;
    LobeSample<typename M::Color> s;
    const bool scattered = paths.bsdf(i).sample(paths.wo(i), paths.lobe_draw(i), mode, s);
    if (recording) [[unlikely]]
      record_sample(paths, i, s, scattered ? PathEnd::none : PathEnd::absorbed);
    if (!scattered) continue;
    if (!accept(paths, i, s)) {
      if (recording) [[unlikely]]
        record_end(paths, i, PathEnd::excluded);
      continue;
    }
    auto& path = paths.state_at(i);
    path.throughput *= s.weight;
    if (mode == TransportMode::radiance) path.eta_scale *= sqr(s.eta);
    if (may_end && !survives_roulette(paths, roulette, i, path, s, paths.random(vertex_dimension::kRoulette, i))) {
      if (recording) [[unlikely]]
        record_end(paths, i, PathEnd::roulette);
      continue;
    }
    if (recording) [[unlikely]]
      record_throughput(paths, i, path.throughput);
    record_scattering(path, paths.point(i).position, paths.receiver_normal(i), s);
    record(i, s);
    paths.continue_path(i, s.wi);
  }
}

template <class M, class Record, class Accept = AcceptAll>
void sample_bsdf_and_record(PathWavefront<M>& paths, const RouletteSettings& roulette, TransportMode mode,
                            Record&& record, const Accept& accept = {}) {
  sample_bsdf_where(
      paths, roulette, mode, [](int) { return true; }, record, accept);
}

template <class M, class Accept = AcceptAll>
void sample_bsdf(PathWavefront<M>& paths, const RouletteSettings& roulette,
                 TransportMode mode = TransportMode::radiance, const Accept& accept = {}) {
  sample_bsdf_and_record(
      paths, roulette, mode, [](int, const auto&) {}, accept);
}

}  // namespace etendue::transport
