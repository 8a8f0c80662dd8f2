#include "viewer/panels/environment_images.h"

#include <imgui.h>

#include <cmath>
#include <functional>
#include <memory>

#include "light/environments/builtin_environment.h"
#include "light/sampling/environment_map.h"
#include "render/document.h"
#include "viewer/platform/platform.h"
#include "viewer/state/app_state.h"
#include "viewer/widgets/basic_widgets.h"

namespace etendue::viewer {
namespace {

constexpr int kMapWidth = 64, kMapHeight = 32;  // pixels

// The radiance of an environment by direction.
std::function<Rgb(const Vec3&)> radiance_of(const BuiltinEnvironment& environment) {
  if (environment.radiance) return environment.radiance;
  if (!environment.make) return [](const Vec3&) { return Rgb(1); };
  return [map = std::make_shared<EnvironmentMap>(environment.make())](const Vec3& d) { return map->radiance(d); };
}

// The environment in all directions: the front is in the centre, the top is up. Those with the luminance of daylight are
// darkened.
ThumbnailImage image_of(const BuiltinEnvironment& environment) {
  const auto radiance_at = radiance_of(environment);
  std::vector<float> pixels;
  double sum = 0;
  for (int y = 0; y < kMapHeight; ++y)
    for (int x = 0; x < kMapWidth; ++x) {
      const float azimuth = 2 * kPi * ((static_cast<float>(x) + 0.5f) / kMapWidth - 0.5f);
      const float polar = kPi * (static_cast<float>(y) + 0.5f) / kMapHeight;
      const Vec3 direction(std::sin(polar) * std::sin(azimuth), std::cos(polar), std::sin(polar) * std::cos(azimuth));
      const Rgb radiance = radiance_at(direction);
      sum += static_cast<double>(luminance(radiance));
      pixels.insert(pixels.end(), {radiance.r, radiance.g, radiance.b});
    }
  const auto mean = static_cast<float>(sum / (kMapWidth * kMapHeight));
  return {.width = kMapWidth,
          .height = kMapHeight,
          .pixels = std::make_shared<const std::vector<float>>(std::move(pixels)),
          .exposure = -1 - std::max(0.0f, std::log2(mean)),
          .curve = image::ToneCurve::neutral};
}

bool is_current(const Environment& environment, const BuiltinEnvironment& builtin) {
  return environment.map && environment.file == builtin.name;
}

// An image of this width. Returns whether it was clicked.
bool draw_image(const UiContext& ui, ImTextureID texture, float width, bool is_selected) {
  const ImVec2 corner = ImGui::GetCursorScreenPos(), end(corner.x + width, corner.y + width / 2);
  const bool clicked = ImGui::InvisibleButton("##environment", {width, width / 2});
  ImDrawList* draw = ImGui::GetWindowDrawList();
  draw->AddImage(texture, corner, end);
  if (is_selected || ImGui::IsItemHovered()) draw->AddRect(corner, end, ImGui::GetColorU32(ui.theme.accent), 0, 0, 2);
  return clicked;
}

}  // namespace

void EnvironmentImages::draw(AppState& state) {
  const auto builtin = builtin_environments();
  if (images_.empty())
    for (const BuiltinEnvironment& environment : builtin) images_.push_back(image_of(environment));
  const float spacing = 2 * ImGui::GetStyle().FramePadding.y;
  const float width = (ImGui::GetContentRegionAvail().x + spacing) / static_cast<float>(builtin.size()) - spacing;
  const BuiltinEnvironment* chosen = nullptr;
  for (size_t i = 0; i < builtin.size(); ++i) {
    if (i > 0) ImGui::SameLine(0, spacing);
    ImGui::PushID(static_cast<int>(i));
    const ImTextureID texture = textures_.texture(state.platform.gl(), i, images_[i]);
    const bool is_selected = is_current(state.document().scene->environment, builtin[i]);
    if (draw_image(state.ui, texture, width, is_selected)) chosen = &builtin[i];
    ImGui::PopID();
    state.ui.items.add("environment.image." + std::to_string(i));
    if (ImGui::IsItemHovered()) tooltip(state.ui, std::string(builtin[i].label) + ". " + builtin[i].doc);
  }
  if (chosen) state.set_parameter("environment.preset", std::string(chosen->name));
}

}  // namespace etendue::viewer
