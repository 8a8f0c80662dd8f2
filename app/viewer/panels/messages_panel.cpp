// All messages, warnings and errors since the start, oldest first.
#include <imgui.h>
#include <imgui_stdlib.h>

#include "viewer/actions/action.h"
#include "viewer/panels/panel.h"
#include "viewer/platform/platform.h"
#include "viewer/state/app_state.h"
#include "viewer/widgets/action_widgets.h"
#include "viewer/widgets/basic_widgets.h"
#include "viewer/widgets/status_icon.h"
#include "viewer/widgets/unicode.h"

namespace etendue::viewer {
namespace {

constexpr const char* kFilterItem = "messages.filter";

std::string log_text(const Notices& notices) {
  std::string text;
  for (const auto& entry : notices.log()) text += entry.time + "  " + entry.text + "\n";
  return text;
}

class MessagesPanel final : public Panel {
 public:
  PanelInfo info() const override {
    return {.name = "panel.messages",
            .label = "Messages",
            .description = "All messages, warnings and errors since the start",
            .place = PanelPlace::bottom};
  }

  void draw(AppState& state) override {
    const auto& log = state.notices.log();
    if (log.empty()) return note(state.ui, "There are no messages.");
    action_button(state, "messages.copy");
    ImGui::SameLine();
    action_button(state, "messages.clear");
    ImGui::SameLine();
    draw_filter(state);
    ImGui::BeginChild("##log");
    const bool follows = ImGui::GetScrollY() >= ImGui::GetScrollMaxY();
    for (const auto& entry : log) {
      if (!contains_ignoring_case(entry.text, filter_)) continue;
      if (entry.is_error)
        status_icon(state.ui, Status::bad);
      else
        ImGui::Dummy({ImGui::GetTextLineHeight(), ImGui::GetTextLineHeight()});
      ImGui::SameLine();
      ImGui::PushFont(state.ui.fonts.monospace);
      ImGui::TextDisabled("%s", entry.time.c_str());
      ImGui::PopFont();
      ImGui::SameLine();
      ImGui::PushTextWrapPos(0);
      ImGui::TextColored(entry.is_error ? state.ui.theme.warning : state.ui.theme.text, "%s", entry.text.c_str());
      ImGui::PopTextWrapPos();
    }
    if (follows) ImGui::SetScrollHereY(1);
    ImGui::EndChild();
  }

  bool reveal_parameter(AppState&, const std::string& name) override { return name == kFilterItem; }

  void add_actions(ActionList& actions) override {
    const auto has_messages = [](const AppState& state) { return !state.notices.log().empty(); };
    actions.add({.name = "messages.copy",
                 .label = "Copy messages",
                 .tooltip = "Copies all messages to the clipboard",
                 .run = [](AppState& state) { state.platform.set_clipboard(log_text(state.notices)); },
                 .enabled = has_messages});
    actions.add({.name = "messages.clear",
                 .label = "Clear messages",
                 .tooltip = "Removes all messages from this list",
                 .run = [](AppState& state) { state.notices.clear_log(); },
                 .enabled = has_messages});
  }

 private:
  void draw_filter(AppState& state) {
    ImGui::SetNextItemWidth(-1);
    ImGui::InputTextWithHint("##filter", "Filter messages", &filter_);
    state.ui.items.add(kFilterItem);
    if (const auto text = state.ui.items.take_request(kFilterItem)) {
      filter_ = *text;
      state.ui.items.answer("");
    }
  }

  std::string filter_;
};

}  // namespace

std::unique_ptr<Panel> make_messages_panel() { return std::make_unique<MessagesPanel>(); }

}  // namespace etendue::viewer
