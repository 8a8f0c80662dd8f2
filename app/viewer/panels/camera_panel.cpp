// From where is the scene seen, how wide, and what is sharp?
#include <imgui.h>

#include "viewer/layout/interface.h"
#include "viewer/widgets/number_widget.h"
#include "viewer/widgets/parameter_widgets.h"

namespace etendue::viewer {
namespace {

// Choosing a camera takes its place, its opening and its shape; the picture keeps its height.
void take_camera(Workbench& w, const Camera& camera) {
  render::Document changed = w.editor.document();
  changed.camera = camera;
  changed.camera_name = camera.name;
  if (camera.aspect > 0)
    changed.width = std::max(1, static_cast<int>(std::lround(static_cast<float>(changed.height) * camera.aspect)));
  w.edit(std::move(changed), "Camera " + camera.name);
  if (const auto scene = w.session.scene()) w.hand.find_pivot(camera, *scene);
}

void choose_camera(Workbench& w) {
  const auto cameras = scene::placed_cameras(*w.editor.document().scene);
  if (cameras.empty()) return note(w, "The file has no camera; this one was placed to show everything.");
  const auto name_of = [&](size_t i) {
    return cameras[i].name.empty() ? "camera " + std::to_string(i) : cameras[i].name;
  };
  label_column("From the file");
  size_t now = cameras.size();
  for (size_t i = 0; i < cameras.size(); ++i)
    if (cameras[i].to_world == w.editor.document().camera.to_world) now = i;
  if (ImGui::BeginCombo("##camera", now < cameras.size() ? name_of(now).c_str() : "moved by hand")) {
    for (size_t i = 0; i < cameras.size(); ++i) {
      ImGui::PushID(static_cast<int>(i));
      if (ImGui::Selectable(name_of(i).c_str(), i == now)) take_camera(w, cameras[i]);
      ImGui::PopID();
      w.items.place("camera.choose." + std::to_string(i));
    }
    ImGui::EndCombo();
  }
  w.items.place("camera.choose");
  if (ImGui::IsItemHovered()) tooltip(w, "The cameras that the file brings along");
}

// Each projection has one size; the other one is shown to a script that wants it all the same.
void draw_opening(Workbench& w) {
  const bool perspective = w.editor.document().camera.projection == Projection::perspective;
  some_widgets(w, "camera", {"projection"});
  if (perspective || w.items.wanted("camera.yfov")) some_widgets(w, "camera", {"yfov"});
  if (!perspective || w.items.wanted("camera.ymag")) some_widgets(w, "camera", {"ymag"});
}

}  // namespace

void draw_camera_panel(Workbench& w) {
  const std::vector<std::string> lens{"lens-radius", "focus-distance", "shutter"};
  const std::vector<std::string> eye{"eye.x", "eye.y", "eye.z"};
  const std::vector<std::string> axes{"right.x", "right.y", "right.z", "up.x",  "up.y",
                                      "up.z",    "back.x",  "back.y",  "back.z"};
  choose_camera(w);
  action_button(w, "view.frame-all");
  ImGui::SameLine();
  action_button(w, "view.frame-selection");
  if (group(w, "Opening", "camera.")) draw_opening(w);
  if (group(w, "Lens", "camera.")) {
    some_widgets(w, "camera", lens);
    if (ImGui::Checkbox("Focus by click", &w.view.focus_by_click)) w.notices.say("Click what should be sharp");
    w.items.place("camera.focus-by-click");
    if (ImGui::IsItemHovered())
      tooltip(w, "The next click in the picture sets the focus distance; a double click does it at any time");
  }
  if (group(w, "Place", "camera.eye.")) some_widgets(w, "camera", eye);
  const bool axis_wanted =
      w.items.wanted_below("camera.right") || w.items.wanted_below("camera.up") || w.items.wanted_below("camera.back");
  if (axis_wanted) ImGui::SetNextItemOpen(true);
  if (group(w, "Axes", "", false)) some_widgets(w, "camera", axes);
}

}  // namespace etendue::viewer
