// The size of a pixel in the scene.
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

}  // namespace etendue::integrator
