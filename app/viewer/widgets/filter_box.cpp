#include "viewer/widgets/filter_box.h"

#include <imgui.h>
#include <imgui_stdlib.h>

#include "viewer/state/app_state.h"
#include "viewer/widgets/value_text.h"

namespace etendue::viewer {

void filter_box(UiContext& ui, const std::string& item, const char* hint, std::string& filter) {
  const bool has_text = !filter.empty();
  const float button_width = ImGui::CalcTextSize("Clear").x + 2 * ImGui::GetStyle().FramePadding.x;
  ImGui::SetNextItemWidth(has_text ? -button_width - ImGui::GetStyle().ItemSpacing.x : -1);
  ImGui::InputTextWithHint("##filter", hint, &filter);
  ui.items.add(item);
  if (const auto text = ui.items.take_request(item)) {
    filter = *text;
    ui.items.answer("");
  }
  if (!has_text) return;
  ImGui::SameLine();
  if (ImGui::Button("Clear")) filter.clear();
  ui.items.add(item + ".clear");
}

void filtered_parameters(AppState& state, const std::function<void()>& draw) {
  filter_box(state.ui, "layout.bottom-filter", "Filter parameters", state.interface.bottom_filter);
  state.ui.filter = lower_case(state.interface.bottom_filter);
  draw();
  state.ui.filter.clear();
}

}  // namespace etendue::viewer
