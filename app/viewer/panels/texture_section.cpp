#include "viewer/panels/texture_section.h"

#include <imgui.h>

#include <algorithm>

#include "image/format.h"
#include "image/tiled_image.h"
#include "render/document.h"
#include "spectrum/rgb.h"
#include "viewer/files/file_names.h"
#include "viewer/platform/platform.h"
#include "viewer/state/app_state.h"
#include "viewer/state/material_edits.h"
#include "viewer/widgets/basic_widgets.h"
#include "viewer/widgets/image_tooltip.h"
#include "viewer/widgets/parameter_widgets.h"

namespace etendue::viewer {
namespace {

constexpr int kThumbnailSide = 256;  // pixels, so that it can be enlarged

// A channel of a pixel from 0 to 1 as it is displayed. Grey images have equal RGB, images without alpha are opaque.
float channel_value(const image::Image& image, size_t pixel, int channel) {
  const bool has_alpha = image.channels % 2 == 0;
  if (channel == 3 && !has_alpha) return 1;
  const int stored = channel == 3 ? image.channels - 1 : image.channels < 3 ? 0 : channel;
  const size_t at = pixel * static_cast<size_t>(image.channels) + static_cast<size_t>(stored);
  // Bytes are displayed as they are stored, so that data and colours look as in other programs.
  return image.type == image::PixelType::byte8 ? srgb_to_linear(static_cast<float>(image.bytes[at]) / 255)
                                               : image.floats[at];
}

ThumbnailImage thumbnail_of(const image::Image& image, TextureChannel channel) {
  const float scale =
      std::min(1.0f, static_cast<float>(kThumbnailSide) / static_cast<float>(std::max(image.width, image.height)));
  const auto side = [scale](int length) { return std::max(1, static_cast<int>(scale * static_cast<float>(length))); };
  const int width = side(image.width), height = side(image.height);
  std::vector<float> pixels;
  for (int y = 0; y < height; ++y)
    for (int x = 0; x < width; ++x) {
      const size_t pixel = static_cast<size_t>(y * image.height / height) * static_cast<size_t>(image.width) +
                           static_cast<size_t>(x * image.width / width);
      for (int c = 0; c < 3; ++c)
        pixels.push_back(
            channel_value(image, pixel, channel == TextureChannel::rgb ? c : static_cast<int>(channel) - 1));
    }
  return {.width = width, .height = height, .pixels = std::make_shared<const std::vector<float>>(std::move(pixels))};
}

std::string size_text(const Texture& texture) {
  constexpr const char* kChannels[] = {"", "grey", "grey, alpha", "RGB", "RGBA"};
  const auto text = [&](int width, int height, int channels) {
    return std::to_string(width) + " x " + std::to_string(height) + ", " + kChannels[std::clamp(channels, 0, 4)];
  };
  if (texture.image) return text(texture.image->width, texture.image->height, texture.image->channels);
  if (texture.tiles) return text(texture.tiles->width, texture.tiles->height, texture.tiles->channels);
  return "no image";
}

void request_texture(AppState& state, const TextureSlot& slot) {
  state.files.request =
      FileRequest{.title = std::string("Texture: ") + slot.label,
                  .extensions = image::readable_extensions(),
                  .accept = [&state, &slot](const std::string& file) { load_texture(state, slot, file); }};
}

// A list of the slots that have no texture.
void draw_add_texture(AppState& state, const Material& material) {
  ImGui::SetNextItemWidth(-1);
  if (begin_combo("##add-texture", "Add texture...", ImGuiComboFlags_HeightLarge)) {
    for (const TextureSlot& slot : texture_slots()) {
      if ((material.*slot.use).texture >= 0 || (material.model && !slot.applies_to_models)) continue;
      if (ImGui::Selectable(slot.label)) request_texture(state, slot);
      state.ui.items.add(std::string("material.texture.add.") + slot.name);
      if (ImGui::IsItemHovered()) tooltip(state.ui, slot.doc);
    }
    ImGui::EndCombo();
  }
  state.ui.items.add("material.texture.add");
  if (ImGui::IsItemHovered()) tooltip(state.ui, "Reads an image file as a texture of the material");
}

std::vector<std::string> transform_names(const TextureSlot& slot) {
  std::vector<std::string> names;
  for (const char* part : {".uv-set", ".offset.x", ".offset.y", ".rotation", ".scale.x", ".scale.y"})
    names.push_back(std::string("texture.") + slot.name + part);
  return names;
}

}  // namespace

void TextureSection::draw(AppState& state, const Material& material) {
  const auto slots = texture_slots();
  shown_.resize(slots.size());
  const bool has_textures =
      std::ranges::any_of(slots, [&](const TextureSlot& slot) { return (material.*slot.use).texture >= 0; });
  if (has_textures) {
    note(state.ui, "The parameters of the material multiply its textures.");
    parameter_widgets(state, parameters.all());
  }
  for (size_t i = 0; i < slots.size(); ++i)
    if (const TextureUse use = material.*slots[i].use; use.texture >= 0) draw_slot(state, slots[i], use, i);
  draw_add_texture(state, material);
}

void TextureSection::draw_slot(AppState& state, const TextureSlot& slot, const TextureUse& use, size_t index) {
  const auto scene = state.document().scene;
  const Texture& texture = scene->textures[static_cast<size_t>(use.texture)];
  const std::string section = "material." + std::to_string(state.selection.material);
  const std::string item = std::string("material.texture.") + slot.name;
  ImGui::PushID(slot.name);
  const std::string full_name = texture.name.empty() ? "Texture without a name" : texture.name;
  const float side = 3.2f * ImGui::GetFrameHeight();
  if (texture.image) {
    Shown& shown = shown_[index];
    if (shown.image != texture.image || shown.channel != parameters.channel.value)
      shown = {texture.image, parameters.channel.value, thumbnail_of(*texture.image, parameters.channel.value)};
    const float scale = side / static_cast<float>(std::max(shown.thumbnail.width, shown.thumbnail.height));
    const ImVec2 corner = ImGui::GetCursorScreenPos();
    ImGui::Dummy({side, side});
    const ImTextureID thumbnail = thumbnails_.texture(state.platform.gl(), index, shown.thumbnail);
    ImGui::GetWindowDrawList()->AddImage(thumbnail, corner,
                                         {corner.x + scale * static_cast<float>(shown.thumbnail.width),
                                          corner.y + scale * static_cast<float>(shown.thumbnail.height)});
    if (ImGui::IsItemHovered()) image_tooltip(state.ui, thumbnail, shown.thumbnail, full_name);
  } else {
    ImGui::Dummy({side, side});
    if (ImGui::IsItemHovered()) tooltip(state.ui, full_name);
  }
  state.ui.items.add(item);
  ImGui::SameLine();
  ImGui::BeginGroup();
  ImGui::TextUnformatted(slot.label);
  if (ImGui::IsItemHovered()) tooltip(state.ui, slot.doc);
  const float width = ImGui::GetContentRegionAvail().x;
  const std::string name = texture.name.empty() ? "texture " + std::to_string(use.texture) : base_name(texture.name);
  ImGui::TextDisabled("%s", shortened(name + ", " + size_text(texture), width).c_str());
  if (ImGui::Button("Replace...")) request_texture(state, slot);
  state.ui.items.add(item + ".replace");
  ImGui::SameLine();
  if (ImGui::Button("Remove")) remove_texture(state, slot);
  state.ui.items.add(item + ".remove");
  ImGui::EndGroup();
  const bool is_identity = use.offset == Vec2(0) && use.scale == Vec2(1) && use.rotation == 0 && use.uv_set == 0;
  if (group(state.ui, "Transform", section + ".texture." + slot.name + ".", !is_identity))
    section_widgets_for(state, section, transform_names(slot));
  ImGui::PopID();
}

}  // namespace etendue::viewer
