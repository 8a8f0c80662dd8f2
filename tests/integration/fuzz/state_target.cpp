// The state of a document as it is stored in images and checkpoints.
#include "integration/fuzz/json_mutation.h"
#include "render/document.h"

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
}

std::vector<Bytes> states() {
  std::vector<Bytes> seeds;
  for (const char* scene : {"cornell", "many-lights"}) {
    auto document = render::new_document(scene);
    require(static_cast<bool>(document), "a built-in scene cannot be opened");
    seeds.push_back(bytes_of(render::state_json(*document, 16)));
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
