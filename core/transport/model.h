// The transport model of a scene: the features that it needs.
//
// Some features are compile-time parameters of the rendering loops (model_types.h): the colour type, the lobes of
// surfaces, whether paths store the solids that contain them. The others are data: a pinhole camera draws no lens
// samples. `model_for` determines for each flag the value that the compiled scene needs, and the reason. A user can
// force a flag to the larger model, which must not change the image.
#pragma once
#include <memory>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "base/parameter.h"
#include "scene/forward.h"

namespace etendue::transport {

class PathExpression;

// How colour is represented.
enum class ColorMode : uint8_t {
  rgb,        // three components
  spectral,   // four wavelengths per path (spectrum/wavelengths.h)
  automatic,  // spectral if a visible material disperses light or an emitter has a spectrum, else RGB
};

struct Decision {
  std::string flag;    // "colour", "media", "surfaces", ...
  std::string value;   // the value in use
  std::string needed;  // the value that the scene needs
  std::string reason;
};

struct Model {
  bool spectral = false;                        // paths carry wavelengths; implies `diffuse`, or `media` and `classes`
  bool diffuse = false;                         // every surface is Lambertian, and there are no media
  bool wide = false;                            // some surface has rarely used lobes
  bool media = false;                           // paths store the solids that contain them
  bool scattering = false;                      // light is scattered or emitted between surfaces; implies `media`
  bool heterogeneous = false;                   // the density of a medium varies, or it emits; implies `scattering`
  bool moving = false;                          // something moves while the shutter is open: paths have times
  bool classes = false;                         // only some path classes count
  std::shared_ptr<const PathExpression> paths;  // the selected paths, if `classes`
  std::vector<Decision> decisions;

  // A summary for the status bar: "RGB, vacuum, diffuse, ...".
  std::string summary() const;
};

// The flags that can be forced with `model.FLAG=on`.
std::vector<std::string> model_flags();

// `forced` lists the flags that are on whatever the scene needs. `paths` is the expression that paths must match;
// empty: all paths. It must be one that PathExpression::parse_paths accepts.
Model model_for(const scene::CompiledScene& scene, std::span<const std::string> forced = {},
                std::string_view paths = {}, ColorMode color = ColorMode::automatic);

}  // namespace etendue::transport

template <>
struct etendue::Options<etendue::transport::ColorMode> {
  static constexpr std::array<etendue::Option, 3> kOptions{
      {{"rgb", "RGB"}, {"spectral", "Spectral"}, {"auto", "Automatic"}}};
};
