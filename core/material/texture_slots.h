// The textures of a material as a list: the names, encodings and members of all slots.
#pragma once
#include <span>

#include "material/material.h"

namespace etendue {

struct TextureSlot {
  const char* name;   // in parameters: "base-color" of "material.3.texture.base-color"
  const char* label;  // "Base colour"
  TextureUse Material::*use;
  Encoding encoding;
  const char* doc;               // what the channels mean
  bool applies_to_models = false;  // also to materials with a reflection model
};

// All slots, in the order of the members of Material.
std::span<const TextureSlot> texture_slots();

}  // namespace etendue
