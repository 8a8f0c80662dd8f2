// The thesis's letters D_G and S_G: what is diffuse or slightly glossy, and what is specular or highly glossy.
//                                                                                       thesis L16849, L17950; S1
// Photons are stored where something of a surface is wide, and its wide part is estimated from them; its narrow part is
// followed by rays. All of a surface's glossy lobes have the same facets, so that they are wide or narrow together.
#pragma once
#include "transport/wavefront/path_estimators.h"

namespace etendue::transport {

class LobeSplit {
 public:
  // Glossy lobes of a lower roughness (the root of the facets' slope) are narrow.
  explicit LobeSplit(float roughness) : alpha_(sqr(roughness)) {}

  template <class M>
  bool gloss_is_rough(const Bsdf<M>& bsdf) const {
    if constexpr (M::kDiffuse)
      return true;
    else
      return bsdf.lobes.min_alpha() >= alpha_;
  }
  template <class M>
  bool has_rough(const Bsdf<M>& bsdf) const {
    return bsdf.has_component(ScatterType::diffuse) ||
           (bsdf.has_component(ScatterType::glossy) && gloss_is_rough(bsdf));
  }
  template <class M>
  bool has_near_specular_gloss(const Bsdf<M>& bsdf) const {
    return bsdf.has_component(ScatterType::glossy) && !gloss_is_rough(bsdf);
  }

  // The wide part of f.
  template <class M>
  typename M::Color wide(const Bsdf<M>& bsdf, const Vec3& wo, const Vec3& wi, TransportMode mode) const {
    return has_near_specular_gloss(bsdf) ? bsdf.eval_component(ScatterType::diffuse, wo, wi, mode)
                                         : bsdf.eval(wo, wi, mode);
  }

  friend bool operator==(const LobeSplit&, const LobeSplit&) = default;

 private:
  float alpha_;
};

// A walk goes on by the narrow part alone.
struct TakeNearSpecular {
  LobeSplit split;
  TransportMode mode = TransportMode::radiance;

  template <class M>
  bool operator()(PathWavefront<M>& paths, int hit, LobeSample<typename M::Color>& s) const {
    const Bsdf<M>& bsdf = paths.bsdf(hit);
    if (!s.delta) {
      if (!split.has_near_specular_gloss(bsdf)) return false;
      const Vec3& wo = paths.wo(hit);
      s.weight *= ratio(bsdf.eval_component(ScatterType::glossy, wo, s.wi, mode), bsdf.eval(wo, s.wi, mode));
    }
    if constexpr (M::kClasses)
      return paths.shares().scatter_by(paths.path_at(hit), s.delta ? Event::specular : Event::glossy);
    return true;
  }
};

// What is reflected of a sampled light: by the wide part, for which nothing else finds it, and by the narrow part, for
// which the walk's own direction does too.
enum class LitParts { near_specular, rough, both };
inline constexpr MisHeuristic kPartsHeuristic = MisHeuristic::power;

template <class M, class Selected = EveryHit>
void add_light_by_parts(PathWavefront<M>& paths, const LobeSplit& split, LitParts lit, const Selected& selected = {}) {
  using Color = typename M::Color;
  const scene::CompiledScene& scene = paths.scene();
  if (scene.lights().empty() || (M::kDiffuse && lit == LitParts::near_specular)) return;
  const std::span<const LightSample> samples = paths.sample_lights(LightStrategy::automatic);
  for (int i = 0; i < paths.hit_count(); ++i) {
    const LightSample& light = samples[static_cast<size_t>(i)];
    const Bsdf<M>& bsdf = paths.bsdf(i);
    const bool narrow_gloss = split.has_near_specular_gloss(bsdf);
    if (light.pdf == 0 || !selected(i) || !(narrow_gloss || (lit != LitParts::near_specular && split.has_rough(bsdf))))
      continue;
    const Vec3& wo = paths.wo(i);
    const auto whole = bsdf.evaluate(wo, light.wi);
    Color diffuse = whole.f_cos, glossy(0);
    if (bsdf.has_component(ScatterType::glossy)) {
      glossy = bsdf.eval_component(ScatterType::glossy, wo, light.wi) * bsdf.cosine(light.wi);
      diffuse = bsdf.eval_component(ScatterType::diffuse, wo, light.wi) * bsdf.cosine(light.wi);
    }
    if constexpr (M::kClasses) {
      diffuse *= paths.shares().of_connection_by(paths.path_at(i), Event::diffuse);
      glossy *= paths.shares().of_connection_by(paths.path_at(i), Event::glossy);
    }
    const float alone = lit == LitParts::near_specular ? 0 : 1 / light.pdf;
    float of_gloss = alone;
    if (narrow_gloss)
      of_gloss = lit == LitParts::rough ? 0
                 : light.delta          ? 1 / light.pdf
                                        : mis_weight_over_pdf(kPartsHeuristic, light.pdf, whole.pdf);
    const Color reflected = diffuse * alone + glossy * of_gloss;
    if (is_black(reflected)) continue;
    auto& path = paths.state_at(i);
    auto& gain = light.distance > 0 ? paths.connect(i, light.wi, light.distance) : path.radiance;
    gain += path.throughput * reflected * scene.radiance_of(light);
  }
}

}  // namespace etendue::transport
