// The transport models that loops are compiled for, and the choice between them at run time.
#pragma once
#include "bsdf/all_lobes.h"
#include "bsdf/lobe_set.h"
#include "transport/model.h"

namespace etendue::transport {

// Colour axis: Rgb. Spectral samples join here.
// Surfaces axis: DiffuseOnly, StandardLobes for what most files do with, or AllLobes for everything. Media axis:
// vacuum around every solid, or paths that store the solids containing them (wavefront/path_media.h). Classes axis:
// every path counts, or those of an expression (transport/class_shares.h).
template <class ColorType, template <class> class LobeSet, bool media, bool classes>
struct ModelType {
  using Color = ColorType;
  using Lobes = LobeSet<ColorType>;
  static constexpr bool kDiffuse = std::is_same_v<Lobes, DiffuseOnly<Color>>;
  static constexpr bool kMedia = media;
  static constexpr bool kClasses = classes;
};

template <bool classes>
using DiffuseVacuum = ModelType<Rgb, DiffuseOnly, false, classes>;
template <bool classes>
using StandardVacuum = ModelType<Rgb, StandardLobes, false, classes>;
template <bool classes>
using StandardMedia = ModelType<Rgb, StandardLobes, true, classes>;
// Used by all scenes with rare lobes, including those without media.
template <bool classes>
using AnyMedia = ModelType<Rgb, AllLobes, true, classes>;

template <bool classes, class F>
decltype(auto) with_surfaces(const Model& model, F& f) {
  // Each loop costs minutes of building: where classes of paths are told apart, media take the widest.
  if (model.wide || (classes && model.media)) return f(AnyMedia<classes>{});
  if constexpr (!classes)
    if (model.media) return f(StandardMedia<classes>{});
  if (model.diffuse) return f(DiffuseVacuum<classes>{});
  return f(StandardVacuum<classes>{});
}

// Calls `f` with a value of the model type that the flags ask for.
template <class F>
decltype(auto) with_model(const Model& model, F&& f) {
  if (model.classes) return with_surfaces<true>(model, f);
  return with_surfaces<false>(model, f);
}

}  // namespace etendue::transport
