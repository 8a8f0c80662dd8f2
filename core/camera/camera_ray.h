// From a point of the picture to a ray.                              thesis 8.3.3-8.3.4, (8.55)-(8.62); radiance
//                                                                    convention; errata E10, E11
//
// The estimate of a pixel is a mean of radiance: the cosine of the thesis's flux convention is left out. The importance
// that light paths are weighted by is that of the same convention: for radiance L from direction w, the mean over a
// pixel is the integral of L times d(raster)/d(w), averaged over the lens.
// The virtual picture stands at the focus distance and rays start on the lens, so that what lies there is sharp.
#pragma once
#include <memory>
#include <optional>

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

  // How densely the rays of a picture lie that go in this direction, so far from the camera: pixels to a square metre
  // across them. And the cosine of the direction to the axis.
  float pixels_per_area(const Vec3& direction, float distance, float time = 0) const;
  float cosine(const Vec3& direction, float time = 0) const { return -glm::dot(Vec3(to_world(time)[2]), direction); }

  // How a point of the scene is seen through a point of the lens: the inverse of `ray`.
  struct View {
    Vec2 raster;       // it may lie outside of the picture
    Vec3 wi;           // from the point to the camera, unit
    float distance;    // up to where the camera begins to see: the near plane, or the lens
    float importance;  // pixels to a square metre across `wi`, at the point
  };
  // Nothing if it lies behind the camera or beyond its clipping planes.
  std::optional<View> view(const Vec3& point, Vec2 lens, float time = 0) const;

  // The same of a direction, where the scene is infinitely far away: the ray to it starts on the lens, and importance
  // is in pixels per solid angle. Nothing if the camera looks elsewhere, or sees one direction alone.
  struct DirectionView {
    Vec2 raster;
    Ray ray;
    float importance;
  };
  bool sees_environment() const { return !parallel() && !std::isfinite(camera_.far_clip); }
  std::optional<DirectionView> view_direction(const Vec3& direction, Vec2 lens, float time = 0) const;

  // Whether light can come to the lens by chance. Not through a point, not where each point of the picture takes one
  // direction alone, and not where the camera begins to see beyond its lens only.
  bool can_be_hit() const { return has_lens() && !parallel() && camera_.near_clip == 0; }
  // A ray that falls onto the lens from the front before it is `length` long, and what it sees; nothing if it misses,
  // or if it cannot hit.
  struct LensHit {
    Vec2 raster;
    float distance;    // of the lens along the ray
    float importance;  // pixels per m^2 sr: what the ray's watts are multiplied by
    float cosine;      // to the axis
    float density;     // pixels per solid angle at the lens: that of `ray`'s directions
  };
  std::optional<LensHit> intersect_lens(const Ray& ray, float length, float time = 0) const;
  float lens_area() const { return kPi * sqr(camera_.lens_radius); }

  // `ray` for many; the arrays have room for whole registers. `times` is only read if the camera moves.
  struct Pairs {
    const float *x, *y;
  };
  void rays(const Pairs& raster, const Pairs& lens, const float* times, size_t count, Ray* rays) const;

 private:
  Ray ray_of(Vec2 raster, Vec2 lens) const;
  void rays_in_place(const Pairs& raster, const Pairs& lens, size_t count, Ray* rays) const;
  void place(float time, Ray& ray) const;
  Mat4 to_world(float time) const { return motion_ ? motion_->at(time) : camera_.to_world; }
  bool parallel() const { return camera_.projection == Projection::orthographic; }
  Vec2 point_of_lens(Vec2 u) const { return has_lens() ? square_to_disk(u) * camera_.lens_radius : Vec2(0); }
  Vec2 raster_of(const Vec3& direction, Vec2 on_lens) const;
  float pixels_per_solid_angle(float cosine) const;
  float pixels_across(float cosine) const;

  Camera camera_;                               // one that moves stands at the origin until its rays are placed
  std::shared_ptr<const CameraMotion> motion_;  // null: it stands still
  Vec2 to_unit_;  // pixel to [-1, 1] times half the size of the picture at distance one (or in metres, orthographic)
  Vec2 half_size_;
};

}  // namespace etendue
