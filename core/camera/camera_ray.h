// Camera rays, and the view of points, directions and rays by the camera
//                                           [Lang, sec. 8.4.3 and 9.2, eq. 8.55-8.62, corrected, eq. 9.33-9.35]
//
// Thin lens without refraction: the image plane is placed in the plane in focus, and rays start on the lens, so that
// points at the focus distance are sharp.
//
// Convention: the value of a pixel is the mean of the incident radiance L over the pixel and the lens, without the
// cosine of the flux convention in [Lang]. The importance of light paths follows the same convention: the mean over a
// pixel is the integral of L(w) d(raster)/d(w) over directions w, averaged over the lens.
//
// Raster coordinates are in pixels, with (0, 0) in the upper left corner of the image. Points of the lens are given as
// points of the unit square. Times are in [0, 1], from the opening to the closing of the shutter.
#pragma once
#include <memory>
#include <optional>

#include "base/warp.h"
#include "camera/camera.h"
#include "camera/camera_motion.h"
#include "camera/projection.h"
#include "geometry/ray.h"

namespace etendue {

class CameraRays {
 public:
  // For an image of this resolution. `motion` is null for a static camera.
  CameraRays(const Camera& camera, int width, int height, std::shared_ptr<const CameraMotion> motion = nullptr);

  // Whether rays depend on the lens point.
  bool has_lens() const { return camera_.lens_radius > 0; }
  float lens_area() const { return kPi * sqr(camera_.lens_radius); }

  Ray ray(Vec2 raster, Vec2 lens, float time = 0) const;

  // `count` rays at once. The arrays hold padded_lanes(count) elements. `times` is read only if the camera moves.
  struct Pairs {
    const float *x, *y;
  };
  void rays(const Pairs& raster, const Pairs& lens, const float* times, size_t count, Ray* rays) const;

  // The density of camera rays in this direction at this distance, in pixels per square metre perpendicular to them.
  float pixels_per_area(const Vec3& direction, float distance, float time = 0) const;
  // The cosine of the angle between a direction and the optical axis.
  float cosine(const Vec3& direction, float time = 0) const { return -glm::dot(Vec3(to_world(time)[2]), direction); }

  // The view of a point; nothing if it is behind the camera or outside of the clipping planes.
  using View = CameraView;
  std::optional<View> view(const Vec3& point, Vec2 lens, float time = 0) const;

  // The view of a direction, for points at infinite distance: the ray in this direction, which starts on the lens, and
  // the importance in pixels per solid angle. Nothing if the direction points backwards or sees_environment() is false.
  struct DirectionView {
    Vec2 raster;
    Ray ray;
    float importance;
  };
  bool sees_environment() const { return !parallel_ && !std::isfinite(camera_.far_clip); }
  std::optional<DirectionView> view_direction(const Vec3& direction, Vec2 lens, float time = 0) const;

  // The intersection of the first `length` metres of a ray with the front of the lens. Nothing if it misses the lens or
  // if can_be_hit() is false.
  struct LensHit {
    Vec2 raster;
    float distance;    // along the ray
    float importance;  // pixels per m^2 sr, by which the power of the ray is multiplied
    float cosine;      // of the angle to the optical axis
    float density;     // of camera rays at the lens, in pixels per solid angle
  };
  // Whether light can hit the lens at random. It cannot hit a pinhole, a camera with parallel rays (which sees a single
  // direction per lens point), or a camera that sees only what is behind a near plane.
  bool can_be_hit() const { return has_lens() && !parallel_ && camera_.near_clip == 0; }
  std::optional<LensHit> intersect_lens(const Ray& ray, float length, float time = 0) const;

 private:
  template <class P>
  Ray static_ray(Vec2 raster, Vec2 lens) const;
  void static_rays(const Pairs& raster, const Pairs& lens, size_t count, Ray* rays) const;
  void move(float time, Ray& ray) const;
  Mat4 to_world(float time) const { return motion_ ? motion_->at(time) : camera_.to_world; }
  Vec2 lens_point(Vec2 u) const { return has_lens() ? square_to_disk(u) * camera_.lens_radius : Vec2(0); }

  Camera camera_;  // a moving camera has the identity as to_world; `move` transforms its rays
  std::shared_ptr<const CameraMotion> motion_;
  ImagePlane plane_;
  bool parallel_;
};

}  // namespace etendue
