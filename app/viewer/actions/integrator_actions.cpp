// Selection of the integrator. The registry of integrators defines labels, groups and shortcuts.
#include "integrator/integrator.h"
#include "render/document.h"
#include "viewer/actions/all_actions.h"
#include "viewer/actions/conditions.h"

namespace etendue::viewer {
namespace {

constexpr const char* kIntegratorParameter = "render.integrator";

// The integrator that the user has selected: one of the registry, or "auto".
std::string selected_integrator(const render::Document& document) {
  return document.automatic.enabled ? render::kAutomatic : document.method.integrator;
}

void choose_integrator(AppState& state, const std::string& name) {
  if (name != selected_integrator(state.document())) state.set_parameter(kIntegratorParameter, name);
}

}  // namespace

void add_integrator_actions(ActionList& actions) {
  actions.add({.name = "render.previous",
               .menu = "Integrator",
               .label = "Previous integrator",
               .tooltip = "Switches between the last two integrators",
               .shortcut = "tab",
               .run = [](AppState& state) { choose_integrator(state, std::string(state.previous_integrator)); },
               .enabled = [](const AppState& state) { return !state.previous_integrator.empty(); }});
  actions.add({.name = "integrator.auto",
               .menu = "Integrator",
               .label = "Automatic",
               .tooltip = "Compares the integrators in short pilot renderings and uses the best one",
               .run = [](AppState& state) { choose_integrator(state, render::kAutomatic); },
               .enabled = has_document,
               .checked = [](const AppState& state) { return state.document().automatic.enabled; }});
  for (const auto& group : integrator::kGroups)
    for (const auto& info : integrator::integrator_infos()) {
      if (integrator::info_of(info.group).name != group.name) continue;
      actions.add({.name = "integrator." + info.name,
                   .menu = "Integrator",
                   .label = info.label,
                   .tooltip = info.summary,
                   .shortcut = info.shortcut ? std::string(1, info.shortcut) : "",
                   .run = [name = info.name](AppState& state) { choose_integrator(state, name); },
                   .enabled = has_document,
                   .checked = [name = info.name](
                                  const AppState& state) { return selected_integrator(state.document()) == name; },
                   .group = group.label,
                   .group_tooltip = group.doc});
    }
}

}  // namespace etendue::viewer
