// Layers over lobes: what is left of the light that passes them twice, on its way in and on its way out.
//
//   f = f_below (1 - max(a(o), a(i))) + f_layer
//
// where a is what the layer itself keeps or sends back of the light of one direction: as KHR_materials_sheen has it,
// and for KHR_materials_clearcoat in place of the viewer's angle alone, so that f stays reciprocal.
#pragma once
#include <array>
#include <variant>

#include "base/vec.h"
#include "bsdf/fresnel/fresnel.h"
#include "bsdf/lobes/sheen.h"

namespace etendue {

struct DielectricCoating {
  Vec3 normal{0, 0, 1};
  float strength = 0;
  float f0 = 0, f90 = 0;  // what it keeps under a right angle and at grazing ones, by Schlick's weight

  float kept(const Vec3& w) const {
    return strength * (f0 + (f90 - f0) * schlick_weight(std::abs(glm::dot(normal, w))));
  }
};

class CoatingLayers {
 public:
  static constexpr bool kAny = true;
  using Layer = std::variant<DielectricCoating, SheenCoating>;

  // A layer over the first so many lobes.
  void add(int lobes, const Layer& layer) {
    const auto slot = static_cast<size_t>(count_++);
    layers_[slot] = layer, covered_[slot] = lobes;
  }

  float passed(int lobe, const Vec3& o, const Vec3& i) const {
    float part = 1;
    for (size_t k = 0; k < static_cast<size_t>(count_); ++k)
      if (lobe < covered_[k])
        part *= std::visit([&](const auto& l) { return 1 - std::max(l.kept(o), l.kept(i)); }, layers_[k]);
    return part;
  }

 private:
  static constexpr int kMost = 2;

  std::array<Layer, kMost> layers_;
  std::array<int, kMost> covered_{};
  int count_ = 0;
};

}  // namespace etendue
