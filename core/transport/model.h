// How much model a scene needs.
//
// Some of it is decided at compile time: the hot loop is a template over a model type, which names the colour that is
// carried, the lobes that surfaces can have, and whether rays pass through absorbing media. The rest is data (a pinhole
// does not draw lens samples). `needs_of` looks at the compiled scene and says for each flag what it needs and why; a
// user can force a flag to the larger model, which must not change the image.
#pragma once
#include <array>
#include <map>
#include <span>
#include <string>
#include <vector>

#include "material/bsdf.h"
#include "scene/compiled.h"

namespace etendue::transport {

// Colour axis: Rgb. Spectral samples join here.
// Surfaces axis: DiffuseOnly or every lobe. Media axis: vacuum, or absorption inside solids (Beer's law).
template <class ColorType, template <class> class LobeSet, bool absorbing>
struct ModelType {
  using Color = ColorType;
  using Lobes = LobeSet<ColorType>;
  static constexpr bool kDiffuse = std::is_same_v<Lobes, DiffuseOnly<Color>>;
  static constexpr bool kAbsorbing = absorbing;
};

using DiffuseVacuum = ModelType<Rgb, DiffuseOnly, false>;
using AnyVacuum = ModelType<Rgb, LobeMix, false>;
using AnyAbsorbing = ModelType<Rgb, LobeMix, true>;

struct Decision {
  std::string flag;    // "colour", "media", "surfaces", ...
  std::string value;   // what is run
  std::string needed;  // what the scene needs
  std::string reason;
};

struct Model {
  bool diffuse = false;    // every surface is Lambertian
  bool absorbing = false;  // some solid absorbs
  std::vector<Decision> decisions;

  // "RGB, vacuum, diffuse, ..." for a status bar.
  std::string summary() const;
};

// The flags that can be forced with `model.FLAG=on`.
std::vector<std::string> model_flags();

// `forced` lists the flags that are switched on whatever the scene needs.
Model model_for(const scene::CompiledScene& scene, std::span<const std::string> forced = {});

// Calls `f` with a value of the model type that the flags ask for.
template <class F>
decltype(auto) with_model(const Model& model, F&& f) {
  if (model.absorbing) return f(AnyAbsorbing{});
  if (model.diffuse) return f(DiffuseVacuum{});
  return f(AnyVacuum{});
}

}  // namespace etendue::transport
