#include "viewer/layout/palette_entries.h"

#include <iterator>
#include <optional>

#include "render/document.h"
#include "viewer/layout/preferences_dialog.h"
#include "viewer/state/app_state.h"
#include "viewer/state/document_info.h"
#include "viewer/state/preferences.h"
#include "viewer/widgets/parameter_field.h"

namespace etendue::viewer {
namespace {

void add_actions(const AppState& state, std::vector<PaletteEntry>& entries) {
  for (const Action& action : state.actions.all()) {
    if (!action.is_enabled(state)) continue;
    entries.push_back({.name = action.name,
                       .label = action.label,
                       .place = action.submenu.empty() ? action.menu : action.submenu,
                       .keys = label(action.chords()),
                       .tooltip = action.tooltip,
                       .run = action.run});
  }
}

// How the parameters of a list are shown and set.
struct ParameterCommands {
  void (*show)(AppState& state, const std::string& name);
  void (*set)(AppState& state, const std::string& name, const Value& value);
};

constexpr ParameterCommands kDocument{
    .show = [](AppState& state, const std::string& name) { state.show_parameter(name); },
    .set = [](AppState& state, const std::string& name, const Value& value) { state.set_parameter(name, value); }};
constexpr ParameterCommands kPreference{.show = show_preference, .set = set_preference};
// Only the widget in the panel sets the value.
constexpr ParameterCommands kPanel{.show = kDocument.show,
                                   .set = [](AppState& state, const std::string& name, const Value& value) {
                                     state.show_parameter(name);
                                     state.ui.items.point_out(name, to_string(value));
                                   }};

// Parameters, and the options of those that are choices.
class ParameterEntries {
 public:
  void add(const ParameterInfo& info, const std::string& place, const std::string& value,
           const ParameterCommands& commands) {
    parameters_.push_back({.name = info.name,
                           .label = info.label,
                           .place = place,
                           .keys = value,
                           .tooltip = info.doc,
                           .run = [name = info.name, show = commands.show](AppState& s) { show(s, name); }});
  }

  // All options but the current one, if that is known.
  void add_options(const ParameterInfo& info, const std::string& place, const std::optional<Value>& current,
                   const ParameterCommands& commands) {
    for (size_t i = 0; i < info.options.size(); ++i) {
      const Value value = info.options[i];
      if (value == current) continue;
      options_.push_back({.name = info.name + "=" + info.options[i],
                          .label = info.label + ": " + info.option_labels[i],
                          .place = place,
                          .tooltip = info.doc,
                          .run = [name = info.name, value, set = commands.set](AppState& s) { set(s, name, value); }});
    }
  }

  void append_to(std::vector<PaletteEntry>& entries) {
    for (auto* list : {&parameters_, &options_})
      entries.insert(entries.end(), std::make_move_iterator(list->begin()), std::make_move_iterator(list->end()));
  }

 private:
  std::vector<PaletteEntry> parameters_, options_;
};

void add_document(const render::Document& document, ParameterEntries& entries) {
  for (const auto& section : render::sections(document)) {
    const std::string place = section_label(document, section);
    for (const auto& parameter : render::section_parameters(document, section)) {
      const ParameterInfo& info = parameter.info;
      entries.add(info, place, value_label(info, info.default_value), kDocument);
      if (parameter.inactive_reason.empty()) entries.add_options(info, place, info.default_value, kDocument);
    }
  }
}

// Panels do not give the current values of their parameters.
void add_panels(const PanelSet& panels, ParameterEntries& entries) {
  for (const auto& panel : panels.all()) {
    for (const ParameterInfo& info : panel->parameters()) {
      const std::string place = panel->place_of(info.name);
      entries.add(info, place, "", kPanel);
      entries.add_options(info, place, std::nullopt, kPanel);
    }
  }
}

void add_preferences(const Settings& settings, ParameterEntries& entries) {
  const std::string place = "Preferences";
  for (const ParameterInfo& info : all_preferences(settings)) {
    entries.add(info, place, value_label(info, info.default_value), kPreference);
    const bool is_folder = info.validate_text != nullptr;
    if (!is_folder) entries.add_options(info, place, info.default_value, kPreference);
  }
}

PaletteEntry keyboard_entry() {
  return {.name = "preferences.keyboard",
          .label = "Edit keyboard shortcuts",
          .place = "Preferences",
          .tooltip = "Opens the list of all keyboard shortcuts",
          .run = [](AppState& state) {
            state.interface.preferences_open = true;
            state.interface.keyboard_is_requested = true;
          }};
}

}  // namespace

std::vector<PaletteEntry> palette_entries(const AppState& state) {
  std::vector<PaletteEntry> entries;
  add_actions(state, entries);
  entries.push_back(keyboard_entry());
  ParameterEntries parameters;
  if (state.has_document()) {
    add_document(state.document(), parameters);
    add_panels(state.panels, parameters);
  }
  add_preferences(state.settings, parameters);
  parameters.append_to(entries);
  return entries;
}

}  // namespace etendue::viewer
