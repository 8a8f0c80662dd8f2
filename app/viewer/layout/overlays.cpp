// What lies over everything for a while: the help sheet, the file that is being opened, lines about what happened.
#include <imgui.h>

#include <filesystem>

#include "viewer/layout/interface.h"
#include "viewer/widgets/parameter_widgets.h"

namespace etendue::viewer {
namespace {

constexpr ImGuiWindowFlags kOverlay = ImGuiWindowFlags_NoDecoration | ImGuiWindowFlags_AlwaysAutoResize |
                                      ImGuiWindowFlags_NoMove | ImGuiWindowFlags_NoSavedSettings |
                                      ImGuiWindowFlags_NoFocusOnAppearing | ImGuiWindowFlags_NoNav;

struct Hand {
  const char *what, *how;
};

constexpr Hand kHands[] = {
    {"Orbit", "left drag"},
    {"Pan", "middle drag, Shift + left drag"},
    {"Dolly to the pointer", "wheel"},
    {"Fly", "hold right, W A S D Q E; wheel sets the speed"},
    {"Select", "click"},
    {"Focus and orbit centre", "double click"},
    {"Move the divider between A and B", "drag it; double click centres it"},
    {"See the reference", "hold Shift"},
    {"Look at a pixel's samples", "Ctrl + click, with the sampling sheet open"},
    {"Type a number", "double click on it"},
    {"Reset a setting", "Ctrl + click on it"},
    {"Open a scene, a snapshot, an environment", "drop the file on the window"},
};

void row(const std::string& what, const std::string& how) {
  ImGui::TableNextRow();
  ImGui::TableNextColumn();
  ImGui::TextUnformatted(what.c_str());
  ImGui::TableNextColumn();
  ImGui::TextDisabled("%s", how.c_str());
}

void key_column(const Workbench& w, bool integrators) {
  for (const auto& action : w.actions.all()) {
    if (action.shortcut.empty() || action.name.starts_with("integrator.") != integrators) continue;
    std::string keys;
    for (const Chord& chord : action.chords()) keys += (keys.empty() ? "" : ", ") + label(chord);
    row(action.label, keys);
  }
}

// A table that is this many letters wide.
bool sheet(const char* name, float letters) {
  return ImGui::BeginTable(name, 2, ImGuiTableFlags_SizingFixedFit | ImGuiTableFlags_PadOuterX,
                           {ImGui::GetFontSize() * letters, 0});
}

}  // namespace

void draw_help(Workbench& w) {
  if (!w.view.help) return;
  const ImVec2 screen = ImGui::GetIO().DisplaySize;
  ImGui::SetNextWindowPos({screen.x / 2, screen.y / 2}, ImGuiCond_Always, {0.5f, 0.5f});
  ImGui::PushStyleVar(ImGuiStyleVar_WindowBorderSize, 1);
  ImGui::PushStyleVar(ImGuiStyleVar_WindowPadding, {20, 16});
  ImGui::Begin("##help", nullptr, kOverlay);
  ImGui::TextColored(w.theme.accent, "Keys and hands");
  ImGui::Spacing();
  if (sheet("##hands", 38)) {
    for (const auto& [what, how] : kHands) row(what, how);
    key_column(w, true);
    ImGui::EndTable();
  }
  ImGui::SameLine();
  if (sheet("##keys", 20)) {
    key_column(w, false);
    ImGui::EndTable();
  }
  ImGui::Spacing();
  if (ImGui::Button("Close") || ImGui::IsKeyPressed(ImGui::GetKeyIndex(ImGuiKey_Escape))) w.view.help = false;
  w.items.place("help.close");
  ImGui::End();
  ImGui::PopStyleVar(2);
}

void draw_loading(Workbench& w) {
  const bool compiles = !w.editor.empty() && w.session.status().phase == "compiling" && !w.frame;
  if (!w.loader.busy() && !compiles) return;
  const Placement& r = w.view.region;
  ImGui::SetNextWindowPos({r.corner.x + r.size.x / 2, r.corner.y + r.size.y / 2}, ImGuiCond_Always, {0.5f, 0.5f});
  ImGui::Begin("##loading", nullptr, kOverlay);
  const std::string name = std::filesystem::path(w.loader.file()).filename().string();
  const float width = ImGui::GetFontSize() * 20;
  ImGui::TextUnformatted(w.loader.busy() ? ("Opening " + name).c_str() : "Building the acceleration structure");
  // How long it will take is not known: the bar only shows that something goes on.
  const double seconds = w.loader.busy() ? w.loader.seconds() : ImGui::GetTime();
  const float at = static_cast<float>(std::fmod(seconds, 1.5) / 1.5);
  const ImVec2 corner = ImGui::GetCursorScreenPos();
  const float height = ImGui::GetFontSize() * 0.35f;
  ImDrawList* draw = ImGui::GetWindowDrawList();
  draw->AddRectFilled(corner, {corner.x + width, corner.y + height}, ImGui::GetColorU32(ImGuiCol_FrameBg), height / 2);
  draw->AddRectFilled({corner.x + width * 0.8f * at, corner.y},
                      {corner.x + width * (0.8f * at + 0.2f), corner.y + height},
                      ImGui::GetColorU32(ImGuiCol_PlotHistogram), height / 2);
  ImGui::Dummy({width, height});
  if (w.loader.busy()) {
    ImGui::PushFont(w.faces.figures);
    ImGui::TextDisabled("%.1f s", w.loader.seconds());
    ImGui::PopFont();
    ImGui::SameLine();
    if (ImGui::SmallButton("Cancel")) w.loader.cancel();
    w.items.place("file.cancel");
  }
  ImGui::End();
}

void draw_notices(Workbench& w) {
  const Placement& r = w.view.region;
  float bottom = r.corner.y + r.size.y - 10;
  size_t closed = SIZE_MAX;
  for (size_t n = w.notices.all().size(); n-- > 0;) {
    const auto& notice = w.notices.all()[n];
    ImGui::SetNextWindowPos({r.corner.x + 10, bottom}, ImGuiCond_Always, {0, 1});
    ImGui::SetNextWindowSizeConstraints({0, 0}, {r.size.x - 20, r.size.y});
    ImGui::SetNextWindowBgAlpha(0.92f);
    ImGui::PushStyleVar(ImGuiStyleVar_WindowMinSize, {1, 1});
    ImGui::Begin(("##notice" + std::to_string(n)).c_str(), nullptr, kOverlay);
    ImGui::PushTextWrapPos(std::min(r.size.x - 90, ImGui::GetFontSize() * 40));
    if (notice.error)
      ImGui::TextColored(w.theme.warning, "%s", notice.text.c_str());
    else
      ImGui::TextUnformatted(notice.text.c_str());
    ImGui::PopTextWrapPos();
    if (notice.error) {
      ImGui::SameLine();
      if (ImGui::SmallButton("Close")) closed = n;
      w.items.place("notice.close");
    }
    bottom = ImGui::GetWindowPos().y - 6;
    ImGui::End();
    ImGui::PopStyleVar();
  }
  if (closed != SIZE_MAX) w.notices.close(closed);
}

}  // namespace etendue::viewer
