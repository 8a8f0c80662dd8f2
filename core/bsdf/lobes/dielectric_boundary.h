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
  void set_media(float, float) {}
  Color reflectance(const Incidence& at) const { return Color(at.f); }
  float kept(const Incidence& at) const { return at.f; }
  // Probability of sampling reflection, in proportion to the energy; `transmitted` is the mean tint of transmitted light.
  float reflect_share(const Incidence& at, float transmitted) const {
    return at.f > 0 ? at.f / (at.f + (1 - at.f) * transmitted) : 0;
  }
};

// Strength and colour of the reflection, and a thin film. Total reflection stays total.      [KHR_materials_specular]
template <class Color>
struct TintedBoundary {
  float clear_f0 = 0.04f;  // reflectance at normal incidence that follows from the index of refraction
  Color tint{1};           // multiplies clear_f0
  Color f0{0.04f};         // tinted reflectance at normal incidence, including f90
  float f90 = 1;           // strength of the reflection
  ThinFilm film;
  float strength = 0;  // of the thin film

  // For a boundary between two media. Tint and strength scale the reflectance that follows from the relative index, as
  // the extension specifies for a boundary to air; a relative index of 1 reflects nothing. Interference in the film
  // depends on the ratios of indices and on the wavelength in the outer medium.
  void set_media(float relative_eta, float outside_eta) {
    clear_f0 = f0_from_ior(relative_eta);
    for (int k = 0; k < 3; ++k) f0[k] = std::clamp(tint[k] * clear_f0, 0.0f, 1.0f) * f90;
    film.ior /= outside_eta;
    film.thickness *= outside_eta;
  }

  Color reflectance(const Incidence& at) const {
    if (at.f >= 1) return Color(1);
    // Where the exact term lies between normal (0) and grazing incidence (1).
    const float weight = std::clamp((at.f - clear_f0) / (1 - clear_f0), 0.0f, 1.0f);
    const Color plain = f0 + (Color(f90) - f0) * weight;
    return strength > 0 ? plain * (1 - strength) + Color(film.reflectance(at.outer, f0)) * strength : plain;
  }
  float kept(const Incidence& at) const { return max_component(reflectance(at)); }
  float reflect_share(const Incidence& at, float transmitted) const {
    if (at.f >= 1) return 1;
    const Color reflected = reflectance(at);
    const float share = average(reflected);
    return share > 0 ? std::clamp(share / (share + (1 - max_component(reflected)) * transmitted), 0.05f, 0.95f) : 0;
  }
};

}  // namespace etendue
