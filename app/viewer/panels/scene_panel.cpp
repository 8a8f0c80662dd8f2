// The objects of the scene: selection, visibility and transforms.
#include <imgui.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <nlohmann/json.hpp>
#include <utility>

#include "render/document.h"
#include "render/session.h"
#include "scene/compiled_scene.h"
#include "scene/light_counts.h"
#include "scene/pose.h"
#include "scene/rotation.h"
#include "viewer/panels/object_names.h"
#include "viewer/panels/panel.h"
#include "viewer/platform/platform.h"
#include "viewer/state/app_state.h"
#include "viewer/state/object_edits.h"
#include "viewer/widgets/action_widgets.h"
#include "viewer/widgets/basic_widgets.h"
#include "viewer/widgets/number_widget.h"
#include "viewer/widgets/object_shapes.h"
#include "viewer/widgets/parameter_widgets.h"
#include "viewer/widgets/unicode.h"
#include "viewer/widgets/vector_widgets.h"

namespace etendue::viewer {
namespace {

ObjectKind kind_of(const scene::Node& node) {
  if (node.mesh >= 0) return ObjectKind::mesh;
  if (node.light >= 0) return ObjectKind::light;
  return node.camera >= 0 ? ObjectKind::camera : ObjectKind::group;
}

const char* label_of(ObjectKind kind) {
  constexpr const char* kLabels[] = {"node", "mesh", "light", "camera"};
  return kLabels[static_cast<size_t>(kind)];
}

constexpr const char* kNameItem = "object.name";

std::string node_name(const scene::Scene& scene, int index) {
  const auto& node = scene.nodes[static_cast<size_t>(index)];
  return object_name(node.name, label_of(kind_of(node)), static_cast<size_t>(index));
}

// The nodes of the tree that a filter shows: those whose name or kind contains it, with all their ancestors.
class TreeFilter {
 public:
  void update(const std::shared_ptr<const scene::Scene>& scene, const std::string& filter) {
    if (scene_ == scene && filter_ == filter) return;
    scene_ = scene;
    filter_ = filter;
    shown_.assign(scene->nodes.size(), false);
    if (filter.empty()) return;
    for (size_t i = 0; i < shown_.size(); ++i) {
      const std::string name = node_name(*scene, static_cast<int>(i)) + " " + label_of(kind_of(scene->nodes[i]));
      if (!contains_ignoring_case(name, filter)) continue;
      for (int node = static_cast<int>(i); node >= 0 && !shown_[static_cast<size_t>(node)];
           node = scene->nodes[static_cast<size_t>(node)].parent)
        shown_[static_cast<size_t>(node)] = true;
    }
  }
  bool is_active() const { return !filter_.empty(); }
  bool shows(int node) const { return filter_.empty() || shown_[static_cast<size_t>(node)]; }
  bool shows_any() const { return filter_.empty() || std::ranges::find(shown_, true) != shown_.end(); }

