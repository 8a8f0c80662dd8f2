// Lights that are no surfaces: what a user edits.                        KHR_lights_punctual; thesis 4.3
#pragma once
#include <memory>
#include <string>

#include "base/vec.h"
#include "image/image.h"
#include "spectrum/rgb.h"

namespace etendue {

enum class LightType : uint8_t { point, spot, directional };

// Placed by a node: it shines along the node's -z, from its origin.
struct Light {
  std::string name;
  LightType type = LightType::point;
  Rgb color{1};
  float intensity = 1;  // point, spot: W/sr; directional: W/m^2 (irradiance on a surface that faces it)
  float inner_cone = 0, outer_cone = kPi / 4;  // spot: half angles in radians, falling off between them
  float range = kInfinity;                     // metres; glTF's recommended window, infinite where the file gives none

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
