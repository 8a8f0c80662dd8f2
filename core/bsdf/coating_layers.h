// Layers over lobes: the light that a layer leaves to the lobes below it, on the way in and on the way out.
//
//   f = f_below (1 - max(a(wo), a(wi))) + f_layer
//
// a(w) is the directional albedo of the layer: the part of light from w that it reflects or absorbs.
// KHR_materials_sheen defines this formula. KHR_materials_clearcoat uses a(wo) alone, with the Fresnel term at the angle
// to the normal; the maximum of both keeps f reciprocal. With energy-conserving layering (lobes/layered_base.h), a(w)
// of a coat is the albedo of its microfacets.
#pragma once
#include <array>
#include <variant>

#include "base/vec.h"
#include "bsdf/fresnel/fresnel.h"
#include "bsdf/lobes/sheen.h"
#include "bsdf/microfacet/ggx_albedo.h"

namespace etendue {

// A dielectric layer with a normal of its own, given in the shading frame.
struct DielectricCoating {
  Vec3 normal{0, 0, 1};
  float strength = 0;
  float f0 = 0, f90 = 0;  // reflectance at normal and at grazing incidence [Schlick 1994]
  float alpha = 0;        // roughness of the microfacets; 0 takes the Fresnel term at the normal

  float albedo(const Vec3& w) const {
    const float cosine = std::abs(glm::dot(normal, w));
    if (alpha == 0) return strength * (f0 + (f90 - f0) * schlick_weight(cosine));
    const GgxAlbedo e = GgxAlbedoRow(alpha).at(cosine);
    return strength * std::min(1.0f, f0 * e.a + f90 * e.b);
  }
};

// At most two layers, each over the lobes that were added before it.
class CoatingLayers {
 public:
  static constexpr bool kAny = true;
  using Layer = std::variant<DielectricCoating, SheenCoating>;

  // Puts a layer over lobes 0 .. lobe_count - 1.
  void add(int lobe_count, const Layer& layer) {
    const auto slot = static_cast<size_t>(count_++);
    layers_[slot] = layer;
    covered_lobes_[slot] = lobe_count;
  }

  // The part of the light of this lobe that the layers above it let through, from 0 to 1.
  float transmittance(int lobe, const Vec3& wo, const Vec3& wi) const {
    return product(lobe, [&](const auto& l) { return 1 - std::max(l.albedo(wo), l.albedo(wi)); });
  }
  // The largest transmittance for a given wo, an estimate of its mean.
  float max_transmittance(int lobe, const Vec3& wo) const {
    return product(lobe, [&](const auto& l) { return 1 - l.albedo(wo); });
  }

 private:
  // The product of f over the layers above a lobe.
  template <class F>
  float product(int lobe, F&& f) const {
    float part = 1;
    for (size_t k = 0; k < static_cast<size_t>(count_); ++k)
      if (lobe < covered_lobes_[k]) part *= std::visit(f, layers_[k]);
    return part;
  }

  static constexpr int kMaxLayers = 2;

  std::array<Layer, kMaxLayers> layers_;
  std::array<int, kMaxLayers> covered_lobes_{};
  int count_ = 0;
};

}  // namespace etendue