 private:
  std::shared_ptr<const scene::Scene> scene_;
  std::string filter_;
  std::vector<bool> shown_;
};

// False for a node that is not in the scene: the selected one, if a widget of this frame has added it to the document.
bool is_ancestor(const scene::Scene& scene, int ancestor, int node) {
  if (static_cast<size_t>(node) >= scene.nodes.size()) return false;
  for (int i = scene.nodes[static_cast<size_t>(node)].parent; i >= 0; i = scene.nodes[static_cast<size_t>(i)].parent)
    if (i == ancestor) return true;
  return false;
}

// The name of the selected node, which is applied when the field is left or Enter is pressed.
void name_field(AppState& state, const scene::Node& node) {
  std::array<char, 256> text{};
  node.name.copy(text.data(), text.size() - 1);
  label_column("Name");
  const bool entered = ImGui::InputText("##name", text.data(), text.size(), ImGuiInputTextFlags_EnterReturnsTrue);
  const bool left = ImGui::IsItemDeactivatedAfterEdit();
  state.ui.items.add(kNameItem);
  if (const auto requested = state.ui.items.take_request(kNameItem)) {
    rename_selected(state, *requested);
    state.ui.items.answer("");
    return;
  }
  if ((entered || left) && node.name != text.data()) rename_selected(state, text.data());
}

void draw_selected_node(AppState& state, const scene::Scene& scene, int index) {
  const auto& node = scene.nodes[static_cast<size_t>(index)];
  name_field(state, node);
  for (const char* action : {"gizmo.move", "gizmo.rotate", "gizmo.scale", "gizmo.local"}) {
    action_button(state, action);
    ImGui::SameLine();
  }
  ImGui::NewLine();
  section_widgets(state, "node." + std::to_string(index));
  if (!scene::decompose(node.transform))
    note(state.ui, "The matrix has shear or a zero scale, so rotation and scale cannot be edited.");
  if (scene::has_animated_transform(scene, index))
    note(state.ui,
         "Keyframes set the transform of this object: translation, rotation and scale above have no effect. Handles "
         "and Set keyframe change it at the current time.");
  if (node.camera >= 0) note(state.ui, "The parameters of the current view are in the Camera panel.");
  action_button(state, "view.frame-selection");
  ImGui::SameLine();
  action_button(state, "object.duplicate");
  ImGui::SameLine();
  action_button(state, "object.delete");
}

void visibility_checkbox(AppState& state, const scene::Node& node, const std::string& section) {
  bool visible = node.visible;
  ImGui::PushStyleVar(ImGuiStyleVar_FramePadding, {2, 2});
  const bool toggled = ImGui::Checkbox("##visible", &visible);
  ImGui::PopStyleVar();
  state.ui.items.add("scene." + section + ".visible");
  if (ImGui::IsItemHovered()) tooltip(state.ui, "Visible. Hidden objects are not rendered and cast no shadows");
  if (toggled) state.set_parameter(section + ".visible", visible);
}

// The context menu of a node.
void draw_node_menu(AppState& state, const scene::Node& node, int index) {
  if (!ImGui::BeginPopupContextItem("##menu")) return;
  if (!is_selected(state, index)) state.select(index, -1);
  for (const char* action :
       {"view.frame-selection", "object.duplicate", "object.delete", "object.parent", "object.unparent"})
    action_menu_item(state, *state.actions.find(action));
  const std::string parameter = "node." + std::to_string(index) + ".visible";
  if (ImGui::MenuItem(node.visible ? "Hide" : "Show")) state.set_parameter(parameter, !node.visible);
  if (node.mesh >= 0 && ImGui::MenuItem("Material")) state.panels.open(*state.panels.find("tab.material"));
  if (node.light >= 0 && ImGui::MenuItem("Light")) state.panels.open(*state.panels.find("tab.light"));
  if (ImGui::MenuItem("Copy name")) state.platform.set_clipboard(node.name);
  ImGui::EndPopup();
}

// The label of a node in the tree, with room for its symbol, which is drawn afterwards.
bool draw_tree_item(AppState& state, const scene::Scene& scene, int index, ImGuiTreeNodeFlags flags) {
  const auto& node = scene.nodes[static_cast<size_t>(index)];
  const ImVec2 corner = ImGui::GetCursorScreenPos();
  const float height = ImGui::GetTextLineHeight();
  const int spaces = static_cast<int>(std::ceil(1.3f * height / ImGui::CalcTextSize(" ").x));
  if (!node.visible) ImGui::PushStyleColor(ImGuiCol_Text, state.ui.theme.secondary_text);
  const bool open = ImGui::TreeNodeEx("##node", flags, "%*s%s", spaces, "", node_name(scene, index).c_str());
  const Vec2 centre(corner.x + ImGui::GetTreeNodeToLabelSpacing() + 0.5f * height,
                    0.5f * (ImGui::GetItemRectMin().y + ImGui::GetItemRectMax().y));
  const ImU32 color = ImGui::GetColorU32(node.visible ? state.ui.theme.accent : state.ui.theme.secondary_text);
  draw_object_shape(*ImGui::GetWindowDrawList(), kind_of(node), centre, 0.5f * height, color);
  if (!node.visible) ImGui::PopStyleColor();
  return open;
}

// A node that is dropped on another one becomes its child.
void drag_to_parent(AppState& state, const scene::Scene& scene, int index) {
  constexpr const char* kPayload = "node";
  if (ImGui::BeginDragDropSource()) {
    ImGui::SetDragDropPayload(kPayload, &index, sizeof index);
    ImGui::TextUnformatted(("Make child: " + node_name(scene, index)).c_str());
    ImGui::EndDragDropSource();
  }
  if (!ImGui::BeginDragDropTarget()) return;
  if (const ImGuiPayload* payload = ImGui::AcceptDragDropPayload(kPayload))
    set_parent(state, {*static_cast<const int*>(payload->Data)}, index);
  ImGui::EndDragDropTarget();
}

// A node and its children. The node `scroll_to` is brought on screen; -1: none.
void draw_node(AppState& state, const scene::Scene& scene, const TreeFilter& filter, int index, int scroll_to) {
  if (!filter.shows(index)) return;
  const auto& node = scene.nodes[static_cast<size_t>(index)];
  const std::string section = "node." + std::to_string(index);
  const int selected = state.selection.node;
  ImGui::PushID(index);
  visibility_checkbox(state, node, section);
  ImGui::SameLine();
  ImGuiTreeNodeFlags flags =
      ImGuiTreeNodeFlags_OpenOnArrow | ImGuiTreeNodeFlags_SpanAvailWidth | ImGuiTreeNodeFlags_DefaultOpen;
  if (node.children.empty()) flags |= ImGuiTreeNodeFlags_Leaf | ImGuiTreeNodeFlags_NoTreePushOnOpen;
  if (is_selected(state, index)) flags |= ImGuiTreeNodeFlags_Selected;
  if (selected >= 0 && is_ancestor(scene, index, selected)) ImGui::SetNextItemOpen(true, ImGuiCond_Once);
  if (filter.is_active()) ImGui::SetNextItemOpen(true);
  const bool open = draw_tree_item(state, scene, index, flags);
  if (ImGui::IsItemClicked() && !ImGui::IsItemToggledOpen()) {
    if (state.ui.input.control())
      toggle_selected(state, index, -1);
    else
      state.select(index, -1);
  }
  drag_to_parent(state, scene, index);
  if (index == scroll_to && !ImGui::IsItemVisible()) ImGui::SetScrollHereY();
  state.ui.items.add("scene." + section);
  draw_node_menu(state, node, index);
  if (ImGui::IsItemHovered()) tooltip(state.ui, std::string(label_of(kind_of(node))) + ", " + section);
  if (open && !node.children.empty()) {
    for (const int child : node.children) draw_node(state, scene, filter, child, scroll_to);
    ImGui::TreePop();
  }
  ImGui::PopID();
}

class ScenePanel final : public Panel {
 public:
  PanelInfo info() const override {
    return {.name = "tab.scene",
            .label = "Scene",
            .description = "Objects of the scene: selection, visibility and transforms",
            .place = PanelPlace::right_column};
  }

