// Quad light: a rectangle that emits.                                                           [Lang, sec. 4.3]
//
// Sampled as two triangles: by solid angle where they are large as seen from the receiver, else uniformly by area.
#pragma once
#include <memory>

#include "geometry/mesh.h"
#include "light/types/area_light_parameters.h"

namespace etendue {

struct QuadLight : AreaLightParameters {
  static constexpr LightTypeDescription kDescription{
      .name = "quad",
      .label = "Quad light",
      .summary = "A rectangle that emits; black and visible to rays",
      .light_class = LightClass::area,
      .quantity = &kLuminance,
      .formula = "L(theta) = L0 cos^k theta; power 2 pi A L0 / (k + 2) per side, A = width height",
      .sampling = "two triangles, by solid angle where they are near, else by area",
      .source = "[Lang, sec. 4.3]",
  };

  Number<float> width = size_parameter("width", "Width", 1, "Along the node's x axis");
  Number<float> height = size_parameter("height", "Height", 1, "Along the node's y axis");
  auto parameters() { return std::tuple_cat(parameters_with_size(width, height), std::tie(two_sided, point_samples)); }

  float area() const { return width * height; }

  std::shared_ptr<const Mesh> shape() const {
    const float x = 0.5f * width;
    const float y = 0.5f * height;
    auto mesh = std::make_shared<Mesh>();
    mesh->positions.reserve(5);  // one more than there are, for Embree
    mesh->positions = {{-x, -y, 0}, {-x, y, 0}, {x, y, 0}, {x, -y, 0}};
    mesh->triangles = {{0, 1, 2}, {0, 2, 3}};
    return mesh;
  }

  LightPlace point_sample(const SpreadPoint& p) const {
    LightPlace place;
    place.position =
        Vec3((p.fraction - 0.5f) * width, (p.turn + 0.5f / static_cast<float>(p.count) - 0.5f) * height, 0);
    return place;
  }
};

}  // namespace etendue
