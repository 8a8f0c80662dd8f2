// Structural mutation of inputs that are JSON text.
#pragma once
#include "integration/fuzz/target.h"

namespace etendue::fuzz {

// Changes a value, a member or the length of an array; returns false if the input is not JSON.
inline bool change_json_text(Bytes& input, Mutator& mutator) {
  using nlohmann::json;
  json root = json::parse(text_of(input), nullptr, false);
  if (!root.is_structured()) return false;
  mutator.damage_json(root);
  input = bytes_of(root.dump(-1, ' ', false, json::error_handler_t::replace));
  return true;
}

}  // namespace etendue::fuzz
