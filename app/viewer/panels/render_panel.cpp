// The integrator and the sampler, when rendering stops, the recommendation, the film, and the features in use.
#include <imgui.h>

#include <algorithm>
#include <cctype>
#include <nlohmann/json.hpp>

#include "advisor/missing_paths.h"
#include "integrator/integrator.h"
#include "render/session.h"
#include "viewer/actions/action.h"
#include "viewer/panels/object_names.h"
#include "viewer/panels/panel.h"
#include "viewer/panels/recommendation_section.h"
#include "viewer/state/app_state.h"
#include "viewer/state/document_info.h"
#include "viewer/state/editor.h"
#include "viewer/tasks/automatic_task.h"
#include "viewer/tasks/exclusive_task.h"
#include "viewer/tasks/missing_paths_task.h"
#include "viewer/tasks/path_class_task.h"
#include "viewer/widgets/action_widgets.h"
#include "viewer/widgets/basic_widgets.h"
#include "viewer/widgets/parameter_widgets.h"
#include "viewer/widgets/value_text.h"

namespace etendue::viewer {
namespace {

const std::vector<std::string> kLimits{"samples", "seconds", "error", "error-measure"};

// A list in the registry may or may not end with a full stop.
std::string sentence(const std::string& text) { return text.ends_with('.') ? text : text + "."; }

// Statistics that the integrator reports about its own work, such as an acceptance rate.
void integrator_statistics(AppState& state) {
  const auto status = state.session->status();
  if (status.version != state.editor->version()) return;
  for (const std::string& text : status.notes) warning(state.ui, sentence(text));
  if (!status.notes.empty()) state.ui.items.add("render.notes");
  for (const auto& statistic : status.statistics) {
    const std::string value = formatted("%.4g ", statistic.value) + statistic.unit;
    labelled_value(state.ui, label_of_name(statistic.name).c_str(), value, statistic.doc.c_str());
    state.ui.items.add("statistic." + statistic.name);
  }
}

class RenderPanel final : public Panel {
 public:
  PanelInfo info() const override {
    return {.name = "tab.render",
            .label = "Render",
            .description = "Integrator, sampler, stopping criteria and image size",
            .place = PanelPlace::right_column};
  }

  void draw(AppState& state) override {
    action_button(state, "render.pause");
    ImGui::SameLine();
    action_button(state, "render.restart");
    ImGui::SameLine();
    action_button(state, "snapshot.save");
    if (group(state.ui, "Method", "render.")) draw_method(state);
    if (group(state.ui, "Stop at", "render.")) section_widgets_for(state, "render", kLimits);
    recommendation_.draw(state);
    if (group(state.ui, "Image", "film.")) {
      section_widgets(state, "film");
      action_button(state, "view.fit");
    }
    if (group(state.ui, "Features", "model.", false)) draw_features(state);
  }

  std::vector<ParameterInfo> parameters() const override { return recommendation_.parameters(); }
  std::optional<Value> default_value(const AppState& state, const std::string& name) const override {
    return recommendation_.default_value(state, name);
  }
  std::vector<ItemInfo> items() const override { return recommendation_.items(); }
  void add_actions(ActionList& actions) override {
    recommendation_.add_actions(actions);
    actions.add({.name = "integrator.choose-again",
                 .menu = "Integrator",
                 .label = "Choose again",
                 .tooltip = "Compares the integrators for the present view and changes to the best one",
                 .run = [this](AppState& state) { automatic_.repeat(state.task_context); },
                 .enabled =
                     [this](const AppState& state) {
                       return state.has_document() && state.document().automatic.enabled && !automatic_.running();
                     }});
  }

  std::vector<WaitCondition> wait_conditions() override {
    const auto check = [this](AppState& state, std::optional<uint32_t>) -> StepStatus {
      if (!state.panels.is_open(*this))
        return {.error =
                    "missing paths are measured while the Render panel is open; "
                    "click tab.render first"};
      return {.done = missing_paths(state) != nullptr};
    };
    const auto check_automatic = [](AppState& state, std::optional<uint32_t>) -> StepStatus {
      if (!state.document().automatic.enabled)
        return {.error = "the integrator is not chosen automatically; set render.integrator to auto first"};
      return {.done = !state.document().automatic.is_pending()};
    };
    return {recommendation_.wait_condition(),
            {.name = "misses", .check = check},
            {.name = "automatic", .check = check_automatic}};
  }

  void report(AppState& state, nlohmann::json& json) override {
    json["advice"] = recommendation_.report(state);
    json["automatic"] = nullptr;
    if (state.has_document() && state.document().automatic.enabled)
      json["automatic"] = {{"integrator", state.document().method.integrator},
                           {"reason", state.document().automatic.reason},
                           {"running", automatic_.running()}};
    json["misses"] = nullptr;
    if (const auto* missing = missing_paths(state)) json["misses"] = missing->share;
  }

