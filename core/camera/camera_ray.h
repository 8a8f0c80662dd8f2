// From a point of the picture to a ray.                              thesis 8.3.3-8.3.4, (8.55)-(8.62); radiance
//                                                                    convention; errata E10, E11
//
// The estimate of a pixel is a mean of radiance: the cosine of the thesis's flux convention is left out.
// The virtual picture stands at the focus distance and rays start on the lens, so that what lies there is sharp.
#pragma once
#include <memory>

#include "base/warp.h"
#include "camera/camera.h"
#include "camera/camera_motion.h"
#include "geometry/ray.h"

namespace etendue {

class CameraRays {
 public:
  // A camera without motion stays where it is.
  CameraRays(const Camera& camera, int width, int height, std::shared_ptr<const CameraMotion> motion = nullptr);

  // Whether rays depend on a point of the lens.
  bool has_lens() const { return camera_.lens_radius > 0; }

  // `raster` is in pixels, (0, 0) the upper left corner of the picture; `lens` in the unit square; `time` from 0 at the
  // shutter's opening to 1 at its closing.
  Ray ray(Vec2 raster, Vec2 lens, float time = 0) const;
  // The same for many; the arrays have room for whole registers. `times` is only read if the camera moves.
  struct Pairs {
    const float *x, *y;
  };
  void rays(const Pairs& raster, const Pairs& lens, const float* times, size_t count, Ray* rays) const;

 private:
  Ray ray_of(Vec2 raster, Vec2 lens) const;
  void rays_in_place(const Pairs& raster, const Pairs& lens, size_t count, Ray* rays) const;
  void place(float time, Ray& ray) const;

  Camera camera_;                               // one that moves stands at the origin until its rays are placed
  std::shared_ptr<const CameraMotion> motion_;  // null: it stands still
  Vec2 to_unit_;  // pixel to [-1, 1] times half the size of the picture at distance one (or in metres, orthographic)
  Vec2 half_size_;
};

}  // namespace etendue
