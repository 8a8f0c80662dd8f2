// The types behind AllLobes (all_lobes.h): every lobe of glTF's extensions and of the registered BSDF models.
//
// Only files that put lobes together or implement AllLobes include this header.
#pragma once
#include "bsdf/all_lobes.h"
#include "bsdf/coating_layers.h"
#include "bsdf/fresnel/thin_film.h"
#include "bsdf/lobe_set.h"
#include "bsdf/lobes/clearcoat.h"
#include "bsdf/lobes/diffuse_transmission.h"
#include "bsdf/lobes/sheen.h"
#include "bsdf/model_registry.h"
#include "bsdf/type_list.h"

namespace etendue {

// Layers of glTF's extensions.
template <class Color>
using LayerLobes = std::tuple<Clearcoat<Color>, Sheen<Color>, DiffuseTransmission<Color, FilmFresnel<Color>>,
                              MetallicRoughness<Color, FilmFresnel<Color>>, ThinTransmission<Color, FilmFresnel<Color>>,
                              Dielectric<Color, TintedBoundary<Color>>>;

template <class Color, class... Model>
auto every_lobe(TypeList<Model...>) ->
    typename UniqueVariant<StandardLobe<Color>, LayerLobes<Color>, typename Model::template Lobes<Color>...>::type;

template <class Color>
using AnyLobe = decltype(every_lobe<Color>(BsdfModels{}));

template <class Color>
using AnyLobeSet = LobeSet<Color, AnyLobe<Color>, 5, CoatingLayers>;

// The set inside an AllLobes.
AnyLobeSet<Rgb>& lobe_set(AllLobes<Rgb>& lobes);
const AnyLobeSet<Rgb>& lobe_set(const AllLobes<Rgb>& lobes);

}  // namespace etendue
