// What is in the scene, and where is the thing that I see?
#include <imgui.h>

#include <algorithm>

#include "scene/rotation.h"
#include "viewer/layout/interface.h"
#include "viewer/widgets/parameter_widgets.h"

namespace etendue::viewer {
namespace {

std::string name_of(const scene::Scene& scene, int index) {
  const auto& node = scene.nodes[static_cast<size_t>(index)];
  if (!node.name.empty()) return node.name;
  const char* kind = node.mesh >= 0 ? "mesh " : node.light >= 0 ? "light " : node.camera >= 0 ? "camera " : "node ";
  return kind + std::to_string(index);
}

const char* kind_of(const scene::Node& node) {
  if (node.mesh >= 0) return "mesh";
  if (node.light >= 0) return "light";
  if (node.camera >= 0) return "camera";
  return "";
}

bool hides(const scene::Scene& scene, int index, int wanted) {
  for (int at = wanted; at >= 0; at = scene.nodes[static_cast<size_t>(at)].parent)
    if (at == index) return at != wanted;
  return false;
}

bool is_animated(const scene::Scene& scene, int index) {
  const auto moves = [&](const scene::AnimationChannel& c) {
    return c.node == index && c.path != scene::AnimatedPath::weights;
  };
  return std::any_of(scene.animations.begin(), scene.animations.end(), [&](const auto& animation) {
    return std::any_of(animation->channels.begin(), animation->channels.end(), moves);
  });
}

void draw_selected(Workbench& w, const scene::Scene& scene, int index) {
  const std::string section = "node." + std::to_string(index);
  section_widgets(w, section);
  const auto& node = scene.nodes[static_cast<size_t>(index)];
  if (!scene::in_parts(node.transform))
    note(w, "Its matrix shears or flattens: there is no rotation and scale to edit.");
  if (is_animated(scene, index)) note(w, "An animation moves it: what the animation sets does not listen to these.");
  if (node.camera >= 0) note(w, "The picture's own camera is in the Camera tab.");
  action_button(w, "view.frame-selection");
}

void draw_node(Workbench& w, const scene::Scene& scene, int index) {
  const auto& node = scene.nodes[static_cast<size_t>(index)];
  const std::string section = "node." + std::to_string(index);
  ImGui::PushID(index);
  bool visible = node.visible;
  ImGui::PushStyleVar(ImGuiStyleVar_FramePadding, {2, 2});
  if (ImGui::Checkbox("##visible", &visible))
    for (const auto& binding : render::bindings(w.editor.document(), section))
      if (binding.info.name == section + ".visible") w.edit(binding, visible);
  ImGui::PopStyleVar();
  w.items.place("scene." + section + ".visible");
  if (ImGui::IsItemHovered()) tooltip(w, "Visible: hidden objects are not in the scene at all");
  ImGui::SameLine();
  ImGuiTreeNodeFlags flags =
      ImGuiTreeNodeFlags_OpenOnArrow | ImGuiTreeNodeFlags_SpanAvailWidth | ImGuiTreeNodeFlags_DefaultOpen;
  if (node.children.empty()) flags |= ImGuiTreeNodeFlags_Leaf | ImGuiTreeNodeFlags_NoTreePushOnOpen;
  if (w.selection.node == index) flags |= ImGuiTreeNodeFlags_Selected;
  if (w.selection.node >= 0 && hides(scene, index, w.selection.node)) ImGui::SetNextItemOpen(true, ImGuiCond_Once);
  if (!visible) ImGui::PushStyleColor(ImGuiCol_Text, w.theme.quiet);
  const bool open = ImGui::TreeNodeEx("##node", flags, "%s", name_of(scene, index).c_str());
  if (!visible) ImGui::PopStyleColor();
  if (ImGui::IsItemClicked() && !ImGui::IsItemToggledOpen()) w.select(index, -1);
  w.items.place("scene." + section);
  if (ImGui::IsItemHovered() && *kind_of(node)) tooltip(w, std::string(kind_of(node)) + ", " + section);
  if (open && !node.children.empty()) {
    for (const int child : node.children) draw_node(w, scene, child);
    ImGui::TreePop();
  }
  ImGui::PopID();
}

}  // namespace

void draw_scene_panel(Workbench& w) {
  // The tree edits the document while it is walked: it walks the one from before.
  const auto scene = w.editor.document().scene;
  section_widgets(w, "scene");
  const bool chosen = w.selection.node >= 0 && static_cast<size_t>(w.selection.node) < scene->nodes.size();
  const float below = chosen ? ImGui::GetFrameHeightWithSpacing() * 6.5f : 0;
  if (group(w, "Objects", "")) {
    const float height = std::max(ImGui::GetContentRegionAvail().y - below, ImGui::GetFrameHeight() * 6);
    ImGui::BeginChild("##tree", {0, height});
    for (const int root : scene->roots) draw_node(w, *scene, root);
    ImGui::EndChild();
  }
  if (!chosen) return;
  if (group(w, name_of(*scene, w.selection.node).c_str(), "node.")) {
    draw_selected(w, *scene, w.selection.node);
  }
}

}  // namespace etendue::viewer
