// Light from infinity: what a user edits.
#pragma once
#include <memory>
#include <string>

#include "image/image.h"
#include "spectrum/rgb.h"

namespace etendue {

// Radiance from infinity, cd/m^2: an equirectangular map times `tint`, or `tint` alone.
//
// Texture coordinates (u, v) of the map: u = 0.5 is the +x direction, v = 0 is +y. With phi = (u - 0.5) 2 pi the
// direction is (cos phi sin(pi v), cos(pi v), sin phi sin(pi v)), rotated by `rotation` about +y.
struct Environment {
  std::shared_ptr<const image::Image> map;  // float RGB; may be null
  std::string file;
  Rgb tint{0};
  float rotation = 0;   // radians
  bool visible = true;  // to camera rays

  bool black() const { return is_black(tint); }
  friend bool operator==(const Environment&, const Environment&) = default;
};

}  // namespace etendue
