// The transport models for which rendering loops are compiled, and the run-time choice between them.
#pragma once
#include "bsdf/all_lobes.h"
#include "bsdf/lobe_set.h"
#include "bsdf/spectral_lobes.h"
#include "transport/model.h"

namespace etendue::transport {

// The media between surfaces.
enum class MediaType : uint8_t {
  vacuum,      // around every solid
  solids,      // paths store the solids that contain them, whose media absorb (wavefront/path_media.h)
  scattering,  // these media and the atmosphere also scatter, at vertices in volumes
};

// Colour: Rgb, or SampledSpectrum for spectral rendering. Surfaces: DiffuseOnly, StandardLobes for most glTF
// files, or AllLobes. Classes: all paths, or those of a path expression (path_expression/class_shares.h).
template <class ColorType, template <class> class LobeSet, MediaType media, bool classes>
struct ModelType {
  using Color = ColorType;
  using Lobes = LobeSet<ColorType>;
  static constexpr bool kSpectral = std::is_same_v<Color, SampledSpectrum>;
  static constexpr bool kDiffuse = std::is_same_v<Lobes, DiffuseOnly<Color>>;
  static constexpr bool kMedia = media != MediaType::vacuum;
  static constexpr bool kScattering = media == MediaType::scattering;
  static constexpr bool kClasses = classes;
  // The model of scattering at surfaces.
  using Surfaces = ModelType<ColorType, LobeSet, kScattering ? MediaType::solids : media, classes>;
};

template <bool classes>
using DiffuseVacuum = ModelType<Rgb, DiffuseOnly, MediaType::vacuum, classes>;
template <bool classes>
using StandardVacuum = ModelType<Rgb, StandardLobes, MediaType::vacuum, classes>;
template <bool classes>
using StandardMedia = ModelType<Rgb, StandardLobes, MediaType::solids, classes>;
// Used by all scenes with rare lobes, including those without media.
template <bool classes>
using AnyMedia = ModelType<Rgb, AllLobes, MediaType::solids, classes>;
// Used by all scenes with scattering media, by integrators that support them.
template <bool classes>
using ScatteringMedia = ModelType<Rgb, AllLobes, MediaType::scattering, classes>;

// Used by spectral rendering of diffuse scenes without media, by integrators that support it.
using SpectralDiffuse = ModelType<SampledSpectrum, DiffuseOnly, MediaType::vacuum, false>;
// Used by all other spectral rendering. Without an expression, the path classes are all paths.
using Spectral = ModelType<SampledSpectrum, AllLobes, MediaType::scattering, true>;

template <bool classes, class F>
decltype(auto) with_surfaces(const Model& model, F& f) {
  // Each loop takes minutes to compile: with path classes, scenes with media use the largest model.
  if (model.wide || (classes && model.media)) return f(AnyMedia<classes>{});
  if constexpr (!classes)
    if (model.media) return f(StandardMedia<classes>{});
  if (model.diffuse) return f(DiffuseVacuum<classes>{});
  return f(StandardVacuum<classes>{});
}

// Calls `f` with a value of the model's type.
template <class F>
decltype(auto) with_model(const Model& model, F&& f) {
  if (model.classes) return with_surfaces<true>(model, f);
  return with_surfaces<false>(model, f);
}

// The same for integrators that support scattering media.
template <class F>
decltype(auto) with_scattering_model(const Model& model, F&& f) {
  if (!model.scattering) return with_model(model, f);
  if (model.classes) return f(ScatteringMedia<true>{});
  return f(ScatteringMedia<false>{});
}

// The same for integrators that also support spectral rendering.
template <class F>
decltype(auto) with_spectral_model(const Model& model, F&& f) {
  if (model.spectral && model.diffuse) return f(SpectralDiffuse{});
  if (model.spectral) return f(Spectral{});
  return with_scattering_model(model, f);
}

}  // namespace etendue::transport
