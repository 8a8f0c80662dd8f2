// Thin-film interference: the reflectance of a dielectric film on a dielectric or metallic base.
//                                                                                          [KHR_materials_iridescence]
// The model of [Belcour and Barla 2017] in the form of the extension's appendix: Schlick's approximation at both
// boundaries, no polarisation, phase shifts of 0 or pi, and the spectrum integrated as a sum of Gaussians. The result
// is clamped to [0, 1], because colours outside the sRGB gamut would be negative or gain energy.
#pragma once
#include "bsdf/fresnel/schlick_fresnel.h"
#include "spectrum/rgb.h"

namespace etendue {

struct ThinFilm {
  float ior = 1.3f;
  float thickness = 400;  // nanometres

  // `cosine` is that of the direction in air, `base_f0` the reflectance of the base in air at normal incidence.
  Rgb reflectance(float cosine, const Rgb& base_f0) const;
};

// The Fresnel term of a mixture of a dielectric and a metal under a film. The term is interpolated between Schlick's
// approximation (strength 0) and the film (strength 1). `Film` is ThinFilm or SpectralThinFilm (spectral_thin_film.h).
template <class Color, class Film = ThinFilm>
struct FilmFresnel {
  Color dielectric_f0{0.04f};
  float dielectric_f90 = 1;
  Color metal_f0{1};
  float dielectric = 1, metal = 0;  // weights of the mixture
  Film film;
  float strength = 0;

  Color dielectric_reflectance(float cosine) const { return filmed(cosine, dielectric_f0, Color(dielectric_f90)); }
  Color fresnel(float cosine) const {
    Color f(0);
    if (dielectric > 0) f += dielectric_reflectance(cosine) * dielectric;
    if (metal > 0) f += filmed(cosine, metal_f0, Color(1)) * metal;
    return f;
  }
  // Reflectance of the dielectric, the maximum over the colour components.
  float layer_reflectance(float cosine) const { return max_component(dielectric_reflectance(cosine)); }

  // The same terms averaged over microfacets, by the term at the mean cosine: the directional albedo of the layer.
  Color albedo(const GgxAlbedo& e) const { return fresnel(e.mean_cosine()) * e.total(); }
  float layer_albedo(const GgxAlbedo& e) const { return layer_reflectance(e.mean_cosine()) * e.total(); }
  // The cosine-weighted mean of layer_albedo over the hemisphere, by eight directions of equal projected solid angle.
  float mean_layer_albedo(float alpha) const {
    constexpr int kDirections = 8;
    const GgxAlbedoRow row(alpha);
    float sum = 0;
    for (int k = 0; k < kDirections; ++k)
      sum += layer_albedo(row.at(std::sqrt((static_cast<float>(k) + 0.5f) / kDirections)));
    return sum / kDirections;
  }

  bool reflects() const { return metal > 0 || (dielectric > 0 && (dielectric_f90 > 0 || strength > 0)); }

 private:
  Color filmed(float cosine, const Color& f0, const Color& f90) const {
    const Color without_film = f0 + (f90 - f0) * schlick_weight(cosine);
    return strength > 0 ? without_film * (1 - strength) + Color(film.reflectance(cosine, f0)) * strength : without_film;
  }
};

}  // namespace etendue
