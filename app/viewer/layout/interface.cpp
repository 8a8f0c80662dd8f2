// Where everything lies: menus above, the picture on the left, the column with its tabs on the right, the drawer under
// the picture, the status line below.
#include <imgui.h>
#include <imgui_internal.h>

#include <cmath>

#include "integrator/integrator.h"
#include "viewer/layout/bottom_panel.h"
#include "viewer/layout/interface.h"
#include "viewer/widgets/parameter_widgets.h"

namespace etendue::viewer {
namespace {

constexpr ImGuiWindowFlags kFixed = ImGuiWindowFlags_NoTitleBar | ImGuiWindowFlags_NoResize | ImGuiWindowFlags_NoMove |
                                    ImGuiWindowFlags_NoCollapse | ImGuiWindowFlags_NoSavedSettings |
                                    ImGuiWindowFlags_NoBringToFrontOnFocus;

constexpr size_t kEscape = 256;  // as GLFW numbers it

float default_column(float width, float scale) { return std::clamp(width * 0.3f, 370 * scale, 460 * scale); }

void draw_tabs(Workbench& w) {
  // Narrow tabs, so that all six names fit.
  const auto tab_style = [&](bool on) {
    if (!on) return ImGui::PopStyleVar(2);
    ImGui::PushStyleVar(ImGuiStyleVar_FramePadding, {5 * w.platform.scale(), 5 * w.platform.scale()});
    ImGui::PushStyleVar(ImGuiStyleVar_ItemInnerSpacing, {2, 4});
  };
  tab_style(true);
  if (!ImGui::BeginTabBar("##tabs", ImGuiTabBarFlags_FittingPolicyResizeDown | ImGuiTabBarFlags_NoTooltip))
    return tab_style(false);
  const auto wanted = std::exchange(w.view.reveal, std::nullopt);
  for (const TabInfo& info : tabs()) {
    const bool open = ImGui::BeginTabItem(info.label, nullptr, wanted == info.tab ? ImGuiTabItemFlags_SetSelected : 0);
    w.items.place(info.name);
    if (ImGui::IsItemHovered()) tooltip(w, info.doc);
    if (!open) continue;
    w.view.tab = info.tab;
    tab_style(false);
    ImGui::BeginChild("##panel");
    if (w.editor.empty())
      note(w, w.loader.busy() ? "The scene is being opened." : "Open a scene with Ctrl+O, or drop one on the window.");
    else
      info.draw(w);
    ImGui::EndChild();
    tab_style(true);
    ImGui::EndTabItem();
  }
  ImGui::EndTabBar();
  tab_style(false);
}

void draw_splitter(Workbench& w, float x, float top, float height) {
  const float grip = std::max(6.0f, ImGui::GetFontSize() * 0.4f);
  ImGui::SetNextWindowPos({x - grip / 2, top});
  ImGui::SetNextWindowSize({grip, height});
  ImGui::PushStyleVar(ImGuiStyleVar_WindowPadding, {0, 0});
  ImGui::PushStyleVar(ImGuiStyleVar_WindowMinSize, {1, 1});
  ImGui::Begin("##splitter", nullptr, kFixed | ImGuiWindowFlags_NoBackground | ImGuiWindowFlags_NoScrollbar);
  ImGui::InvisibleButton("##grip", {grip, height});
  w.items.place("layout.column");
  if (ImGui::IsItemHovered() || ImGui::IsItemActive()) {
    ImGui::SetMouseCursor(ImGuiMouseCursor_ResizeEW);
    ImGui::GetWindowDrawList()->AddRectFilled({x - 1, top}, {x + 1, top + height}, ImGui::GetColorU32(w.theme.accent));
  }
  if (ImGui::IsItemActive()) w.settings.column = (ImGui::GetIO().DisplaySize.x - w.input.mouse.x) / w.platform.scale();
  if (ImGui::IsItemHovered() && ImGui::IsMouseDoubleClicked(0)) w.settings.column = 0;
  ImGui::End();
  ImGui::PopStyleVar(2);
}

}  // namespace

const std::vector<TabInfo>& tabs() {
  static const std::vector<TabInfo> list{
      {Tab::render, "tab.render", "Render", "The method, when it stops, the size of the picture", draw_render_panel},
      {Tab::scene, "tab.scene", "Scene", "Objects: choose, hide, move", draw_scene_panel},
      {Tab::material, "tab.material", "Material", "The surface that was picked", draw_material_panel},
      {Tab::light, "tab.light", "Light", "Lights and the environment", draw_light_panel},
      {Tab::camera, "tab.camera", "Camera", "Place, opening, lens, focus", draw_camera_panel},
      {Tab::display, "tab.display", "Display", "Exposure, tone curve, false colour, layers", draw_display_panel},
  };
  return list;
}

bool reveal(Workbench& w, const std::string& setting) {
  const std::string first = setting.substr(0, setting.find('.'));
  const auto index = [&] { return std::atoi(setting.c_str() + first.size() + 1); };
  w.view.interface = true;
  if (setting == "camera.exposure" || first == "display" || first == "view") return w.show_tab(Tab::display), true;
  if (first == "compare") return w.view.sheet = "sheet.convergence", true;
  if (first == "files") return w.files.is_open();
  if (first == "techniques") return w.view.sheet = "sheet.techniques", true;
  if (first == "meter") return w.show_tab(Tab::light), true;
  if (first == "surface") return w.view.sheet = "sheet.surface", true;
  if (first == "sampling") return w.view.sheet = "sheet.sampling", true;
  if (first == "camera") return w.show_tab(Tab::camera), true;
  if (first == "scene") return w.show_tab(Tab::scene), true;
  if (first == "node") return w.selection.node = index(), w.show_tab(Tab::scene), true;
  if (first == "material") return w.selection.material = index(), w.show_tab(Tab::material), true;
  if (first == "light") return w.selection.light = index(), w.show_tab(Tab::light), true;
  if (first == "environment") return w.show_tab(Tab::light), true;
  if (first == "advice") return w.show_tab(Tab::render), true;
  const bool method = integrator::find_integrator(first) || find_sampler(first);
  if (method || first == "render" || first == "film" || first == "model") return w.show_tab(Tab::render), true;
  return false;
}

void draw_interface(Workbench& w, float seconds) {
  w.items.begin_frame();
  const ImVec2 screen = ImGui::GetIO().DisplaySize;
  const float scale = w.platform.scale();
  const bool typing = w.view.typing = ImGui::GetIO().WantTextInput;
  // Escape closes what lies on top and does nothing to what is below.
  const bool closes = w.view.covered && w.input.keys_pressed[kEscape];
  if (!typing && !closes && !w.files.is_open() && !w.input.buttons[1]) w.actions.run_pressed(w.input);

  float top = 0, bottom = screen.y, right = screen.x;
  if (w.view.interface) {
    draw_menu_bar(w);
    top = ImGui::GetFrameHeight();
    bottom = screen.y - std::floor(ImGui::GetFontSize() + 10);
    draw_status_bar(w, bottom, screen.y - bottom);
    const float wanted = w.settings.column > 0 ? w.settings.column * scale : default_column(screen.x, scale);
    w.view.column = std::floor(std::clamp(wanted, std::min(240 * scale, screen.x * 0.5f), screen.x * 0.7f));
    right = screen.x - w.view.column;
    ImGui::SetNextWindowPos({right, top});
    ImGui::SetNextWindowSize({w.view.column, bottom - top});
    ImGui::Begin("##column", nullptr, kFixed | ImGuiWindowFlags_NoScrollbar);
    draw_tabs(w);
    ImGui::End();
    draw_splitter(w, right, top, bottom - top);
    bottom -= draw_drawer(w, top, right, bottom);
  }
  w.view.region = {Vec2(0, top), glm::max(Vec2(right, bottom - top), Vec2(1))};
  if (!w.editor.empty())
    w.view.picture = fitted(w.view.region, {w.editor.document().width, w.editor.document().height});

  handle_viewport(w, seconds);
  draw_viewport_overlay(w);
  draw_loading(w);
  draw_notices(w);
  draw_help(w);
  draw_palette(w);
  w.files.draw(w);
  // Without keyboard navigation ImGui leaves menus, lists and colour pickers open.
  if (closes && ImGui::IsPopupOpen("", ImGuiPopupFlags_AnyPopup)) ImGui::ClosePopupToLevel(0, true);
  w.view.covered = w.view.help || w.view.palette || ImGui::IsPopupOpen("", ImGuiPopupFlags_AnyPopup);
}

}  // namespace etendue::viewer
