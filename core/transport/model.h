// How much model a scene needs.
//
// Some of it is decided at compile time: the hot loop is a template over a model type, which names the colour that is
// carried, the lobes that surfaces can have, and whether rays pass through absorbing media. The rest is data (a pinhole
// does not draw lens samples). `needs_of` looks at the compiled scene and says for each flag what it needs and why; a
// user can force a flag to the larger model, which must not change the image.
#pragma once
#include <array>
#include <memory>
#include <span>
#include <string>
#include <vector>

#include "material/bsdf.h"
#include "material/wide_lobes.h"
#include "scene/compiled.h"
#include "transport/path_expression.h"

namespace etendue::transport {

// Colour axis: Rgb. Spectral samples join here.
// Surfaces axis: DiffuseOnly, LobeMix for what most files do with, or WideLobes for everything. Media axis: vacuum, or
// absorption inside solids (Beer's law). Classes axis: every path counts, or those of an expression
// (transport/class_shares.h).
template <class ColorType, template <class> class LobeSet, bool absorbing, bool classes>
struct ModelType {
  using Color = ColorType;
  using Lobes = LobeSet<ColorType>;
  static constexpr bool kDiffuse = std::is_same_v<Lobes, DiffuseOnly<Color>>;
  static constexpr bool kAbsorbing = absorbing;
  static constexpr bool kClasses = classes;
};

template <bool classes>
using DiffuseVacuum = ModelType<Rgb, DiffuseOnly, false, classes>;
template <bool classes>
using StandardVacuum = ModelType<Rgb, LobeMix, false, classes>;
template <bool classes>
using StandardAbsorbing = ModelType<Rgb, LobeMix, true, classes>;
// Whose rarer scenes do not ask for a loop that saves the question whether a solid absorbs.
template <bool classes>
using AnyAbsorbing = ModelType<Rgb, WideLobes, true, classes>;

struct Decision {
  std::string flag;    // "colour", "media", "surfaces", ...
  std::string value;   // what is run
  std::string needed;  // what the scene needs
  std::string reason;
};

struct Model {
  bool diffuse = false;                         // every surface is Lambertian
  bool wide = false;                            // some surface needs lobes that few do
  bool absorbing = false;                       // some solid absorbs
  bool moving = false;                          // something moves while the shutter is open: paths have a time
  bool classes = false;                         // some paths do not count
  std::shared_ptr<const PathExpression> paths;  // those that do; where `classes`
  std::vector<Decision> decisions;

  // "RGB, vacuum, diffuse, ..." for a status bar.
  std::string summary() const;
};

// The flags that can be forced with `model.FLAG=on`.
std::vector<std::string> model_flags();

// `forced` lists the flags that are switched on whatever the scene needs. `paths` is the expression that paths have to
// match; empty if all count. It must be one that PathExpression::parse_paths takes.
Model model_for(const scene::CompiledScene& scene, std::span<const std::string> forced = {},
                std::string_view paths = {});

template <bool classes, class F>
decltype(auto) with_surfaces(const Model& model, F& f) {
  // Each loop costs minutes of building: where classes of paths are told apart, absorbing solids take the widest.
  if (model.wide || (classes && model.absorbing)) return f(AnyAbsorbing<classes>{});
  if constexpr (!classes)
    if (model.absorbing) return f(StandardAbsorbing<classes>{});
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