  void draw(AppState& state) override {
    // The widgets may replace the scene of the document while the tree is drawn.
    const auto scene = state.document().scene;
    section_widgets(state, "scene");
    if (const auto compiled = state.session->scene()) draw_counts(state.ui, compiled);
    const int selected = state.selection.node;
    const bool has_selection = selected >= 0 && static_cast<size_t>(selected) < scene->nodes.size();
    if (group(state.ui, "Objects", "")) {
      const float height = tree_height(has_selection);
      ImGui::BeginChild("##tree", {0, height});
      const bool is_new = std::exchange(last_selected_, selected) != selected;
      const bool is_smaller = std::exchange(last_height_, height) > height;
      const int scroll_to = is_new || is_smaller ? selected : -1;
      tree_filter_.update(scene, state.ui.filter);
      for (const int root : scene->roots) draw_node(state, *scene, tree_filter_, root, scroll_to);
      if (!tree_filter_.shows_any()) note(state.ui, "No object contains the filter.");
      tree_content_height_ = ImGui::GetCursorPosY();
      ImGui::EndChild();
    }
    if (!has_selection) return;
    const float top = ImGui::GetCursorPosY();
    if (group(state.ui, node_name(*scene, selected).c_str(), "node.")) draw_selected_node(state, *scene, selected);
    selection_height_ = ImGui::GetCursorPosY() - top;
  }

  void report(AppState& state, nlohmann::json& json) override {
    const auto compiled = state.has_document() ? state.session->scene() : nullptr;
    json["lights"] = compiled ? nlohmann::json(scene::light_text(scene::count_lights(*compiled))) : nlohmann::json();
  }

  std::vector<ItemInfo> items() const override {
    return {{"scene.node.N", "Object", "Selects node N"},
            {"scene.node.N.visible", "Visible", "Shows or hides node N"},
            {kNameItem, "Name", "Name of the selected object"}};
  }

  bool reveal_parameter(AppState& state, const std::string& name) override {
    if (name.starts_with("scene.") || name == kNameItem) return true;
    const auto index = object_index(name, "node");
    if (index) {
      state.selection.node = *index;
      state.selection.others.clear();
    }
    return index.has_value();
  }

 private:
  // With a selection, the tree has the height of its lines, so that the section of the selected object follows at once. A
  // long tree leaves room for the first lines of that section. Both heights are those of the last frame.
  float tree_height(bool has_selection) const {
    constexpr float kLinesOfTree = 6, kLinesOfSelection = 6.5f;
    const float smallest = ImGui::GetFrameHeight() * kLinesOfTree;
    const float reserved =
        has_selection ? std::min(selection_height_, ImGui::GetFrameHeightWithSpacing() * kLinesOfSelection) : 0;
    const float available = std::max(ImGui::GetContentRegionAvail().y - reserved, smallest);
    return has_selection ? std::clamp(tree_content_height_, smallest, available) : available;
  }

  void draw_counts(const UiContext& ui, const std::shared_ptr<const scene::CompiledScene>& compiled) {
    if (counted_.lock() != compiled) {
      counted_ = compiled;
      light_text_ = scene::light_text(scene::count_lights(*compiled));
    }
    labelled_value(ui, "Triangles", std::to_string(compiled->triangle_count()), "Triangles of all visible objects");
    labelled_value(ui, "Lights", light_text_, "Each object counts once, however many emissive triangles it has");
  }

  std::weak_ptr<const scene::CompiledScene> counted_;  // the scene of light_text_
  std::string light_text_;
  TreeFilter tree_filter_;
  int last_selected_ = -1;  // node
  float last_height_ = 0;   // of the tree
  float tree_content_height_ = 0, selection_height_ = 0;
};

}  // namespace

std::unique_ptr<Panel> make_scene_panel() { return std::make_unique<ScenePanel>(); }

}  // namespace etendue::viewer
