// Lights: what a user edits.                        KHR_lights_punctual; thesis 4.3, (4.366), errata E30, E31
#pragma once
#include <memory>
#include <string>

#include "base/vec.h"
#include "image/image.h"
#include "spectrum/rgb.h"

namespace etendue {

// Quad, disk and sphere are surfaces that shine: black, met by rays, exactly of their shape.
// Ambient light is no physical one: the same radiance from everywhere at every place, and nothing casts a shadow in it.
// It stands in for indirect light.
enum class LightType : uint8_t { point, spot, directional, quad, disk, sphere, ambient };

// How a spot falls off from its inner cone (t = 1) to its outer one (t = 0), t being linear in the cosine; the last one
// knows no inner cone, but a power of the cosine to the axis.
enum class SpotProfile : uint8_t { squared, smoothstep, quartic, cosine };

// What `intensity` says of a surface.
enum class SurfaceQuantity : uint8_t { radiance, power };

// Placed by a node: it shines along the node's -z, from its origin; a quad's width goes along x. The node's scale does
// not count.
struct Light {
  std::string name;
  LightType type = LightType::point;
  Rgb color{1};
  // Point, spot: W/sr; directional: W/m^2 (irradiance on a surface that faces it); surfaces: W/(m^2 sr), or W;
  // ambient: W/(m^2 sr).
  float intensity = 1;
  float inner_cone = 0, outer_cone = kPi / 4;  // spot: half angles in radians, falling off between them
  SpotProfile profile = SpotProfile::squared;
  float exponent = 1;           // of the cosine profile
  float range = kInfinity;      // metres; glTF's recommended window, infinite where the file gives none
  float width = 1, height = 1;  // quad, metres
  float radius = 0.5f;          // disk, sphere, metres
  bool two_sided = false;       // quad, disk
  SurfaceQuantity quantity = SurfaceQuantity::radiance;
  float cosine_exponent = 0;  // a surface's radiance is `intensity` times this power of the cosine to its normal
  int points = 0;             // a surface stands for so many lamps without extent; 0 is the surface itself

  bool is_surface() const { return type == LightType::quad || type == LightType::disk || type == LightType::sphere; }
  // One side of it, square metres.
  float area() const {
    return type == LightType::quad ? width * height : (type == LightType::sphere ? 4 : 1) * kPi * radius * radius;
  }
  int sides() const { return two_sided && type != LightType::sphere ? 2 : 1; }
  // Of a surface, along its normal.
  Rgb radiance() const {
    const float per_area = 2 * kPi / (cosine_exponent + 2) * static_cast<float>(sides());
    const float all = quantity == SurfaceQuantity::power ? per_area * area() : 1;
    return all > 0 ? color * (intensity / all) : Rgb(0);
  }

  friend bool operator==(const Light&, const Light&) = default;
};

// Radiance from infinity: an equirectangular map times `tint`, or `tint` alone. u = 0.5 looks along +x, v = 0 is +y:
// phi = (u - 0.5) 2 pi, d = (cos phi sin(pi v), cos(pi v), sin phi sin(pi v)), then turned by `rotation` about +y.
struct Environment {
  std::shared_ptr<const image::Image> map;  // float RGB
  std::string file;
  Rgb tint{0};
  float rotation = 0;   // radians
  bool visible = true;  // seen by camera rays

  bool black() const { return is_black(tint); }
  friend bool operator==(const Environment&, const Environment&) = default;
};

}  // namespace etendue
