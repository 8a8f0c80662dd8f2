// The whole set of lobes: what glTF's rarer extensions and the reflection models of the thesis need.
//
// Surfaces that do with less have a mix of their own (lobe_mix.h), and pay for none of this.
#pragma once
#include "material/coat.h"
#include "material/cover.h"
#include "material/diffuse_through.h"
#include "material/lobe_mix.h"
#include "material/models.h"
#include "material/sheen.h"
#include "material/thin_film.h"
#include "material/type_list.h"

namespace etendue {

// Layers of glTF's extensions.
template <class Color>
using LayerLobes =
    std::tuple<Coat<Color>, Sheen<Color>, DiffuseThrough<Color, FilmFresnel<Color>>, Layered<Color, FilmFresnel<Color>>,
               ThinSheet<Color, FilmFresnel<Color>>, Dielectric<Color, TintedBoundary<Color>>>;

template <class Color, class... Model>
auto every_lobe(TypeList<Model...>) ->
    typename UniqueVariant<StandardLobe<Color>, LayerLobes<Color>, typename Model::template Lobes<Color>...>::type;

template <class Color>
using AnyLobe = decltype(every_lobe<Color>(ReflectionModels{}));

template <class Color>
using WideLobes = Mix<Color, AnyLobe<Color>, 5, Covers>;

// Whether f changes when both directions turn about the normal by the same angle.
bool is_directed(const WideLobes<Rgb>& lobes);

}  // namespace etendue
