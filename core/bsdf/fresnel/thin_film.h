// A thin film on a surface: what it reflects, by interference.                              KHR_materials_iridescence
//
// Belcour and Barla, "A Practical Extension to Microfacet Theory for the Modeling of Varying Iridescence", 2017, in the
// form of the extension's appendix: Schlick's term at both boundaries, no polarisation, phases of 0 or pi, and the
// spectrum integrated as sums of Gaussians. The result is brought into [0, 1]: colours outside the gamut would be
// negative or gain energy.
#pragma once
#include "bsdf/fresnel/schlick_fresnel.h"
#include "spectrum/rgb.h"

namespace etendue {

struct ThinFilm {
  float ior = 1.3f;
  float thickness = 400;  // nanometres

  // Of light from air at this cosine, over a base of this reflectance at normal incidence.
  Rgb reflectance(float cosine, const Rgb& base_f0) const;
};

// A dielectric, a metal or a mix of both under a film of some strength; without strength it is Schlick's term.
template <class Color>
struct FilmFresnel {
  Color dielectric_f0{0.04f};
  float dielectric_f90 = 1;
  Color metal_f0{1};
  float dielectric = 1, metal = 0;  // shares of the mix
  ThinFilm film;
  float strength = 0;

  Color of_dielectric(float cosine) const { return filmed(cosine, dielectric_f0, Color(dielectric_f90)); }
  Color fresnel(float cosine) const {
    Color f(0);
    if (dielectric > 0) f += of_dielectric(cosine) * dielectric;
    if (metal > 0) f += filmed(cosine, metal_f0, Color(1)) * metal;
    return f;
  }
  float kept(float cosine) const { return max_component(of_dielectric(cosine)); }
  bool reflects() const { return metal > 0 || (dielectric > 0 && (dielectric_f90 > 0 || strength > 0)); }

 private:
  Color filmed(float cosine, const Color& f0, const Color& f90) const {
    const Color plain = f0 + (f90 - f0) * schlick_weight(cosine);
    return strength > 0 ? plain * (1 - strength) + Color(film.reflectance(cosine, f0)) * strength : plain;
  }
};

}  // namespace etendue
