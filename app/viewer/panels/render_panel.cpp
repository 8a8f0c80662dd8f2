// Which method makes the picture, what can it find, and when does it stop?
#include <imgui.h>

#include <algorithm>
#include <cctype>

#include "advisor/missing_paths.h"
#include "integrator/integrator.h"
#include "viewer/layout/interface.h"
#include "viewer/widgets/format.h"
#include "viewer/widgets/parameter_widgets.h"

namespace etendue::viewer {
namespace {

void about_integrator(Workbench& w, const integrator::IntegratorInfo& info) {
  note(w, info.summary);
  if (!info.paths.empty()) {
    ImGui::PushFont(w.faces.figures);
    note(w, info.paths + "  " + std::string(integrator::bias_name(info.bias)));
    ImGui::PopFont();
    if (ImGui::IsItemHovered())
      tooltip(w,
              "The light paths it finds, from the light (L) over diffuse (D), glossy (G) and specular (S) surfaces to "
              "the eye (E)");
  }
  ImGui::PushFont(w.faces.small);
  note(w, "Cost: " + info.cost + ".");
  note(w, "Hard for it: " + info.limitations + ".");
  ImGui::PopFont();
  // What was measured of this very view says more than what holds for all.
  if (const std::string incompatibility = w.incompatibility(); !incompatibility.empty())
    warning(w, incompatibility + ".");
  else if (const auto* misses = w.misses(); misses && !misses->none())
    warning(w, "Here it " + advisor::sentence_of(*misses) + ".");
  w.items.place("render.misses");
}

// What the method knows of its own work.
void statistics(Workbench& w) {
  const auto status = w.session.status();
  if (status.version != w.editor.version()) return;
  for (const auto& statistic : status.statistics) {
    std::string label = statistic.name;
    std::ranges::replace(label, '-', ' ');
    label[0] = static_cast<char>(std::toupper(static_cast<unsigned char>(label[0])));
    figure(w, label.c_str(), text_of("%.4g ", statistic.value) + statistic.unit);
    if (ImGui::IsItemHovered()) tooltip(w, statistic.doc);
    w.items.place("statistic." + statistic.name);
  }
}

}  // namespace

void draw_render_panel(Workbench& w) {
  const auto& method = w.editor.document().method;
  action_button(w, "render.pause");
  ImGui::SameLine();
  action_button(w, "render.restart");
  ImGui::SameLine();
  action_button(w, "snapshot.save");

  if (group(w, "Method", "render.")) {
    some_widgets(w, "render", {"integrator"});
    if (const auto* info = integrator::find_integrator(method.integrator)) {
      about_integrator(w, *info);
      section_widgets(w, info->name);
      statistics(w);
    }
    ImGui::Spacing();
    some_widgets(w, "render", {"sampler"});
    if (const auto* info = find_sampler(method.sampler)) {
      note(w, info->doc);
      section_widgets(w, info->name);
    }
    other_widgets(w, "render", {"integrator", "sampler", "samples", "seconds", "error"});
  }
  if (group(w, "Stop at", "render.")) some_widgets(w, "render", {"samples", "seconds", "error"});
  draw_advice(w);
  if (group(w, "Picture", "film.")) {
    section_widgets(w, "film");
    action_button(w, "view.fit");
  }
  if (group(w, "Model", "model.", false)) {
    note(w, "The program runs no more physics than the scene needs. A flag that is on runs it all the same.");
    section_widgets(w, "model");
    const auto model = w.session.model();
    for (const auto& decision : model.decisions)
      note(w, decision.flag + ": " + decision.value + ". " + decision.reason);
  }
}

}  // namespace etendue::viewer
