#include "viewer/layout/popups.h"

#include <imgui.h>

#include <algorithm>
#include <cmath>
#include <optional>
#include <string>

#include "render/session.h"
#include "viewer/files/file_names.h"
#include "viewer/files/loader.h"
#include "viewer/state/app_state.h"
#include "viewer/widgets/basic_widgets.h"
#include "viewer/widgets/value_text.h"

namespace etendue::viewer {
namespace {

constexpr ImGuiWindowFlags kPopup = ImGuiWindowFlags_NoDecoration | ImGuiWindowFlags_AlwaysAutoResize |
                                    ImGuiWindowFlags_NoMove | ImGuiWindowFlags_NoSavedSettings |
                                    ImGuiWindowFlags_NoFocusOnAppearing | ImGuiWindowFlags_NoNav;

// A bar that moves back and forth, because the duration is unknown.
void draw_activity_bar(double seconds, float width) {
  constexpr double kPeriod = 1.5;    // seconds
  constexpr float kBarShare = 0.2f;  // of the width
  const float position = static_cast<float>(std::fmod(seconds, kPeriod) / kPeriod) * (1 - kBarShare);
  const float height = ImGui::GetFontSize() * 0.35f;
  const ImVec2 corner = ImGui::GetCursorScreenPos();
  const float bottom = corner.y + height;
  ImDrawList* draw = ImGui::GetWindowDrawList();
  draw->AddRectFilled(corner, {corner.x + width, bottom}, ImGui::GetColorU32(ImGuiCol_FrameBg), height / 2);
  draw->AddRectFilled({corner.x + width * position, corner.y}, {corner.x + width * (position + kBarShare), bottom},
                      ImGui::GetColorU32(ImGuiCol_PlotHistogram), height / 2);
  ImGui::Dummy({width, height});
}

}  // namespace

void draw_loading(AppState& state) {
  Loader& loader = *state.files.loader;
  const bool is_compiling =
      state.has_document() && state.session->status().phase == "compiling" && !state.viewport.frame;
  if (!loader.is_busy() && !is_compiling) return;
  const Placement& region = state.viewport.region;
  // In the centre, or below the picture of the file.
  const bool has_picture = state.viewport.stored_picture != nullptr;
  const Vec2 at = region.corner + region.size * (has_picture ? Vec2(0.5f, 0.98f) : Vec2(0.5f));
  ImGui::SetNextWindowPos({at.x, at.y}, ImGuiCond_Always, {0.5f, has_picture ? 1.0f : 0.5f});
  ImGui::Begin("##loading", nullptr, kPopup);
  const std::string text =
      loader.is_busy() ? "Opening " + base_name(loader.file()) : "Building acceleration structures";
  ImGui::TextUnformatted(text.c_str());
  draw_activity_bar(loader.is_busy() ? loader.seconds() : ImGui::GetTime(), ImGui::GetFontSize() * 20);
  if (loader.is_busy()) {
    ImGui::PushFont(state.ui.fonts.monospace);
    ImGui::TextDisabled("%.1f s", loader.seconds());
    ImGui::PopFont();
    ImGui::SameLine();
    if (ImGui::SmallButton("Cancel")) loader.cancel();
    state.ui.items.add("file.cancel");
  }
  ImGui::End();
}

void draw_notices(AppState& state) {
  state.viewport.height_of_notices = 0;
  if (state.interface.dialog_open) return;  // they would cover it
  const Placement& region = state.viewport.region;
  const Theme& theme = state.ui.theme;
  float bottom = region.corner.y + region.size.y - 10 - state.viewport.playback.bar_height;
  std::optional<size_t> closed;
  bool opens_log = false;
  std::string opened_panel;
  const auto& notices = state.notices.all();
  // The newest notice is at the bottom.
  for (size_t i = notices.size(); i-- > 0;) {
    const auto& notice = notices[i];
    ImGui::SetNextWindowPos({region.corner.x + 10, bottom}, ImGuiCond_Always, {0, 1});
    ImGui::SetNextWindowSizeConstraints({0, 0}, {region.size.x - 20, region.size.y});
    ImGui::SetNextWindowBgAlpha(0.92f);
    ImGui::PushStyleVar(ImGuiStyleVar_WindowMinSize, {1, 1});
    ImGui::Begin(("##notice" + std::to_string(i)).c_str(), nullptr, kPopup);
    ImGui::PushTextWrapPos(std::min(region.size.x - 90, ImGui::GetFontSize() * 40));
    const std::string text =
        notice.count > 1 ? formatted("%s (%d times)", notice.text.c_str(), notice.count) : notice.text;
    ImGui::TextColored(notice.is_error ? theme.warning : theme.text, "%s", text.c_str());
    ImGui::PopTextWrapPos();
    if (notice.has_more) {
      if (ImGui::SmallButton("Show all")) opens_log = true;
      state.ui.items.add("notice.show-all");
    }
    if (!notice.panel.empty()) {
      if (ImGui::SmallButton("Change...")) opened_panel = notice.panel;
      state.ui.items.add("notice.change");
    }
    ImGui::SameLine();
    if (ImGui::SmallButton("Close")) closed = i;
    state.ui.items.add("notice.close");
    bottom = ImGui::GetWindowPos().y - 6;
    ImGui::End();
    ImGui::PopStyleVar();
  }
  state.viewport.height_of_notices = notices.empty() ? 0 : region.corner.y + region.size.y - bottom;
  if (closed) state.notices.close(*closed);
  if (Panel* panel = opened_panel.empty() ? nullptr : state.panels.find(opened_panel)) state.panels.open(*panel);
  if (opens_log) state.panels.open(*state.panels.find("panel.messages"));
}

}  // namespace etendue::viewer
