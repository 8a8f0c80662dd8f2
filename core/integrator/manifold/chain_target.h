// The ends of chains: a point of an area light or a point light, or the direction of a light at infinity.
#pragma once
#include <algorithm>
#include <optional>

#include "integrator/manifold/specular_chain.h"

namespace etendue::integrator::manifold {

// A sampled light.
struct ChainTarget {
  Emission emission;
  scene::SurfacePoint point;  // of an area light

  // A point of an area light.
  static ChainTarget at(const scene::SurfacePoint& point) {
    ChainTarget target;
    target.emission.kind = LightKind::triangle;
    target.point = point;
    return target;
  }

  bool is_area() const { return emission.kind == LightKind::triangle; }
  bool is_infinite() const { return emission.density.infinite; }
  Vec3 direction_from(const Vec3& from) const {
    return is_infinite() ? -emission.direction : normalize_or(position() - from, Vec3(0, 0, 1));
  }
  // Nothing of a light at infinity.
  std::optional<Vec3> finite_position() const { return is_infinite() ? std::nullopt : std::optional(position()); }
  Vec3 position() const { return is_area() ? point.position : emission.position; }
};

// Samples lights other than the environment, whose chains BSDF sampling finds.
class ChainTargets {
 public:
  explicit ChainTargets(const scene::CompiledScene& scene) : scene_(scene) {
    const LightTable& lights = scene.lights();
    if (lights.empty()) return;
    share_ = lights.environment().black() ? 1 : 1 - lights.emission_probability(lights.environment_number());
  }

  // Without lights, or if the environment has nearly all of their power, so that sampling the others would take long.
  bool empty() const { return !(share_ > kMinShare); }

  std::optional<ChainTarget> sample(ChainRandom& random, float time) const {
    // Choices of the environment are repeated. kMinShare bounds the probability that all of them are.
    for (int attempt = 0; attempt < 256; ++attempt) {
      const float choice = random.next();
      const Vec2 point = random.next_2d();
      ChainTarget target;
      scene_.lights().sample_emission(EmissionRandom(choice, point, random.next_2d(), time), target.emission);
      if (target.emission.kind == LightKind::environment) continue;
      if (!(target.emission.density.first > 0)) return {};
      if (target.is_area()) {
        Hit hit;
        Vec3 side;
        scene_.locate(target.emission, hit, side);
        scene_.surfaces({&side, 1}, {&hit, 1}, &target.point, &time);
      }
      return target;
    }
    return {};
  }

  // What arrives from a target along a chain that ends in `direction`. The determinant is that of the derivatives of the
  // end of the chain.
  struct Arriving {
    // Radiance. Of a light without extent, the integral over solid angle at the start of the chain, divided by the
    // probability of the light.
    Rgb radiance{0};
    float pdf = 0;  // of the direction at the start of the chain, per solid angle; 0 of a light without extent
  };
  Arriving arriving(const ChainTarget& target, const Vec3& direction, float distance, float determinant,
                    float time) const {
    const uint32_t number = target.emission.light;
    if (!target.is_area())
      return {scene_.lights().emitted_by_placed(number, -direction, distance, time) *
              (share_ / (target.emission.density.first * determinant))};
    scene::SurfacePoint point = target.point;
    point.front = glm::dot(point.ng, direction) < 0;
    const float pdf = pdf_of_area(number, point.ng, direction, determinant, time);
    if (!(pdf > 0)) return {};
    return {scene_.emitted(point, -direction), pdf};
  }

  // The density with which `sample` finds a point of an area light that ends a chain, per solid angle of the direction
  // at its start; 0 if it does not.
  float pdf(const scene::SurfacePoint& point, const Vec3& direction, float determinant, float time) const {
    const uint32_t light = scene_.light_at(point);
    if (light == scene::InstanceData::kNotALight) return 0;
    return pdf_of_area(light, point.ng, direction, determinant, time);
  }

 private:
  float pdf_of_area(uint32_t light, const Vec3& ng, const Vec3& direction, float determinant, float time) const {
    const float cosine = -glm::dot(ng, direction);
    if (cosine == 0) return 0;
    return scene_.lights().emission_density(light, cosine, time).first / share_ * determinant / std::abs(cosine);
  }

  static constexpr float kMinShare = 0.1f;

  const scene::CompiledScene& scene_;
  float share_ = 0;
};

}  // namespace etendue::integrator::manifold
