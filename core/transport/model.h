// How much model a scene needs.
//
// Some of it is decided at compile time (model_types.h): the colour that is carried, the lobes that surfaces can have,
// whether paths store the solids that contain them. The rest is data: a pinhole does not draw lens samples. `model_for`
// looks at the compiled scene and states for each flag what it needs and why. A user can force a flag to the larger
// model, which must not change the image.
#pragma once
#include <memory>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "scene/forward.h"

namespace etendue::transport {

class PathExpression;

struct Decision {
  std::string flag;    // "colour", "media", "surfaces", ...
  std::string value;   // what is run
  std::string needed;  // what the scene needs
  std::string reason;
};

struct Model {
  bool diffuse = false;                         // every surface is Lambertian
  bool wide = false;                            // some surface needs lobes that few do
  bool media = false;                           // paths store the solids that contain them
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

}  // namespace etendue::transport
