// Light of media that emit: the emission on the segments of camera paths, and direction samples towards emitting media.
//
// Both find the light that media emit along a ray up to the next surface, and are combined by multiple importance
// sampling over the direction of the ray (MediumEmitters):
//
//   continuation of the path   density of the BSDF or phase function
//   light sample               density of directions through cells of emitting media
//
// Segments that no other technique samples, above all those that start at the camera, are integrated voxel by voxel.
//
// The functions do nothing in models without scattering media, and add nothing in scenes without emitting ones.
#pragma once
#include "transport/wavefront/path_estimators.h"

namespace etendue::transport {

// How a technique counts for the current vertex of a path.
struct TechniqueWeight {
  float factor = 1;          // of its contribution, besides the MIS weight; 0: it does not count
  bool other_exists = true;  // the other technique finds the same light
};
// Both techniques are used at every vertex.
struct BothTechniques {
  static TechniqueWeight emission(int) { return {}; }
  static TechniqueWeight light_sample(int) { return {}; }
};

// `Techniques` has the functions of BothTechniques, whose argument is the number of a path.
template <class M, class Techniques = BothTechniques>
class MediumLight {
 public:
  // Without a heuristic, paths find all light themselves, and there are no light samples.
  MediumLight(PathWavefront<M>& paths, Combination combination, const Techniques& techniques = {})
      : paths_(paths),
        combination_(combination ? Combination(combination->with_one_light_sample()) : Combination()),
        techniques_(techniques),
        emits_(paths.scene().solids().any_medium_emits()),
        heterogeneous_(paths.scene().solids().any_heterogeneous()) {}

  // The emission on segments that left the scene. To be called before the first hits are processed.
  void add_emission_of_misses() {
    if constexpr (M::kScattering)
      for (int i = 0; emits_ && i < paths_.miss_count(); ++i)
        add_emission(paths_.path_of_miss(i), paths_.miss_direction(i));
  }
  // The emission on segments that end at a current hit. To be called before their paths change.
  void add_emission_before_hits() {
    if constexpr (M::kScattering)
      for (int i = 0; emits_ && i < paths_.hit_count(); ++i) add_emission(paths_.path_at(i), -paths_.wo(i));
  }

  // One direction sample per current hit. `branches` is the number of BSDF samples of the vertex.
  void add_light_samples(float branches = 1) {
    if constexpr (M::kScattering) {
      if (emitters().empty() || !combination_) return;
      paths_.select_rng_stream(PathWavefront<M>::kMediumLightStream);
      paths_.draw(kNumbers);
      for (int i = 0; i < paths_.hit_count(); ++i) add_light_sample(i, branches);
      paths_.select_rng_stream(0);
    }
  }

 private:
  using Color = typename M::Color;
  static constexpr int kCell = vertex_dimension::kLightChoice, kPlane = vertex_dimension::kLightPoint,
                       kDepth = vertex_dimension::kBsdfLobe, kSelection = vertex_dimension::kRoulette;
  static constexpr DimensionSet kNumbers =
      dimensions(kCell, 1) | dimensions(kPlane, 2) | dimensions(kDepth, 1) | dimensions(kSelection, 1);
  // Paths whose throughput is below the inverse of this number have light samples with a smaller probability.
  static constexpr float kImportant = 8;

  const MediumEmitters& emitters() const { return paths_.scene().solids().emitters(); }

  // The weight of emission in the direction of a path's last segment.
  float weight_of_emission(int path, const Vec3& direction) const {
    const PathState<Color>& state = paths_.state(path);
    const TechniqueWeight technique = techniques_.emission(path);
    if (!combination_ || state.pdf == 0 || !technique.other_exists) return technique.factor;
    return technique.factor * combination_->bsdf_weight(state.pdf, emitters().pdf(state.from, direction));
  }

  void add_emission(int path, const Vec3& direction) {
    Color emitted = paths_.media().emitted(path);
    if (heterogeneous_ && combination_ && paths_.state(path).pdf == 0)
      emitted = paths_.radiance_of_media_on_segment(path);
    if (is_black(emitted)) return;
    auto& state = paths_.state(path);
    const float weight = weight_of_emission(path, direction);
    if (weight == 0) return;
    const Color contribution = terminal_throughput(paths_, paths_.media().unattenuated(path), path) * emitted * weight;
    state.radiance += contribution;
    if (paths_.recorder()) [[unlikely]]
      record_emission(path, emitted, weight, contribution);
  }

  void add_light_sample(int hit, float branches) {
    const Bsdf<M>& bsdf = paths_.bsdf(hit);
    const TechniqueWeight technique = techniques_.light_sample(paths_.path_at(hit));
    if (technique.factor == 0 || !bsdf.has_non_delta_lobe()) return;
    auto& path = paths_.state_at(hit);
    const float probability = std::min(kImportant * max_component(path.throughput), 1.0f);
    if (!(paths_.random(kSelection, hit) < probability)) return;
    const MediumEmitters::Sample light =
        emitters().sample(paths_.point(hit).position, paths_.random(kCell, hit),
                          Vec3(paths_.random_2d(kPlane, hit), paths_.random(kDepth, hit)));
    if (!(light.pdf > 0)) return;
    auto scattered = bsdf.evaluate(paths_.wo(hit), light.direction);
    if constexpr (M::kClasses)
      scattered.f_cos =
          paths_.shares().connection_value(paths_.path_at(hit), bsdf, paths_.wo(hit), light.direction, scattered.f_cos);
    if (is_black(scattered.f_cos)) return;
    const Color radiance = paths_.radiance_of_media(hit, light.direction);
    if (is_black(radiance)) return;
    const float other_pdf = technique.other_exists ? branches * scattered.pdf : 0;
    const float weight = technique.factor * combination_->light_weight_over_pdf(light.pdf, other_pdf) / probability;
    const Color contribution = path.throughput * scattered.f_cos * radiance * weight;
    path.radiance += contribution;
    if (paths_.recorder()) [[unlikely]]
      record(hit, light, radiance, weight, scattered, contribution);
  }

  [[gnu::cold, gnu::noinline]] void record_emission(int path, const Color& emitted, float weight,
                                                    const Color& contribution) {
    const auto& color = paths_.color();
    paths_.recorder()->add_medium_emission(path,
                                           {color.to_rgb(path, emitted), weight, color.to_rgb(path, contribution)});
  }
  [[gnu::cold, gnu::noinline]] void record(int hit, const MediumEmitters::Sample& light, const Color& radiance,
                                           float weight, const typename Bsdf<M>::Value& scattered,
                                           const Color& contribution) {
    const int path = paths_.path_at(hit);
    const auto to_rgb = [&](const Color& color) { return paths_.color().to_rgb(path, color); };
    LightSample sample;
    sample.kind = LightKind::medium;
    sample.wi = light.direction;
    sample.pdf = light.pdf;
    sample.radiance = to_rgb(radiance);
    sample.distance = 0;  // the estimate of the radiance includes occlusion
    paths_.recorder()->add_light(path,
                                 {.sample = sample,
                                  .radiance = sample.radiance,
                                  .f_cos = to_rgb(scattered.f_cos),
                                  .bsdf_pdf = scattered.pdf,
                                  .mis_weight = weight * light.pdf,
                                  .unoccluded = to_rgb(contribution)},
                                 -1);
  }

  PathWavefront<M>& paths_;
  Combination combination_;
  Techniques techniques_;
  bool emits_, heterogeneous_;
};

}  // namespace etendue::transport
