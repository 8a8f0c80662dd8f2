// The reflectance of a solid's boundary: the Fresnel term, or its modification by glTF extensions.
#pragma once
#include "bsdf/fresnel/thin_film.h"

namespace etendue {

// The incidence of a direction on a microfacet of the boundary.
struct Incidence {
  float f;          // exact Fresnel reflectance; 1 for total reflection
  float refracted;  // cosine of the refracted direction
  float outer;      // cosine of the direction outside the solid
};

template <class Color>
struct ClearBoundary {
  Color reflectance(const Incidence& at) const { return Color(at.f); }
  float kept(const Incidence& at) const { return at.f; }
  float reflect_share(const Incidence& at) const { return at.f; }  // probability of sampling reflection
};

// Strength and colour of the reflection, and a thin film. Total reflection stays total.      [KHR_materials_specular]
template <class Color>
struct TintedBoundary {
  float clear_f0 = 0.04f;  // reflectance at normal incidence that follows from the index of refraction
  Color f0{0.04f};
  float f90 = 1;
  ThinFilm film;
  float strength = 0;  // of the thin film

  Color reflectance(const Incidence& at) const {
    if (at.f >= 1) return Color(1);
    // Where the exact term lies between normal (0) and grazing incidence (1).
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
