// Projector light: a point light that throws an image.
//
//   E = I T(direction) cos(theta) / r^2,    Phi = I (integral of T over the pyramid of the image)
//
// T is the linear image, at the point where the direction meets the image plane. The image is upright as seen from the
// light, with x to the right and y up. Rays that leave the light are uniform over the cone around the pyramid.
#pragma once
#include <memory>

#include "light/projected_image.h"
#include "light/types/punctual_emitter.h"

namespace etendue {

struct ProjectorLight {
  static constexpr LightTypeDescription kDescription{
      .name = "projector",
      .label = "Projector light",
      .summary = "A point light that throws an image, like a slide projector or a window pattern",
      .light_class = LightClass::delta_position,
      .quantity = &kLuminousIntensity,
      .formula = "E = I T cos / r^2, with the value T of the linear image in the direction to the receiver",
      .sampling = "its position; rays that leave it are uniform over the cone around the image",
      .source = "[Lang, sec. 4.3]",
  };

  Number<float> intensity = intensity_parameter(kLuminousIntensity, "Luminous intensity of white parts of the image");
  Number<float> field{"field",
                      "Field of view",
                      0.9f,
                      {0.01f, 3},
                      "Angle that the width of the image spans; the height follows from the shape of the image",
                      "rad"};
  Text image{"image",
             "Image",
             kProjectedImages.front().name,
             "Path of an image file, or one of the images window, bars and checkerboard",
             accepts_projected_image,
             {kProjectedImages.begin(), kProjectedImages.end()}};
  Number<float> range = range_parameter();
  auto parameters() { return std::tie(intensity, field, image, range); }

  struct Emitter : PunctualEmitter {
    std::shared_ptr<const ProjectedImage> image = projected_image(kProjectedImages.front().name);
    Vec2 half_size{1, 1};  // of the image plane at distance one
    Rgb integral{0};       // of the image over the solid angle

    // Of the image in a direction of the light's frame, which emits along -z.
    Rgb value(const Vec3& local) const {
      if (!(local.z < 0)) return Rgb(0);
      const Vec2 at = Vec2(local.x, local.y) / (-local.z * half_size);
      if (std::abs(at.x) > 1 || std::abs(at.y) > 1) return Rgb(0);
      return image->value({0.5f * (1 + at.x), 0.5f * (1 - at.y)});
    }
    float cos_outer() const { return 1 / std::sqrt(1 + glm::dot(half_size, half_size)); }

    Rgb flux() const { return radiant_intensity() * integral; }
    float power(float) const { return luminance(flux()); }

    LightBounds bounds(const LightPlace& place) const {
      LightBounds b = PunctualEmitter::bounds(place);
      b.axis = place.direction;
      b.normals = 0;
      b.emission = std::acos(cos_outer());
      b.intensity = luminance(radiant_intensity() * image->largest());
      return b;
    }

    bool sample(const LightPlace& place, const Vec3& from, Vec2, LightSample& s) const {
      if (!sample_point(place, from, s)) return false;
      s.radiance *= value(place.frame().to_local(-s.wi));
      return !is_black(s.radiance);
    }

    Rgb emitted(const LightPlace& place, const Vec3& direction, float distance) const {
      return radiant_intensity() * value(place.frame().to_local(direction)) * range_window(distance);
    }
    EmissionDensity emission_density(const SceneSphere&) const {
      return {1, 1 / (2 * kPi * (1 - cos_outer())), true, false};
    }
    void sample_emission(const LightPlace& place, const SceneSphere& scene, const EmissionRandom& random,
                         Emission& e) const {
      e.position = place.position;
      resample_emission(place, scene, random.direction, e);
    }
    void resample_emission(const LightPlace& place, const SceneSphere&, Vec2 u, Emission& e) const {
      Vec3 local = square_to_cone(u, cos_outer());
      local.z = -local.z;
      e.direction = place.frame().to_world(local);
      e.radiance = radiant_intensity() * value(local);
    }

    // The integral of the image over the solid angle, by the midpoint rule. The solid angle of a part of the image
    // plane at distance one is its area over the third power of its distance.
    void integrate() {
      constexpr int kSteps = 128;
      Rgb sum(0);
      for (int y = 0; y < kSteps; ++y)
        for (int x = 0; x < kSteps; ++x) {
          const Vec2 uv = (Vec2(x, y) + 0.5f) / static_cast<float>(kSteps);
          const Vec2 at = half_size * (2.0f * uv - 1.0f);
          const float distance2 = 1 + glm::dot(at, at);
          sum += image->value(uv) / (distance2 * std::sqrt(distance2));
        }
      integral = sum * (4 * half_size.x * half_size.y / sqr(static_cast<float>(kSteps)));
    }
  };
  Emitter emitter(const Rgb& color) const {
    Emitter e{{color, intensity, range_or_infinity(range)}, projected_image(image)};
    e.half_size.x = std::tan(0.5f * field);
    e.half_size.y = e.half_size.x / e.image->aspect();
    e.integrate();
    return e;
  }
};

}  // namespace etendue
