// Division of lobes by roughness: D_G (diffuse or rough glossy) and S_G (specular or near-specular).
//                                                                                                 [Lang, sec. 8.1, 9.5]
//
// Photons are stored at surfaces with rough lobes, whose reflection is estimated from them; near-specular lobes are ray
// traced. All glossy lobes of a surface have the same microfacets, so that all of them are in the same group. Phase
// functions belong to D_G.
#pragma once
#include "transport/wavefront/path_estimators.h"

namespace etendue::transport {

// Whether a vertex is on a surface whose only lobe is Lambertian.
template <class M>
bool is_lambertian(const Bsdf<M>& bsdf) {
  using Lambertian = Lambert<typename M::Color>;
  if constexpr (M::kScattering)
    return !bsdf.in_volume() && is_lambertian<typename M::Surfaces>(bsdf.surface());
  else if constexpr (M::kDiffuse)
    return true;
  else if constexpr (requires { bsdf.lobes.template single_lobe_as<Lambertian>(); })
    return bsdf.lobes.template single_lobe_as<Lambertian>() != nullptr;
  else
    return false;
}

class LobeSplit {
 public:
  // Glossy lobes below this roughness (the root of the facet slope) are near-specular.
  explicit LobeSplit(float roughness) : alpha_(sqr(roughness)) {}

  template <class M>
  bool gloss_is_rough(const Bsdf<M>& bsdf) const {
    if constexpr (M::kDiffuse)
      return true;
    else if constexpr (M::kScattering)
      return bsdf.in_volume() || bsdf.surface().lobes.min_alpha() >= alpha_;
    else
      return bsdf.lobes.min_alpha() >= alpha_;
  }
  template <class M>
  bool has_rough(const Bsdf<M>& bsdf) const {
    if constexpr (M::kScattering)
      if (bsdf.in_volume()) return true;
    return bsdf.has_component(ScatterType::diffuse) ||
           (bsdf.has_component(ScatterType::glossy) && gloss_is_rough(bsdf));
  }
  template <class M>
  bool has_near_specular_gloss(const Bsdf<M>& bsdf) const {
    return bsdf.has_component(ScatterType::glossy) && !gloss_is_rough(bsdf);
  }

  // Whether a vertex may continue paths by near-specular lobes; an upper bound.
  template <class M>
  bool may_have_near_specular(const Bsdf<M>& bsdf) const {
    if constexpr (M::kScattering)
      if (bsdf.in_volume()) return false;
    return !is_lambertian<M>(bsdf);
  }

  // The rough lobes of f.
  template <class M>
  typename M::Color rough_value(const Bsdf<M>& bsdf, const Vec3& wo, const Vec3& wi, TransportMode mode) const {
    return has_near_specular_gloss(bsdf) ? bsdf.eval_component(ScatterType::diffuse, wo, wi, mode)
                                         : bsdf.eval(wo, wi, mode);
  }

  friend bool operator==(const LobeSplit&, const LobeSplit&) = default;

 private:
  float alpha_;
};

// Filter of BSDF samples (AcceptAll): continues paths by near-specular lobes only.
struct AcceptNearSpecular {
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

// The lobes that reflect light samples: rough lobes, for which light sampling is the only technique, and near-specular
// lobes, for which BSDF sampling finds the same light.
enum class LitLobes { near_specular, rough, both };
inline constexpr MisHeuristic kLobeSplitHeuristic = MisHeuristic::power;

// The share of a connection by the diffuse lobes or the phase function of a current vertex.
template <class M>
typename M::Color share_of_rough(PathWavefront<M>& paths, int hit) requires(M::kClasses) {
  const int path = paths.path_at(hit);
  if (paths.in_volume(hit)) return paths.shares().volume_connection_share(path);
  return paths.shares().connection_share(path, Event::diffuse);
}

struct NoHit {
  constexpr bool operator()(int) const { return false; }
};

// delta_weight(hit, sample) is the MIS weight of a sample of a delta light. Paths continue from the collisions in media
// for which continues(hit) holds, so that their phase functions count as near-specular lobes.
template <class M, class Selected = EveryHit, class DeltaWeight = OnlyTechnique, class Continues = NoHit>
void add_direct_light_by_lobe(PathWavefront<M>& paths, const LobeSplit& split, LitLobes lobes,
                              const Selected& selected = {}, const DeltaWeight& delta_weight = {},
                              const Continues& continues = {}) {
  using Color = typename M::Color;
  const scene::CompiledScene& scene = paths.scene();
  if (scene.lights().empty() || (M::kDiffuse && lobes == LitLobes::near_specular)) return;
  const std::span<const LightSample> samples = paths.sample_lights(LightStrategy::automatic);
  for (int i = 0; i < paths.hit_count(); ++i) {
    const LightSample& light = samples[static_cast<size_t>(i)];
    const Bsdf<M>& bsdf = paths.bsdf(i);
    const bool has_near_specular = split.has_near_specular_gloss(bsdf) || continues(i);
    if (light.pdf == 0 || !selected(i) ||
        !(has_near_specular || (lobes != LitLobes::near_specular && split.has_rough(bsdf))))
      continue;
    const Vec3& wo = paths.wo(i);
    const auto full = bsdf.evaluate(wo, light.wi);
    Color diffuse = full.f_cos, glossy(0);
    if (bsdf.has_component(ScatterType::glossy)) {
      glossy = bsdf.eval_component(ScatterType::glossy, wo, light.wi) * bsdf.cosine(light.wi);
      diffuse = bsdf.eval_component(ScatterType::diffuse, wo, light.wi) * bsdf.cosine(light.wi);
    }
    if (continues(i)) std::swap(diffuse, glossy);
    if constexpr (M::kClasses) {
      diffuse *= share_of_rough(paths, i);
      glossy *=
          continues(i) ? share_of_rough(paths, i) : paths.shares().connection_share(paths.path_at(i), Event::glossy);
    }
    const float rough_weight = lobes == LitLobes::near_specular ? 0
                               : light.delta                    ? delta_weight(i, light) / light.pdf
                                                                : 1 / light.pdf;
    float glossy_weight = rough_weight;
    if (has_near_specular)
      glossy_weight = lobes == LitLobes::rough ? 0
                      : light.delta            ? delta_weight(i, light) / light.pdf
                                               : mis_weight_over_pdf(kLobeSplitHeuristic, light.pdf, full.pdf);
    const Color scattered = diffuse * rough_weight + glossy * glossy_weight;
    if (is_black(scattered)) continue;
    auto& path = paths.state_at(i);
    auto& contribution = light.distance > 0 ? paths.connect(i, light.wi, light.distance) : path.radiance;
    contribution += path.throughput * scattered * scene.radiance_of(light);
  }
}

}  // namespace etendue::transport
