// What the boundary of a solid reflects: Fresnel's term, or what glTF's extensions make of it.
#pragma once
#include "bsdf/fresnel/thin_film.h"

namespace etendue {

// How a direction meets a facet of the boundary.
struct Incidence {
  float f;          // the exact Fresnel term; 1 where everything is reflected
  float refracted;  // cosine on the other side
  float outer;      // cosine outside the solid
};

template <class Color>
struct ClearBoundary {
  Color reflectance(const Incidence& at) const { return Color(at.f); }
  float kept(const Incidence& at) const { return at.f; }
  float reflect_share(const Incidence& at) const { return at.f; }  // when sampling
};

// Strength and colour of the reflection, and a film. Total reflection remains total.           KHR_materials_specular
template <class Color>
struct TintedBoundary {
  float clear_f0 = 0.04f;  // of the index of refraction alone
  Color f0{0.04f};
  float f90 = 1;
  ThinFilm film;
  float strength = 0;  // of the film

  Color reflectance(const Incidence& at) const {
    if (at.f >= 1) return Color(1);
    // How far the exact term is on its way from normal to grazing incidence.
    const float weight = std::clamp((at.f - clear_f0) / (1 - clear_f0), 0.0f, 1.0f);
    const Color plain = f0 + (Color(f90) - f0) * weight;
    return strength > 0 ? plain * (1 - strength) + Color(film.reflectance(at.outer, f0)) * strength : plain;
  }
  float kept(const Incidence& at) const { return max_component(reflectance(at)); }
  float reflect_share(const Incidence& at) const {
    return at.f >= 1 ? 1.0f : std::clamp(average(reflectance(at)), 0.05f, 0.95f);
  }
};

}  // namespace etendue
