// glTF files: values, members and array lengths of the JSON are mutated. One of eight inputs is also rendered.
#include "integration/fuzz/gltf_container.h"
#include "integration/fuzz/gltf_run.h"
#include "integration/fuzz/gltf_seeds.h"

namespace etendue::fuzz {
namespace {

bool change_json(Bytes& input, Mutator& mutator) {
  auto container = split_gltf(input);
  if (!container) return false;
  mutator.damage_json(container->root);
  input = join_gltf(*container);
  return true;
}

}  // namespace

const Target kTarget{.run = open_and_render, .seeds = gltf_seeds, .mutate = change_json, .input_of = self_contained};

}  // namespace etendue::fuzz
