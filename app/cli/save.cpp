// etendue save: a scene, with settings changed, as a glTF file.
#include <CLI/CLI.hpp>
#include <cstdio>
#include <memory>

#include "command.h"
#include "render/scene_saving.h"
#include "scene/builtin/builtin.h"
#include "scene/gltf/save_gltf.h"
#include "scene/variants.h"
#include "settings.h"

namespace etendue::cli {
namespace {

struct Options {
  std::string scene, camera, environment, output, variant;
  std::vector<std::string> settings;
};

Result<void> choose_variant(scene::Scene& scene, const std::string& name) {
  const auto choices = scene::variant_labels(scene);
  const auto chosen = std::find(choices.begin(), choices.end(), name);
  if (chosen != choices.end())
    return scene::keep_only_variant(scene, static_cast<int>(chosen - choices.begin()) - 1), Result<void>();
  std::string list;
  for (const auto& choice : choices) list += (list.empty() ? "" : ", ") + choice;
  return usage_error("--variant: there is no variant '" + name + "'; there are " + list);
}

Result<void> save(const Options& o) {
  auto document = render::new_document(o.scene, o.camera);
  if (!document) return document.error();
  if (auto r = set_environment(*document, o.environment); !r) return r;
  if (auto r = set_all(*document, o.settings); !r) return r;
  scene::Scene scene = render::scene_to_save(*document);
  if (!o.variant.empty())
    if (auto r = choose_variant(scene, o.variant); !r) return r;
  std::vector<std::string> warnings;
  auto saved = scene::save_gltf(scene, o.output, &warnings);
  for (const auto& warning : warnings) std::fprintf(stderr, "etendue: warning: %s\n", warning.c_str());
  return saved;
}

}  // namespace

Command add_save(CLI::App& app) {
  auto o = std::make_shared<Options>();
  app.add_option("scene", o->scene, "A .gltf or .glb file, or one of " + scene::builtin_names())->required();
  app.add_option("-o,--output", o->output, "The .glb, or the .gltf beside which a .bin and pictures will lie")
      ->required();
  app.add_option("--camera", o->camera, "The camera that --set camera.* changes: its name or number");
  app.add_option("--env", o->environment, "An equirectangular .hdr or .exr that lights the scene");
  app.add_option("--set", o->settings, "NAME=VALUE for a setting of the scene; may be given again");
  app.add_option("--variant", o->variant, "Keep the materials of this variant alone");
  return [o] {
    const auto saved = save(*o);
    return saved ? 0 : fail(saved.error());
  };
}

}  // namespace etendue::cli
