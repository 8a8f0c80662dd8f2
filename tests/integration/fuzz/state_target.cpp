// The state of a document as it is stored in images and checkpoints.
#include "integration/fuzz/json_mutation.h"
#include "render/document.h"
#include "render/scene_saving.h"

namespace etendue::fuzz {
namespace {

void read_state(Input input) {
  const std::string text(text_of(input));
  (void)render::display_from_state(text);
  uint32_t samples = 0;
  const auto document = render::document_from_state(text, "input", &samples);
  if (!document) return;
  const auto again = render::document_from_state(render::state_json(*document, samples), "input");
  require(static_cast<bool>(again), "the state of a document cannot be read");
  require(render::scene_to_save(*document).nodes.size() <= document->scene->nodes.size(),
          "a saved scene has more nodes");
}

// The document with edits of each kind.
render::Document with_edited_objects(render::Document document) {
  using scene::EditKind;
  const int nodes = static_cast<int>(document.scene->nodes.size());
  const scene::Transform moved{.translation = {0, 1, 2}};
  for (const scene::StructuralEdit& edit :
       {scene::StructuralEdit{EditKind::add_light, -1, "spot", "light"},
        {EditKind::add_shape, -1, "sphere", "ball"},
        {EditKind::add_camera, -1, {}, "view"},
        {EditKind::duplicate, 1, {}, "copy"},
        {EditKind::remove, nodes, {}, {}},
        {EditKind::rename, 0, {}, "first"},
        {.kind = EditKind::set_parent, .node = 2, .transform = moved, .parent = 3},
        {.kind = EditKind::add_material, .name = "paint"},
        {.kind = EditKind::rename_material, .name = "varnish", .material = 0},
        {.kind = EditKind::add_material, .name = "copy", .material = 0},
        {.kind = EditKind::remove_material, .material = static_cast<int>(document.scene->materials.size()) + 2},
        {.kind = EditKind::assign_material, .node = 1, .material = 0},
        {.kind = EditKind::set_keyframe, .node = 1, .transform = moved, .time = 0.5f},
        {.kind = EditKind::set_keyframe, .node = 1, .animation = 0, .time = 1.5f},
        {.kind = EditKind::remove_keyframe, .node = 1, .animation = 0, .time = 1.5f}}) {
    auto changed = render::with_structural_edit(document, edit);
    require(static_cast<bool>(changed), "an edit is impossible");
    document = std::move(*changed);
  }
  return document;
}

std::vector<Bytes> states() {
  std::vector<Bytes> seeds;
  for (const char* scene : {"cornell", "many-lights"}) {
    auto document = render::new_document(scene);
    require(static_cast<bool>(document), "a built-in scene cannot be opened");
    seeds.push_back(bytes_of(render::state_json(*document, 16)));
    seeds.push_back(bytes_of(render::state_json(with_edited_objects(*document), 16)));
    for (const auto& [name, value] : {std::pair{"film.width", "64"},
                                      {"film.filter", "tent"},
                                      {"render.integrator", "bdpt"},
                                      {"path.max-depth", "7"},
                                      {"display.curve", "neutral"},
                                      {"material.0.roughness", "0.25"},
                                      {"camera.exposure", "-1.5"},
                                      {"film.paths", "E(D|G)*L"},
                                      {"environment.preset", "sunset"},
                                      {"node.1.translation.x", "2"},
                                      {"render.seed", "3"},
                                      {"render.samples", "12"}}) {
      auto changed = render::with_text(*document, name, value);
      if (changed) document = std::move(changed);
    }
    seeds.push_back(bytes_of(render::state_json(*document, 16)));
  }
  return seeds;
}

}  // namespace

const Target kTarget{.run = read_state, .seeds = states, .mutate = change_json_text};

}  // namespace etendue::fuzz
