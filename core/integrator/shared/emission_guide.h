// Directions of photons towards specular objects, for caustics.                 [Jensen 2001, sec. 5.3: projection maps]
//
// A caustic begins with a photon that meets a mirror, glass or a smooth layer. Objects with such surfaces are bounded by
// spheres. A part s of the photons leaves a light in a direction uniform over the cones of these spheres, seen from the
// start of the photon. With p the density of the light itself, n the number of cones that contain a direction and W the sum
// of their solid angles, a photon has the density
//
//   m = (1 - s) p + s n / W
//
// and the weight cos / m, whichever way its direction was chosen. The expected flux in every direction stays the same.
// Where the cones together are wider than kWidest, the direction is left to the light. So are those of lights at infinity,
// and all directions while objects move, or if there are more than kMostSpheres such objects.
#pragma once
#include <array>
#include <vector>

#include "integrator/integrator.h"
#include "light/sampling/emission.h"
#include "light/sampling/sphere_cone.h"
#include "scene/compiled_scene.h"

namespace etendue::integrator {

class EmissionGuide {
 public:
  struct Sphere {
    Vec3 centre{0};
    float radius = 0;
  };

  EmissionGuide() = default;
  EmissionGuide(std::vector<Sphere> spheres, float share) : share_(share), spheres_(std::move(spheres)) {}
  // `share` is the part s, below 1.
  EmissionGuide(const RenderContext& context, float share) : share_(share) {
    if (!(share > 0) || context.model->moving) return;
    const scene::CompiledScene& scene = *context.scene;
    for (const scene::InstanceData& instance : scene.instances()) {
      if (!scene.materials()[instance.material].has_delta_lobes) continue;
      spheres_.push_back(sphere_around(instance));
      if (spheres_.size() <= kMostSpheres) continue;
      spheres_.clear();
      return;
    }
  }

  bool empty() const { return spheres_.empty(); }

  // Changes the direction of a photon that starts at e.position, with a normal if it starts on a surface, whose emission is
  // diffuse. e.direction is in world space. `choice` and `u` are uniform in [0, 1); `choice` is independent of the
  // direction.
  void redirect(const Vec3* normal, float choice, Vec2 u, Emission& e) const {
    Cones cones;
    find_cones(e.position, cones);
    if (cones.count == 0 || !(e.weight > 0)) return;
    // Of a direction that leaves the light on the side that has been chosen.
    const auto of_light = [&](const Vec3& d) {
      return normal ? std::max(glm::dot(*normal, d), 0.0f) / kPi : e.density.second;
    };
    const float side = e.density.second / of_light(e.direction);
    if (choice < share_) e.direction = cones.sample(choice / share_, u);
    const float density = side * ((1 - share_) * of_light(e.direction) + share_ * cones.pdf(e.direction));
    const float cosine = normal ? glm::dot(*normal, e.direction) : 1;
    e.weight = cosine > 0 ? cosine / (e.density.first * density) : 0;
    e.density.second = density;
  }

 private:
  static constexpr size_t kMostSpheres = 32;
  static constexpr float kWidest = kPi;  // steradians

  struct Cone {
    Vec3 axis;
    float one_minus_cos, end;  // `end`: the sum of the solid angles up to this cone
  };
  struct Cones {
    std::array<Cone, kMostSpheres> list;
    size_t count = 0;

    float solid_angle() const { return list[count - 1].end; }
    Vec3 sample(float choice, Vec2 u) const {
      size_t k = 0;
      while (k + 1 < count && choice * solid_angle() >= list[k].end) ++k;
      const float below = u.x * list[k].one_minus_cos, sine = safe_sqrt(below * (2 - below)), phi = 2 * kPi * u.y;
      return Frame(list[k].axis).to_world({sine * std::cos(phi), sine * std::sin(phi), 1 - below});
    }
    float pdf(const Vec3& direction) const {
      int inside = 0;
      for (size_t k = 0; k < count; ++k)
        inside += 1 - glm::dot(direction, list[k].axis) <= list[k].one_minus_cos ? 1 : 0;
      return static_cast<float>(inside) / solid_angle();
    }
  };

  static Sphere sphere_around(const scene::InstanceData& instance) {
    Bounds bounds;
    const auto place = [&](const Vec3& p) { return instance.identity ? p : Vec3(instance.to_world * Vec4(p, 1)); };
    for (const Vec3& p : instance.mesh->positions) bounds.extend(place(p));
    Sphere sphere{bounds.center(), 0};
    for (const Vec3& p : instance.mesh->positions)
      sphere.radius = std::max(sphere.radius, glm::distance(sphere.centre, place(p)));
    sphere.radius *= 1 + 1e-4f;
    return sphere;
  }

  void find_cones(const Vec3& from, Cones& cones) const {
    float sum = 0;
    for (const Sphere& sphere : spheres_) {
      const Vec3 to = sphere.centre - from;
      const float distance2 = glm::dot(to, to), radius2 = sqr(sphere.radius);
      if (distance2 <= radius2 * 1.0001f) return cones.count = 0, void();
      const SphereCone cone(radius2, distance2);
      sum += 2 * kPi * cone.one_minus_cos;
      cones.list[cones.count++] = {to / std::sqrt(distance2), cone.one_minus_cos, sum};
    }
    if (sum > kWidest || !(sum > 0)) cones.count = 0;
  }

  float share_ = 0;
  std::vector<Sphere> spheres_;
};

}  // namespace etendue::integrator
