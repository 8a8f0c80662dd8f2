// Direct light at the first vertices of camera paths, with a control variate.
//                                                   [Lang, sec. 6.5.3; Kondapaneni et al. 2019; Veach and Guibas 1995]
//
// Light sampling (density p_l) and BSDF sampling (density p_b), one sample each, are combined by the balance heuristic:
//
//    B = f V / (p_l + p_b) at the light sample  +  f V / (p_l + p_b) at the BSDF sample
//
// The control is the difference of two estimates of the same integral, so that its expectation is zero:
//
//    K = a ( V p_b / (p_l + p_b) at the light sample  -  V p_l / (p_l + p_b) at the BSDF sample )
//
// V is 1 if the light is visible; at samples of the environment it is left out of K, which is then known without a
// shadow ray. B + c K with a = 1 and the best c for a point is the estimator with the optimal weights of the two
// techniques [Kondapaneni et al. 2019, eq. 14], where the densities count visible points only. With the albedo a of
// diffuse reflection and c = -L_a, light of the constant radiance L_a is subtracted from the integrand, and its integral
// a L_a is added [Lang, eq. 6.468-6.472, corrected].
#pragma once
#include <array>

#include "integrator/pixel_block.h"
#include "transport/wavefront/path_estimators.h"

namespace etendue::integrator {

// Which lights the control covers; a is the diffuse albedo for the environment, and 1 for all lights.
enum class ControlledLights { environment, all };

// Models in which nothing lies between a vertex and a light but what hides it.
template <class M>
inline constexpr bool kHasControl = !M::kClasses && !M::kMedia;

// c for each path of a wavefront.
using PathCoefficients = std::array<Rgb, PixelBlock::kMostPixels>;

// What is estimated at first vertices: B + c K, or the quantities that c depends on (control_coefficients.h).
enum class ControlTerm { radiance, difference, overlap };

// The factors of f V, and of c a, in the estimate of a term at a sample with these densities. Of the radiance, the
// control has opposite signs at the two samples.
inline float light_factor(ControlTerm term, float light_pdf, float bsdf_pdf) {
  const float sum = light_pdf + bsdf_pdf;
  if (term == ControlTerm::radiance) return 1 / sum;
  return term == ControlTerm::difference ? (light_pdf - bsdf_pdf) / (sum * sum) : 0;
}
inline float control_factor(ControlTerm term, float light_pdf, float bsdf_pdf, bool at_light_sample) {
  const float sum = light_pdf + bsdf_pdf;
  if (term == ControlTerm::radiance) return at_light_sample ? bsdf_pdf / sum : -light_pdf / sum;
  return term == ControlTerm::overlap ? light_pdf * bsdf_pdf / (sum * sum) : 0;
}

template <class M>
class DirectLightControl {
 public:
  static constexpr LightSampling kSampling = LightSampling::compensated(LightStrategy::automatic);

  DirectLightControl(transport::PathWavefront<M>& paths, ControlledLights controlled,
                     const PathCoefficients& coefficients, ControlTerm term = ControlTerm::radiance)
      : paths_(paths), controlled_(controlled), coefficients_(coefficients), term_(term) {}

  // Adds the light samples of the current first vertices, and continues their paths by BSDF samples.
  void scatter(const transport::RouletteSettings& roulette) {
    find_controls();
    if (!paths_.scene().lights().empty()) add_light_samples();
    transport::sample_bsdf_and_record(paths_, roulette, TransportMode::radiance,
                                      [&](int hit, const auto& s) { add_control_of_environment(hit, s); });
  }

  // Adds the emission of the current second vertices.
  void add_emission() {
    const scene::CompiledScene& scene = paths_.scene();
    for (int i = 0; i < paths_.hit_count(); ++i) {
      const scene::SurfacePoint& point = paths_.point(i);
      if (!point.material->is_emissive) continue;
      auto& path = paths_.state_at(i);
      if (point.material->description.unlit && !path.all_specular) continue;
      const Rgb emitted = scene.emitted(point, paths_.wo(i));
      if (is_black(emitted)) continue;
      const float light_pdf = light_pdf_of(path, point);
      path.radiance += path.throughput * emitted * bsdf_sample_factor(path.pdf, light_pdf);
      if (controlled_ == ControlledLights::all && path.pdf > 0)
        path.radiance += control(i) * control_factor(term_, light_pdf, path.pdf, false);
    }
  }

