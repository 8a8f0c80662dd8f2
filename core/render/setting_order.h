// The order in which the settings of a document are applied: some decide which others there are, or change others.
#pragma once
#include <array>
#include <string_view>

namespace etendue::render {

enum class SettingKind {
  model,      // a reflection model, which has parameters of its own, or another meaning of the textures
  selection,  // sets other parameters or decides which there are: a preset, a texture
  value,
  replacing  // removed by edits of other parameters: a spectrum by the RGB coefficient, a glass by the index
};
inline constexpr std::array kSettingKinds{SettingKind::model, SettingKind::selection, SettingKind::value,
                                          SettingKind::replacing};

// The name is qualified ("material.3.roughness"), or of a parameter of a material ("roughness").
SettingKind kind_of_setting(std::string_view name);

}  // namespace etendue::render
