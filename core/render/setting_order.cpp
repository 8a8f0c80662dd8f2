#include "render/setting_order.h"

namespace etendue::render {
namespace {

constexpr std::string_view kTexture = "texture.";

bool ends_with_part(std::string_view name, std::string_view part) {
  return name == part || (name.ends_with(part) && name[name.size() - part.size() - 1] == '.');
}

// "texture.normal", but not "texture.normal.rotation".
bool selects_texture(std::string_view name) {
  const size_t start = name.starts_with(kTexture) ? 0 : name.find(".texture.");
  if (start == std::string_view::npos) return false;
  const size_t slot = name.find(kTexture, start) + kTexture.size();
  return name.find('.', slot) == std::string_view::npos;
}

}  // namespace

SettingKind kind_of_setting(std::string_view name) {
  if (ends_with_part(name, "model") || ends_with_part(name, "specular-glossiness")) return SettingKind::model;
  if (ends_with_part(name, "preset") || selects_texture(name)) return SettingKind::selection;
  return name.ends_with("-spectrum") || ends_with_part(name, "glass") ? SettingKind::replacing : SettingKind::value;
}

}  // namespace etendue::render
