// Thin-film interference at the wavelengths of a path: the model of thin_film.h, with the exact sum over all reflections
// inside the film in place of its integral over the colour matching functions.
#pragma once
#include "bsdf/fresnel/thin_film.h"
#include "spectrum/wavelengths.h"

namespace etendue {

struct SpectralThinFilm : ThinFilm {
  const Wavelengths* wavelengths = nullptr;

  // As ThinFilm::reflectance, by wavelength.
  SampledSpectrum reflectance(float cosine, const SampledSpectrum& base_f0) const;
};

}  // namespace etendue
