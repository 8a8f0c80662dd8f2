// How radiance is displayed: exposure, tone mapping, false colours and AOVs. Nothing here changes the rendering.
#include <imgui.h>

#include <cctype>
#include <nlohmann/json.hpp>

#include "render/document.h"
#include "render/session.h"
#include "scene/compiled_scene.h"
#include "viewer/panels/panel.h"
#include "viewer/state/app_state.h"
#include "viewer/viewport/aov_layer.h"
#include "viewer/widgets/action_widgets.h"
#include "viewer/widgets/basic_widgets.h"
#include "viewer/widgets/parameter_widgets.h"
#include "viewer/widgets/value_text.h"

namespace etendue::viewer {
namespace {

// The option that stands for the image itself; a stable name for scripts.
constexpr const char* kImageOption = "picture";

ParameterInfo false_color_parameter(bool value) {
  ParameterInfo info;
  info.name = "view.false-color";
  info.label = "False colour";
  info.doc = "Shows the luminance on a logarithmic scale, in a palette that is safe for colour-blind users";
  info.type = ParameterType::toggle;
  info.default_value = value;
  return info;
}

// Of a scene; null: with all AOVs.
ParameterInfo aov_parameter(const std::string& value, const scene::CompiledScene* scene = nullptr) {
  ParameterInfo info;
  info.name = "view.aov";
  info.label = "AOV";
  info.doc = "Shows another quantity of each pixel instead of the image. The rendering continues";
  info.type = ParameterType::choice;
  info.options = {kImageOption};
  info.option_labels = {"Beauty"};
  for (const std::string& name : aov_layer_names(scene)) {
    info.options.push_back(name);
    info.option_labels.push_back(label_of_name(name));
  }
  info.default_value = value.empty() ? std::string(kImageOption) : value;
  return info;
}

class DisplayPanel final : public Panel {
 public:
  PanelInfo info() const override {
    return {.name = "tab.display",
            .label = "Display",
            .description = "Exposure, tone mapping, false colours and AOVs",
            .place = PanelPlace::right_column};
  }

  void draw(AppState& state) override {
    if (group(state.ui, "Tone mapping", "")) draw_tone_mapping(state);
    if (group(state.ui, "View", "view.")) draw_view(state);
    if (group(state.ui, "Image", "")) draw_image_size(state);
  }

  std::vector<ParameterInfo> parameters() const override { return {false_color_parameter(false), aov_parameter("")}; }

  bool reveal_parameter(AppState& state, const std::string& name) override {
    return name == "camera.exposure" || name.starts_with("display.") || Panel::reveal_parameter(state, name);
  }

  void report(AppState& state, nlohmann::json& json) override {
    json["parameters"]["view.false-color"] = state.viewport.false_color;
    json["parameters"]["view.aov"] = state.viewport.aov_name.empty() ? kImageOption : state.viewport.aov_name;
  }

 private:
  static void draw_tone_mapping(AppState& state) {
    section_widgets_for(state, "camera", {"exposure"});
    action_button(state, "display.darker");
    ImGui::SameLine();
    action_button(state, "display.brighter");
    action_button(state, "display.auto-exposure");
    section_widgets(state, "display");
  }

  static void draw_view(AppState& state) {
    ViewportState& viewport = state.viewport;
    if (const auto value = parameter_widget(state, false_color_parameter(viewport.false_color)))
      viewport.false_color = std::get<bool>(*value);
    if (const auto value = parameter_widget(state, aov_parameter(viewport.aov_name, state.session->scene().get())))
      viewport.aov_name = to_string(*value) == kImageOption ? "" : to_string(*value);
    if (viewport.aov_name.empty()) return;
    note(state.ui, viewport.aov->is_busy() ? "Computing the AOV." : "The rendering continues in the background.");
  }

  static void draw_image_size(AppState& state) {
    const auto& d = state.document();
    const auto width = static_cast<double>(state.viewport.image.size.x);
    labelled_value(state.ui, "Resolution", formatted("%d x %d", d.width, d.height));
    labelled_value(state.ui, "Zoom", formatted("%.0f %%", 100 * width / d.width));
    action_button(state, "snapshot.save");
    ImGui::SameLine();
    action_button(state, "snapshot.save-as");
  }
};

}  // namespace

std::unique_ptr<Panel> make_display_panel() { return std::make_unique<DisplayPanel>(); }

}  // namespace etendue::viewer
