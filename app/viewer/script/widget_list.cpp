// The list of everything that scripts can name: actions, panels, items and parameters.
#include <nlohmann/json.hpp>

#include "render/document.h"
#include "viewer/actions/action.h"
#include "viewer/actions/all_actions.h"
#include "viewer/panels/panel_set.h"
#include "viewer/panels/registry.h"
#include "viewer/state/preferences.h"
#include "viewer/state/settings.h"
#include "viewer/viewer.h"
#include "viewer/widgets/vector_widgets.h"

namespace etendue::viewer {
namespace {

using nlohmann::json;

json describe_parameter(const ParameterInfo& p) {
  json j{{"name", p.name},
         {"label", p.label},
         {"type", type_name(p.type)},
         {"unit", p.unit},
         {"min", nullptr},
         {"max", nullptr},
         {"default", to_json_value<json>(p.default_value)},
         {"doc", p.doc}};
  if (p.type == ParameterType::integer || p.type == ParameterType::number) {
    j["min"] = p.min;
    j["max"] = p.max;
  }
  if (p.type == ParameterType::choice) j["options"] = p.options;
  return j;
}

json parameter_entry(const ParameterInfo& p) {
  return {{"name", p.name},
          {"label", p.label},
          {"doc", p.doc},
          {"kind", "parameter"},
          {"parameters", json::array({describe_parameter(p)})}};
}

json item_entry(const std::string& name, const std::string& label, const std::string& description) {
  return {{"name", name}, {"label", label}, {"doc", description}, {"kind", "item"}, {"parameters", json::array()}};
}

// Items of the layout and the viewport. The items of panels are listed by the panels.
const std::vector<ItemInfo>& layout_items() {
  static const std::vector<ItemInfo> items{
      {"menu.file", "File", "Opens the File menu"},
      {"menu.edit", "Edit", "Opens the Edit menu"},
      {"menu.view", "View", "Opens the View menu"},
      {"menu.compare", "Compare", "Opens the Compare menu"},
      {"menu.integrator", "Integrator", "Opens the Integrator menu"},
      {"menu.render", "Render", "Opens the Render menu"},
      {"menu.help", "Help", "Opens the Help menu"},
      {"menu.palette", "Find a command", "Opens the command palette"},
      {"layout.column", "Splitter of the right column", "Drag to change the width; double-click to reset it"},
      {"layout.bottom-panel", "Upper side of the bottom panel", "Drag to change the height; double-click to reset it"},
      {"tab-menu.detach", "Detach", "Moves a panel into a window of its own, or returns it to its tab"},
      {"detached.PANEL", "Title of a detached panel", "Drag to move the window, such as detached.panel.histogram"},
      {"status.reliability", "Reliability", "Opens the Reliability panel"},
      {"compare.divider", "Divider", "Drag to move the border between A and B; double-click to centre it"},
      {"files.name", "File name", "The text field of the file dialog"},
      {"files.filter", "Filter names", "Shows only the names in the file dialog that contain this text"},
      {"files.accept", "Open or Save", "Accepts the file dialog"},
      {"files.format", "Format", "Opens the list of formats of a saved file"},
      {"files.format.EXTENSION", "Format", "Uses a format, such as files.format.png"},
      {"files.cancel", "Cancel", "Closes the file dialog"},
      {"help.close", "Close", "Closes the list of shortcuts"},
      {"help.all-shortcuts", "All shortcuts...", "Opens the list of all shortcuts in the preferences"},
      {"layout.more-tabs", "More panels", "Lists the tabs of the bottom panel that the window has no room for"},
      {"more-tabs.PANEL", "Hidden tab", "Opens a panel of that list, such as more-tabs.panel.messages"},
      {"detached.PANEL.filter", "Filter", "The filter of a detached panel, such as detached.tab.material.filter"},
      {"layout.filter", "Filter", "Shows only the parameters of the panel and the objects that contain this text"},
      {"messages.filter", "Filter messages", "Shows only the messages that contain this text"},
      {"layout.filter.clear", "Clear", "Shows all parameters of the panel"},
      {"layout.bottom-filter", "Filter", "Shows only the parameters of the bottom panel that contain this text"},
      {"layout.bottom-filter.clear", "Clear", "Shows all parameters of the bottom panel"},
      {"timeline.fps", "Frame rate", "Frames per second of the timeline"},
      {"pixel-values.window", "Pixel values", "Drag to move the window; double-click to reset its place"},
      {"menu.reset", "Reset", "Resets the parameter whose context menu is open"},
      {"menu.copy-option", "Copy as command-line option", "Copies a parameter of the document as an option --set"},
      {"menu.copy", "Copy values", "Copies the values of a colour, a vector or a rotation"},
      {"menu.copy-text", "Copy as sRGB", "Copies a colour as a hexadecimal sRGB value"},
      {"incompatibility.NAME", "Set a parameter", "Shows the parameter that lets the integrator render the scene"},
      {"palette.selected", "Selected entry", "The entry of the command palette that Enter runs"},
      {"timeline.time", "Time", "Time at which the animations are evaluated"},
      {"notice.change", "Change...", "Opens the panel that a message refers to"},
      {"notice.close", "Close", "Closes a message"},
      {"notice.show-all", "Show all", "Opens the Messages panel"},
      {"preferences.close", "Close", "Closes the preferences"},
      {"preferences.keyboard", "Keyboard", "Shows the keyboard shortcuts in the preferences"},
      {"preferences.reset-shortcuts", "Reset all", "Resets all keyboard shortcuts"},
      {"preferences.clear-recent", "Clear recent files", "Clears the list of recent files"},
      {"preferences.snapshot-folder", "Snapshot folder", "Folder to which Save snapshot writes its images"},
      {"preferences.material-folder", "Material folder", "Folder of the material library"},
      {"preferences.scene-folder", "Scene folder", "Folder in which the dialog for opening scenes starts"},
      {"preferences.environment-folder", "Environment folder", "Folder in which the dialog for environment maps starts"},
      {"recovery.recover", "Recover", "Opens unsaved edits of a viewer that ended unexpectedly"},
      {"recovery.discard", "Discard", "Deletes unsaved edits of a viewer that ended unexpectedly"},
      {"recovery.later", "Decide at the next start", "Keeps unsaved edits and closes the question"},
      {"welcome.close", "Close", "Closes the welcome page"},
      {"welcome.show", "Show at the start", "Shows the welcome page when the viewer is started without a scene"},
      {"unsaved.save", "Save", "Saves the unsaved edits"},
      {"unsaved.discard", "Discard", "Discards the unsaved edits"},
      {"unsaved.cancel", "Cancel", "Continues with the current scene"},
      {"viewport-menu.hide", "Hide", "Hides the object under the pointer"},
      {"viewport-menu.focus", "Focus and orbit here", "Sets the focus distance and the centre of orbits"},
  };
  return items;
}

// A document that has at least one object of each kind that has parameters.
render::Document sample_document() {
  render::Document d;
  if (auto cornell = render::new_document("cornell")) d = std::move(*cornell);
  auto scene = std::make_shared<scene::Scene>(*d.scene);
  scene->lights.push_back(make_light("spot"));
  d.scene = std::move(scene);
  return d;
}

// Parameters of the document. Objects are represented by the first one of each kind: "material.0.roughness".
void append_document_parameters(json& list) {
  const auto document = sample_document();
  for (const auto& section : render::sections(document)) {
    const size_t dot = section.find('.');
    if (dot != std::string::npos && section.substr(dot + 1) != "0") continue;
    for (const auto& parameter : render::section_parameters(document, section))
      list.push_back(parameter_entry(parameter.info));
    if (!section.starts_with("node.")) continue;
    for (const auto& info : euler_parameters(section, Vec3(0))) list.push_back(parameter_entry(info));
  }
}

}  // namespace

std::string widgets_json() {
  const PanelSet panels(make_panels());
  ActionList actions;
  add_all_actions(actions, panels);
  json list = json::array();
  for (const auto& action : actions.all()) {
    json entry = item_entry(action.name, action.label, action.tooltip);
    entry["menu"] = action.menu;
    entry["submenu"] = action.submenu;
    entry["shortcut"] = json::array();
    for (const Chord& chord : action.chords()) entry["shortcut"].push_back(label(chord));
    list.push_back(entry);
  }
  for (const auto& panel : panels.all()) {
    const PanelInfo info = panel->info();
    list.push_back(item_entry(info.name, info.label, info.description));
  }
  for (const ItemInfo& item : layout_items()) list.push_back(item_entry(item.name, item.label, item.description));
  for (const auto& panel : panels.all()) {
    for (const ItemInfo& item : panel->items()) list.push_back(item_entry(item.name, item.label, item.description));
    for (const auto& info : panel->parameters()) list.push_back(parameter_entry(info));
  }
  for (const auto& info : interface_preferences(Settings())) list.push_back(parameter_entry(info));
  for (const auto& info : rendering_preferences(Settings())) list.push_back(parameter_entry(info));
  append_document_parameters(list);
  return list.dump(2);
}

}  // namespace etendue::viewer
