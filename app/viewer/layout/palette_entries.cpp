#include "viewer/layout/palette_entries.h"

#include <utility>

#include "render/document.h"
#include "viewer/state/app_state.h"
#include "viewer/state/document_info.h"
#include "viewer/widgets/value_text.h"

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

// Numbers with as many digits as a user needs.
std::string short_value(const Value& value) {
  const auto* number = std::get_if<double>(&value);
  return number ? formatted("%.4g", *number) : to_string(value);
}

void add_parameter(const render::DocumentParameter& parameter, const std::string& place,
                   std::vector<PaletteEntry>& entries) {
  const ParameterInfo& info = parameter.info;
  entries.push_back({.name = info.name,
                     .label = info.label,
                     .place = place,
                     .keys = short_value(info.default_value),
                     .tooltip = info.doc,
                     .run = [name = info.name](AppState& s) { s.show_parameter(name); }});
}

void add_options(const render::DocumentParameter& parameter, const std::string& place,
                 std::vector<PaletteEntry>& entries) {
  const ParameterInfo& info = parameter.info;
  if (!parameter.inactive_reason.empty()) return;
  for (size_t i = 0; i < info.options.size(); ++i) {
    const Value value = info.options[i];
    if (value == info.default_value) continue;
    entries.push_back({.name = info.name + "=" + info.options[i],
                       .label = info.label + ": " + info.option_labels[i],
                       .place = place,
                       .tooltip = info.doc,
                       .run = [name = info.name, value](AppState& s) { s.set_parameter(name, value); }});
  }
}

}  // namespace

std::vector<PaletteEntry> palette_entries(const AppState& state) {
  std::vector<PaletteEntry> entries;
  add_actions(state, entries);
  if (!state.has_document()) return entries;
  const render::Document& document = state.document();
  std::vector<PaletteEntry> options;
  for (const auto& section : render::sections(document)) {
    const std::string place = section_label(document, section);
    for (const auto& parameter : render::section_parameters(document, section)) {
      add_parameter(parameter, place, entries);
      add_options(parameter, place, options);
    }
  }
  entries.insert(entries.end(), std::make_move_iterator(options.begin()), std::make_move_iterator(options.end()));
  return entries;
}

}  // namespace etendue::viewer
