// Scripts of the viewer: all steps are read and checked, none is run.
#include "integration/fuzz/json_mutation.h"
#include "integration/fuzz/memory_file.h"
#include "viewer/script/script.h"

namespace etendue::fuzz {
namespace {

void read_script(Input input) {
  const MemoryFile file(input);
  (void)viewer::Script::read(file.path());
}

std::vector<Bytes> scripts() {
  return {bytes_of(R"([
  {"do": "set", "name": "material.5.metallic", "value": 1}, {"do": "wait", "spp": 16},
  {"do": "click", "item": "compare.pin"}, {"do": "click", "item": "view.help", "double": true},
  {"do": "drag", "from": [10, 20], "to": [30.5, 40], "button": "left"},
  {"do": "drag", "item": "timeline", "by": [5, 0]}, {"do": "scroll", "at": [1, 2], "by": 2},
  {"do": "key", "key": "ctrl+z"}, {"do": "key", "key": "w", "down": true}, {"do": "pick", "at": [7, 8]}])"),
          bytes_of(R"([
  {"do": "open", "file": "cornell"}, {"do": "wait", "seconds": 1}, {"do": "wait", "for": "comparison"},
  {"do": "wait", "compared": 4}, {"do": "screenshot", "file": "a.png"}, {"do": "image", "file": "a.exr"},
  {"do": "state", "file": "s.json"}, {"do": "random", "actions": 5, "seed": 2, "files": ["cornell"], "log": "l"}])")};
}

}  // namespace

const Target kTarget{.run = read_script, .seeds = scripts, .mutate = change_json_text};

}  // namespace etendue::fuzz
