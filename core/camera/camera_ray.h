// From a point of the picture to a ray.                              thesis 8.3.3, (8.55)-(8.60); radiance convention
//
// The estimate of a pixel is a mean of radiance: the cosine of the thesis's flux convention is left out.
// The virtual picture stands at the focus distance and rays start on the lens, so that what lies there is sharp.
#pragma once
#include "base/warp.h"
#include "camera/camera.h"
#include "geometry/ray.h"

namespace etendue {

class CameraRays {
 public:
  CameraRays(const Camera& camera, int width, int height);

  // Whether rays depend on a point of the lens.
  bool has_lens() const { return camera_.lens_radius > 0; }

  // `raster` is in pixels, (0, 0) the upper left corner of the picture; `lens` in the unit square.
  Ray ray(Vec2 raster, Vec2 lens) const;
  // The same for many; the arrays have room for whole registers.
  struct Pairs {
    const float *x, *y;
  };
  void rays(const Pairs& raster, const Pairs& lens, size_t count, Ray* rays) const;

 private:
  Ray ray_of(Vec2 raster, Vec2 lens) const;

  Camera camera_;
  Vec2 to_unit_;  // pixel to [-1, 1] times half the size of the picture at distance one (or in metres, orthographic)
  Vec2 half_size_;
};

}  // namespace etendue