  bool reveal_parameter(AppState& state, const std::string& name) override {
    const std::string section = name.substr(0, name.find('.'));
    // The integrator "light" has the name of the sections of lights, "light.0", and of the Light panel's own parameters.
    const bool is_method = !object_index(name, section) &&
                           (integrator::find_integrator(section) || find_sampler(section)) && state.has_document() &&
                           render::get(state.document(), name);
    return is_method || section == "render" || section == "auto" || section == "film" || section == "model" ||
           Panel::reveal_parameter(state, name);
  }

  void update(AppState& state) override {
    recommendation_.task().update(state.task_context);
    automatic_.update(state.task_context);
    const PathClassTask& path_classes = *state.tasks.path_classes;
    const bool is_known = state.has_document() && path_classes.is_current(state.document());
    const bool is_busy = state.tasks.exclusive->running() || path_classes.running();
    missing_paths_.update(state.task_context, state.is_visible(*this) && !is_busy && !is_known);
  }

  std::vector<Task*> tasks() override { return {&recommendation_.task(), &automatic_, &missing_paths_}; }

 private:
  // What the integrator misses of the current view; null while that is unknown.
  const advisor::MissingPaths* missing_paths(AppState& state) {
    if (!state.has_document()) return nullptr;
    PathClassTask& path_classes = *state.tasks.path_classes;
    if (path_classes.is_current(state.document())) return &path_classes.coverage(state.task_context).missing_paths;
    return missing_paths_.result_for(state.document());
  }

  void draw_method(AppState& state) {
    section_widgets_for(state, "render", {"integrator"});
    if (state.document().automatic.enabled) draw_automatic(state);
    // The widgets may replace the document, so the names are read after each of them.
    if (const auto* info = integrator::find_integrator(state.document().method.integrator)) {
      draw_integrator_description(state, *info);
      section_widgets(state, info->name);
      integrator_statistics(state);
    }
    ImGui::Spacing();
    section_widgets_for(state, "render", {"sampler"});
    if (const auto* info = find_sampler(state.document().method.sampler)) {
      note(state.ui, info->doc);
      section_widgets(state, info->name);
    }
    section_widgets_except(state, "render", {"integrator", "sampler", "samples", "seconds", "error", "error-measure"});
  }

  // The settings of the automatic choice, its result and its reason.
  void draw_automatic(AppState& state) {
    section_widgets(state, "auto");
    const render::AutomaticMethod& automatic = state.document().automatic;
    if (automatic_.running())
      note(state.ui, formatted("Comparing integrators, %.0f %%", 100 * automatic_.progress()));
    else if (automatic.is_pending())
      note(state.ui,
           "The integrator is chosen when the image has rested for a moment. Until then, it is rendered with " +
               integrator_label(state.document().method.integrator) + ".");
    else
      note(state.ui, "Chosen: " + integrator_label(state.document().method.integrator) + ". " + automatic.reason + ".");
    action_button(state, "integrator.choose-again");
  }

  void draw_integrator_description(AppState& state, const integrator::IntegratorInfo& info) {
    const UiContext& ui = state.ui;
    note(ui, info.summary);
    if (!info.paths.empty()) {
      ImGui::PushFont(ui.fonts.monospace);
      note(ui, info.paths + "  " + std::string(integrator::bias_name(info.bias)));
      ImGui::PopFont();
      if (ImGui::IsItemHovered())
        tooltip(ui,
                "The light paths that the integrator finds, from the camera (E) to the light (L); surfaces are "
                "diffuse (D), glossy (G) or specular (S)");
    }
    ImGui::PushFont(ui.fonts.small);
    note(ui, "Cost: " + sentence(info.cost));
    note(ui, "Limitations: " + sentence(info.limitations));
    ImGui::PopFont();
    const advisor::MissingPaths* missing = missing_paths(state);
    if (const std::string incompatibility = state.incompatibility(); !incompatibility.empty())
      warning(ui, sentence(with_labels(state.document(), incompatibility).text));
    else if (missing && !missing->none())
      warning(ui, "In this view, the integrator " + advisor::missing_paths_text(*missing) + ".");
    state.ui.items.add("render.misses");
  }

  static void draw_features(AppState& state) {
    note(state.ui,
         "Feature specialization: Auto enables only the features that the scene uses. On enables a feature always.");
    section_widgets(state, "model");
    const auto model = state.session->model();
    for (const auto& decision : model.decisions)
      note(state.ui, label_of_name(decision.flag) + ": " + decision.value + ". " + decision.reason);
  }

  RecommendationSection recommendation_;
  AutomaticTask automatic_;
  MissingPathsTask missing_paths_;
};

}  // namespace

std::unique_ptr<Panel> make_render_panel() { return std::make_unique<RenderPanel>(); }

}  // namespace etendue::viewer
