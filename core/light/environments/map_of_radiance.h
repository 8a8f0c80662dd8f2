// Equirectangular maps of a function of the direction.
#pragma once
#include <cmath>
#include <memory>

#include "base/vec.h"
#include "image/image.h"
#include "spectrum/rgb.h"

namespace etendue {

// radiance(direction) at the texel centres of a map (light/environment.h), in cd/m^2.
template <class Radiance>
std::shared_ptr<const image::Image> environment_map_of(const Radiance& radiance) {
  constexpr int kWidth = 512, kHeight = 256;
  auto map = std::make_shared<image::Image>();
  map->width = kWidth;
  map->height = kHeight;
  map->channels = 3;
  map->type = image::PixelType::float32;
  map->floats.reserve(size_t{3} * kWidth * kHeight);
  for (int y = 0; y < kHeight; ++y)
    for (int x = 0; x < kWidth; ++x) {
      const float phi = ((static_cast<float>(x) + 0.5f) / kWidth - 0.5f) * 2 * kPi;
      const float theta = (static_cast<float>(y) + 0.5f) / kHeight * kPi;
      const Vec3 direction(std::cos(phi) * std::sin(theta), std::cos(theta), std::sin(phi) * std::sin(theta));
      const Rgb value = radiance(direction);
      map->floats.insert(map->floats.end(), {value.r, value.g, value.b});
    }
  return map;
}

}  // namespace etendue
