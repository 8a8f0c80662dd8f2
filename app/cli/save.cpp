// etendue save: writes a scene, with changed parameters, as a glTF file; or a built-in environment as an image.
#include <algorithm>
#include <cstdio>
#include <memory>

#include "command.h"
#include "image/image.h"
#include "light/environments/builtin_environment.h"
#include "render/scene_saving.h"
#include "scene/gltf/save_gltf.h"
#include "scene/variants.h"
#include "scene_options.h"

namespace etendue::cli {
namespace {

struct SaveArguments {
  SceneArguments scene;
  std::string output, variant;
};

Result<void> keep_only_variant(scene::Scene& scene, const std::string& name) {
  const auto choices = scene::variant_labels(scene);
  const auto chosen = std::ranges::find(choices, name);
  if (chosen != choices.end()) {
    scene::keep_only_variant(scene, static_cast<int>(chosen - choices.begin()) - 1);
    return {};
  }
  std::string list;
  for (const auto& choice : choices) list += (list.empty() ? "" : ", ") + choice;
  return usage_error("--variant: there is no variant '" + name + "'; give one of " + list);
}

Result<void> save_environment(const BuiltinEnvironment& builtin, const std::string& file) {
  if (!file.ends_with(".hdr"))
    return usage_error("--output: '" + file + "' cannot hold an environment; give the name of an .hdr file");
  const Environment environment = make_environment(builtin);
  if (!environment.map) return usage_error(std::string(builtin.name) + ": is a constant radiance and needs no file");
  return image::write_hdr(file, environment.map->width, environment.map->height, environment.map->floats);
}

Result<void> save(const SaveArguments& a) {
  if (const auto* environment = find_builtin_environment(a.scene.scene))
    return save_environment(*environment, a.output);
  const auto document = open_document(a.scene);
  if (!document) return document.error();
  scene::Scene scene = render::scene_to_save(*document);
  if (!a.variant.empty())
    if (auto r = keep_only_variant(scene, a.variant); !r) return r;
  std::vector<std::string> warnings;
  auto saved = scene::save_gltf(scene, a.output, &warnings);
  for (const auto& warning : warnings) std::fprintf(stderr, "etendue: %s: %s\n", a.output.c_str(), warning.c_str());
  return saved;
}

}  // namespace

Command save_command() {
  const auto a = std::make_shared<SaveArguments>();
  return {
      .name = "save",
      .summary = "Write a scene as glTF, with changed parameters, or a built-in environment as .hdr",
      .options =
          {scene_option(a->scene.scene),
           {.names = "-o,--output",
            .target = &a->output,
            .doc =
                "A .glb file, or a .gltf file with a .bin file and images beside it; for an environment an .hdr file",
            .required = true},
           camera_option(a->scene.camera),
           environment_option(a->scene.environment),
           set_option(a->scene.settings),
           {.names = "--variant", .target = &a->variant, .doc = "Keep only this material variant"}},
      .run = [a] {
        const auto saved = save(*a);
        return saved ? 0 : fail(saved.error());
      }};
}

}  // namespace etendue::cli
