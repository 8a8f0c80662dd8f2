// Path tracing with next event estimation                                [Lang, sec. 9.1.2, eq. 9.26-9.29; Kajiya 1986]
//
// Estimates L = L_e + T L with one random path per sample. At each vertex x_i the direct light is estimated twice, by
// sampling n lights (`light-samples`) and by sampling the BSDF:
//
//    L  ~  sum over i  beta_i ( 1/n sum w_l f_s L_e |cos| V / p_l  +  w_b f_s L_e |cos| / p_b )
//    beta_i = product of f_s |cos| / p_b over the vertices before x_i
//
// w_l and w_b are weights of multiple importance sampling [Lang, sec. 6.6.9; Veach and Guibas 1995]. With the heuristic
// `partition`, w_l = 1: emitters that BSDF samples hit do not count, except where light sampling cannot find them
// [Lang, Remark 9.6].
//
//   Paths         E(D|G|S|V)*L; point lights: E.*(D|G|V)L
//   Bias          none; by default Russian roulette on the throughput, survival probability at most 0.95
//   Cost          two rays per vertex, no memory beyond the path
//   Limitations   Caustics of small lights are noisy: EDS+L is found only if a path happens to hit the light.
//                 Point lights behind glass are never found.
#include "integrator/path/path_tracing_parameters.h"
#include "integrator/registration.h"
#include "transport/wavefront/equiangular_light.h"
#include "transport/wavefront/medium_light.h"
#include "transport/wavefront/subsurface_scattering.h"

namespace etendue::integrator {

class PathTracing final : public CameraPathIntegrator<PathTracing>, public PathTracingParameters {
 public:
  static constexpr bool kScatteringMedia = true, kSpectral = true;

  static IntegratorInfo info() {
    return {
        .name = "path",
        .label = "Path tracing",
        .summary = "Random paths from the camera with direct light at every vertex",
        .group = Group::gathering,
        .paths = "E(D|G|S|V)*L",
        .point_paths = "E.*(D|G|V)L",
        .bias = Bias::unbiased,
        .cost = "2 rays per vertex; no memory beyond the path",
        .limitations =
            "Caustics of small lights are noisy: EDS+L is found only if a path happens to hit the light. Point lights "
            "behind glass are never found.",
        .accumulation = Accumulation::per_pixel,
        .shortcut = '4',
        .scattering_media = kScatteringMedia,
        .heterogeneous_media = true,
        .emitting_media = true,
        .subsurface = true,
        .spectral = kSpectral,
    };
  }

  auto parameters() { return std::tuple_cat(std::tie(max_depth), path_parameters()); }

  template <class M>
  void estimate(transport::PathWavefront<M>& paths, LightSampling sampling) const {
    using namespace transport;
    if constexpr (M::kScattering)
      if (equiangular) return estimate_with_equiangular_light(paths, sampling);
    const Combination combination = mis();
    MediumLight<M> media(paths, combination);
    while (paths.trace()) {
      add_environment(paths, combination, sampling);
      media.add_emission_of_misses();
      while (paths.next_hits()) {
        media.add_emission_before_hits();
        add_emission(paths, combination, sampling);
        if (at_max_depth(paths.length())) continue;
        scatter_below_surface(paths);
        add_direct_light(paths, sampling, combination);
        media.add_light_samples();
        sample_bsdf(paths, roulette());
      }
    }
  }

 private:
  template <class M>
  void estimate_with_equiangular_light(transport::PathWavefront<M>& paths, LightSampling sampling) const {
    using namespace transport;
    const Combination combination = mis();
    EquiangularLight<M> segments(paths, sampling, *combination);
    MediumLight<M> media(paths, combination);
    while (paths.trace()) {
      add_environment(paths, combination, sampling);
      media.add_emission_of_misses();
      if (!at_max_depth(paths.length())) segments.add_light_of_misses();
      while (paths.next_hits()) {
        media.add_emission_before_hits();
        add_emission(paths, combination, sampling);
        if (at_max_depth(paths.length())) continue;
        segments.add_light_before_hits();
        scatter_below_surface(paths);
        add_direct_light(paths, sampling, combination, Shadows::cast, 1, [&](int hit, const LightSample& light) {
          return segments.weight_of_light_sample(hit, light);
        });
        media.add_light_samples();
        sample_bsdf(paths, roulette());
      }
    }
  }
};

Registration path_tracing() { return registration<PathTracing>(); }

}  // namespace etendue::integrator
