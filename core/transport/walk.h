// A random walk from the camera, and what every gathering method does at its vertices.
//
// Walk owns throughput, ray and the density of the last direction; `emitted`, `environment` and `direct_light` are the
// terms of thesis (9.26)-(9.29). All of them return what is to be multiplied by the throughput.
#pragma once
#include "sampling/sampler.h"
#include "transport/mis.h"
#include "transport/model.h"

namespace etendue::transport {

// Roulette never lets a path live with certainty above this, so that a lossless room ends too (digest: albedo 1).
inline constexpr float kMaxSurvival = 0.95f;

template <class M>
class Walk {
 public:
  using Color = typename M::Color;

  Walk(const scene::CompiledScene& scene, const Ray& ray, const Hit& first, PathSampler& random)
      : scene_(&scene), random_(&random), ray_(ray), hit_(first) {}

  const Color& throughput() const { return throughput_; }
  const Ray& ray() const { return ray_; }
  Vec3 wo() const { return -ray_.direction; }
  // Edges from the camera to the vertex that stands next.
  int length() const { return length_; }
  // Whether the last direction could not have been found by sampling a light.
  bool last_was_delta() const { return pdf_solid_angle_ == 0; }
  float last_pdf() const { return pdf_solid_angle_; }
  uint32_t rays() const { return rays_; }
  // The last ray left the scene.
  bool escaped() const { return !hit_; }

  // Goes to the next vertex; false if the ray leaves the scene.
  bool arrive(scene::SurfacePoint& point) {
    if (length_ > 0) {
      scene_->intersect(ray_, random_->seed() + static_cast<uint32_t>(length_), hit_);
      ++rays_;
    }
    ++length_;
    if (!hit_) return false;
    scene_->surface(ray_, hit_, point);
    if constexpr (M::kAbsorbing) absorb(point, hit_.t);
    random_->start_vertex(static_cast<uint32_t>(length_ - 1));
    return true;
  }

  // Chooses the next direction; false if the path is absorbed.
  bool scatter(const scene::SurfacePoint& point, const Bsdf<M>& bsdf) {
    LobeSample<Color> s;
    if (!bsdf.sample(wo(), random_->get(vertex_dimension::kBsdfLobe), random_->get_2d(vertex_dimension::kBsdfDirection),
                     Transport::radiance, s))
      return false;
    throughput_ *= s.weight;
    eta_scale_ *= sqr(s.eta);
    pdf_solid_angle_ = s.delta ? 0 : s.pdf_solid_angle;
    from_ = point.position;
    all_specular_ = all_specular_ && s.delta;
    point.spawn(s.wi, kInfinity, ray_);
    return true;
  }

  // Survives with the probability of the throughput's largest component (refraction's compression of radiance taken
  // out), and is weighted so that the expectation does not change.                                 thesis (9.10)
  bool survives_roulette(int from_vertex) {
    if (length_ < from_vertex) return true;
    const float survival = std::min(kMaxSurvival, max_component(throughput_) * eta_scale_);
    if (!(random_->get(vertex_dimension::kRoulette) < survival)) return false;
    throughput_ /= survival;
    return true;
  }

  // Where the last direction started: what a light's density refers to.
  const Vec3& from() const { return from_; }
  // The walk has met nothing but mirrors and clear glass: what it sees, the camera sees.
  bool all_specular() const { return all_specular_; }

 private:
  // Beer's law along the part of the ray that lies inside a solid: a back face met from within.
  void absorb(const scene::SurfacePoint& point, float distance) {
    const Material& m = point.material->description;
    if (point.front || !m.solid() || !std::isfinite(m.attenuation_distance)) return;
    const float x = distance / m.attenuation_distance;
    throughput_ *= Color(std::pow(m.attenuation_color.r, x), std::pow(m.attenuation_color.g, x),
                         std::pow(m.attenuation_color.b, x));
  }

  const scene::CompiledScene* scene_;
  PathSampler* random_;
  Ray ray_;
  Hit hit_;
  Color throughput_{1};
  Vec3 from_{0};
  float pdf_solid_angle_ = 0, eta_scale_ = 1;
  int length_ = 0;
  uint32_t rays_ = 0;
  bool all_specular_ = true;
};

// Radiance that the surface emits towards the walk. An unlit surface shows itself and lights nothing.
template <class M>
typename M::Color emitted(const scene::CompiledScene& scene, const scene::SurfacePoint& point, bool all_specular) {
  if (point.material->description.unlit && !all_specular) return typename M::Color(0);
  return scene.emitted(point);
}

// MIS weight of emission that the walk's own direction found.
template <class M>
float weight_of_hit(const Walk<M>& walk, const scene::CompiledScene& scene, const scene::SurfacePoint& point,
                    MisHeuristic heuristic) {
  if (walk.last_was_delta()) return 1;
  const uint32_t light = scene.light_at(point);
  if (light == scene::InstanceData::kNotALight) return 1;
  return mis_weight(heuristic, walk.last_pdf(), scene.lights().pdf_triangle(light, walk.from(), point.position));
}

template <class M>
float weight_of_escape(const Walk<M>& walk, const scene::CompiledScene& scene, MisHeuristic heuristic) {
  if (walk.last_was_delta()) return 1;
  return mis_weight(heuristic, walk.last_pdf(), scene.lights().pdf_environment(walk.ray().direction));
}

// Radiance from infinity along the walk's last direction.
template <class M>
typename M::Color environment(const scene::CompiledScene& scene, const Walk<M>& walk) {
  const EnvironmentMap& map = scene.lights().environment();
  if (map.black() || (walk.length() == 1 && !map.visible())) return typename M::Color(0);
  return map.radiance(walk.ray().direction);
}

// Whether shadow rays are traced: thesis 8.2 knows local illumination without them.
enum class Shadows { cast, ignored };

// Next event estimation: one point on one light, weighted against the direction that the walk samples itself.
template <class M>
typename M::Color direct_light(const scene::CompiledScene& scene, const scene::SurfacePoint& point, const Bsdf<M>& bsdf,
                               const Vec3& wo, PathSampler& random, MisHeuristic heuristic, bool combine,
                               Shadows shadows, uint32_t& rays) {
  using Color = typename M::Color;
  LightSample light;
  if (!bsdf.has_non_delta() || !scene.lights().sample(point.position, random.get(vertex_dimension::kLightChoice),
                                                      random.get_2d(vertex_dimension::kLightPoint), light))
    return Color(0);
  const Color f = bsdf.eval(wo, light.wi) * bsdf.cosine(light.wi);
  if (is_black(f)) return Color(0);
  const Color radiance = scene.radiance_of(light);
  if (is_black(radiance)) return Color(0);
  if (shadows == Shadows::cast) {
    // Ends short of the light by more than rounding can have moved either end.
    Ray ray;
    point.spawn(light.wi, light.distance * (1 - 1e-4f), ray);
    ++rays;
    if (scene.occluded(ray, random.seed() ^ 0x5bd1e995U)) return Color(0);
  }
  float weight = 1 / light.pdf;
  if (combine && !light.delta) weight *= mis_weight(heuristic, light.pdf, bsdf.pdf(wo, light.wi));
  return f * radiance * weight;
}

}  // namespace etendue::transport