  // Adds the environment that the current misses see from first vertices.
  void add_environment() {
    if (!transport::sees_environment(paths_)) return;
    const LightTable& lights = paths_.scene().lights();
    for (int i = 0; i < paths_.miss_count(); ++i) {
      const auto& path = paths_.missed_path(i);
      const auto value = lights.environment_value(path.from, paths_.miss_direction(i), kSampling);
      transport::add_environment_of_miss(paths_, i, value.radiance,
                                         bsdf_sample_factor(path.pdf, value.pdf_solid_angle));
    }
  }

  // a of the first vertices that `scatter` has processed, by the number of the path.
  const PathCoefficients& albedos() const { return albedos_; }

 private:
  Rgb& control(int hit) { return controls_[static_cast<size_t>(paths_.path_at(hit))]; }

  // The factor of the throughput f / p_b. Specular samples have the density 0 here, and no light sample competes.
  float bsdf_sample_factor(float bsdf_pdf, float light_pdf) const {
    if (bsdf_pdf > 0) return bsdf_pdf * light_factor(term_, light_pdf, bsdf_pdf);
    return term_ == ControlTerm::radiance ? 1.0f : term_ == ControlTerm::difference ? -1.0f : 0.0f;
  }

  // 0 if light sampling cannot find the point.
  float light_pdf_of(const transport::PathState<Rgb>& path, const scene::SurfacePoint& point) const {
    const uint32_t light = paths_.scene().light_at(point);
    if (path.pdf == 0 || light == scene::InstanceData::kNotALight) return 0;
    return paths_.scene().lights().pdf_triangle(light, path.receiver(), point.position, path.time, kSampling);
  }

  // Stores a, and a c times the throughput.
  void find_controls() {
    for (int i = 0; i < paths_.hit_count(); ++i) {
      const auto path = static_cast<size_t>(paths_.path_at(i));
      albedos_[path] = Rgb(0);
      if (paths_.bsdf(i).has_non_delta_lobe())
        albedos_[path] = controlled_ == ControlledLights::all ? Rgb(1) : diffuse_albedo(i);
      controls_[path] = paths_.state_at(i).throughput * coefficients_[path] * albedos_[path];
    }
  }

  // Exact for Lambert's model.
  Rgb diffuse_albedo(int hit) const {
    const auto& bsdf = paths_.bsdf(hit);
    const Vec3 &wo = paths_.wo(hit), &ng = paths_.point(hit).ng;
    const Vec3 normal = glm::dot(ng, wo) < 0 ? -ng : ng;
    if (bsdf.has_component(ScatterType::glossy)) return bsdf.eval_component(ScatterType::diffuse, wo, normal) * kPi;
    return bsdf.evaluate(wo, normal).f_cos * kPi;
  }

  void add_light_samples() {
    const std::span<const LightSample> samples = paths_.sample_lights(kSampling);
    for (int i = 0; i < paths_.hit_count(); ++i) {
      const LightSample& light = samples[static_cast<size_t>(i)];
      const auto& bsdf = paths_.bsdf(i);
      if (light.pdf == 0 || !bsdf.has_non_delta_lobe()) continue;
      const auto scattered = bsdf.evaluate(paths_.wo(i), light.wi);
      const Rgb radiance = paths_.scene().radiance_of(light);
      const bool is_dark = is_black(scattered.f_cos) || is_black(radiance);
      // BSDF samples find black parts of the environment as well, so the control has to contain both.
      if (is_dark && light.kind != LightKind::environment) continue;
      const float bsdf_pdf = light.delta ? 0 : scattered.pdf;
      auto& path = paths_.state_at(i);
      Rgb visible = path.throughput * scattered.f_cos * radiance * light_factor(term_, light.pdf, bsdf_pdf);
      if (!light.delta) {
        const Rgb added = control(i) * control_factor(term_, light.pdf, bsdf_pdf, true);
        if (light.kind == LightKind::environment)
          path.radiance += added;
        else if (controlled_ == ControlledLights::all)
          visible += added;
      }
      if (is_dark) continue;
      if (light.distance > 0)
        paths_.connect(i, light.wi, light.distance) += visible;
      else
        path.radiance += visible;
    }
  }

  void add_control_of_environment(int hit, const LobeSample<Rgb>& s) {
    const LightTable& lights = paths_.scene().lights();
    if (s.delta || lights.environment().black()) return;
    const float light_pdf = lights.pdf_environment(paths_.point(hit).position, s.wi, kSampling);
    paths_.state_at(hit).radiance += control(hit) * control_factor(term_, light_pdf, s.pdf_solid_angle, false);
  }

  transport::PathWavefront<M>& paths_;
  const ControlledLights controlled_;
  const PathCoefficients& coefficients_;
  const ControlTerm term_;
  PathCoefficients albedos_{}, controls_{};  // by the number of the path
};

}  // namespace etendue::integrator
