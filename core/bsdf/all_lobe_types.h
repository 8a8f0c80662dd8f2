// The lobe types inside AllLobes (all_lobes.h): those of the glTF extensions and of the registered BSDF models.
//
// Included only by files that add lobes to an AllLobes or implement it: they are the ones that an edited BSDF model
// recompiles.
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

// The lobes of the glTF extensions that StandardLobe lacks.
template <class Color>
using GltfExtensionLobes =
    std::tuple<Clearcoat<Color>, Sheen<Color>, DiffuseTransmission<Color, FilmFresnel<Color>>,
               MetallicRoughness<Color, FilmFresnel<Color>>, ThinTransmission<Color, FilmFresnel<Color>>,
               Dielectric<Color, TintedBoundary<Color>>>;

template <class Color, class... Model>
auto every_lobe(TypeList<Model...>) -> typename UniqueVariant<StandardLobe<Color>, GltfExtensionLobes<Color>,
                                                              typename Model::template Lobes<Color>...>::type;

// A variant of all of them, each type once.
template <class Color>
using AnyLobe = decltype(every_lobe<Color>(BsdfModels{}));

// Five lobes are enough: base, diffuse transmission, specular transmission, sheen, clear coat. BSDF models use at most
// four.
template <class Color>
using AnyLobeSet = LobeSet<Color, AnyLobe<Color>, 5, CoatingLayers>;

// The set inside an AllLobes.
AnyLobeSet<Rgb>& lobe_set(AllLobes<Rgb>& lobes);
const AnyLobeSet<Rgb>& lobe_set(const AllLobes<Rgb>& lobes);

}  // namespace etendue
