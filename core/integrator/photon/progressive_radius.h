// Radii of progressive density estimation: the size of a pixel in the scene, and the reduction from sample to sample.
#pragma once
#include "camera/camera_ray.h"

namespace etendue::integrator {

// The width of a pixel in the centre of the image: `angle` per metre of path length plus `width`.
struct PixelFootprint {
  float angle = 0, width = 0;

  PixelFootprint(const CameraRays& camera, int image_width, int height) {
    const Vec2 center(0.5f * static_cast<float>(image_width), 0.5f * static_cast<float>(height)), lens(0.5f);
    const Ray a = camera.ray(center, lens), b = camera.ray(center + Vec2(1, 0), lens);
    angle = glm::length(glm::cross(a.direction, b.direction));
    width = glm::distance(a.origin, b.origin);
  }
  // In metres, at this distance.
  float over(float length) const { return width + angle * length; }
};

// The region of sample number `index` (from 0) of a half-buffer, relative to the first: the area of a disc or the volume
// of a ball, which shrinks by (i + alpha) / (i + 1).                                          [Knaus and Zwicker 2011]
inline double region_ratio(double alpha, uint32_t index) {
  double ratio = 1;
  for (uint32_t i = 1; i <= index; ++i) ratio *= (i + alpha) / (i + 1.0);
  return ratio;
}

}  // namespace etendue::integrator
