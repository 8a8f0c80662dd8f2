// The list of built-in scenes, the simplest first.
#include "scene/builtin/builtin.h"

#include <filesystem>

#include "base/provided_files.h"
#include "base/similar_name.h"
#include "scene/builtin/caustic_pool.h"
#include "scene/builtin/cloud.h"
#include "scene/builtin/cornell.h"
#include "scene/builtin/cornell_spheres.h"
#include "scene/builtin/door_ajar.h"
#include "scene/builtin/empty.h"
#include "scene/builtin/fire.h"
#include "scene/builtin/fog.h"
#include "scene/builtin/glass_caustic.h"
#include "scene/builtin/glossy_plates.h"
#include "scene/builtin/god_rays.h"
#include "scene/builtin/many_lights.h"
#include "scene/builtin/milk.h"
#include "scene/builtin/prism.h"
#include "scene/builtin/spot_indirect.h"
#include "scene/builtin/wax.h"
#include "scene/gltf/load_gltf.h"

namespace etendue::scene {

const std::vector<Builtin>& builtins() {
  static const std::vector<Builtin> all{
      kCornell, kCornellSpheres, kGlossyPlates, kGlassCaustic, kCausticPool, kSpotIndirect, kDoorAjar, kManyLights,
      kFog,     kMilk,           kGodRays,      kCloud,        kFire,        kPrism,        kWax,
  };
  return all;
}

namespace {

std::vector<std::string> names_of(const std::vector<Builtin>& scenes) {
  std::vector<std::string> names;
  for (const Builtin& b : scenes) names.emplace_back(b.name);
  return names;
}

}  // namespace

const Builtin* find_builtin(std::string_view name) {
  for (const Builtin& b : builtins())
    if (b.name == name) return &b;
  return name == kNewScene ? &kEmpty : nullptr;
}

std::string builtin_names() {
  std::string names;
  for (const Builtin& b : builtins()) names += (names.empty() ? "" : ", ") + std::string(b.name);
  return names;
}

Result<Scene> load(const std::string& file_or_name, const LoadOptions& options) {
  if (const Builtin* builtin = find_builtin(file_or_name)) return builtin->make();
  const std::filesystem::path file(file_or_name);
  std::error_code ignored;
  if (!file.has_extension() && !file.has_parent_path() && !provided_file(file) &&
      !std::filesystem::exists(file, ignored))
    return input_error("there is no built-in scene '" + file_or_name + "'; use a .gltf or .glb file, or one of " +
                       builtin_names() + did_you_mean(file_or_name, names_of(builtins())));
  return load_gltf(file_or_name, options);
}

}  // namespace etendue::scene
