// The contribution of each technique of a bidirectional integrator as a pyramid of small images.
#include <imgui.h>

#include <algorithm>
#include <cmath>
#include <nlohmann/json.hpp>

#include "base/number_text.h"
#include "advisor/report_numbers.h"
#include "integrator/bdpt/techniques.h"
#include "integrator/integrator.h"
#include "viewer/actions/action.h"
#include "viewer/panels/panel.h"
#include "viewer/platform/platform.h"
#include "viewer/state/app_state.h"
#include "viewer/state/document_info.h"
#include "viewer/tasks/exclusive_task.h"
#include "viewer/tasks/technique_task.h"
#include "viewer/widgets/action_widgets.h"
#include "viewer/widgets/basic_widgets.h"
#include "viewer/widgets/filter_box.h"
#include "viewer/widgets/image_tooltip.h"
#include "viewer/widgets/parameter_widgets.h"
#include "viewer/widgets/thumbnails.h"
#include "viewer/widgets/value_text.h"

namespace etendue::viewer {
namespace {

constexpr float kMaxImageWidth = 96;  // units of the interface
constexpr float kMinImageWidth = 48;

std::string bidirectional_integrators() {
  std::string labels;
  for (const auto& info : integrator::integrator_infos())
    if (!info.techniques.empty()) labels += (labels.empty() ? "" : ", ") + info.label;
  return labels;
}

std::string caption(const TechniqueImages& techniques, const TechniqueImage& image, bool disabled) {
  const std::string name = formatted("%d,%d", image.s, image.t);
  if (disabled) return name + "  off";
  const auto share = techniques.share(image);
  return share ? name + "  " + format_percent(*share) : name;
}

std::string technique_description(const TechniqueImages& techniques, const TechniqueImage& image, bool disabled) {
  std::string text = formatted("s = %d, t = %d: ", image.s, image.t) + describe_technique(image.s, image.t) + "\n" +
                     formatted("Paths of %d %s.", image.edges(), image.edges() == 1 ? "edge" : "edges");
  if (const auto share = techniques.share(image))
    text += " " + format_percent(*share) + " of the light, \u00b1 " +
            format_percent(image.standard_error / techniques.combined.mean) + formatted(", %u spp.", image.samples);
  if (disabled) return text + "\nDisabled: its weight goes to the other techniques. Click to enable";
  if (!image.unavailable.empty()) return text + "\n" + image.unavailable;
  return text + "\nClick to disable; MIS gives its weight to the other techniques";
}

class TechniquesPanel final : public Panel {
 public:
  PanelInfo info() const override {
    return {.name = "panel.techniques",
            .label = "Techniques",
            .description = "Contribution of each sampling technique of a bidirectional integrator",
            .place = PanelPlace::bottom};
  }

  void draw(AppState& state) override {
    if (!TechniqueTask::is_available(state.document()))
      return note(state.ui,
                  integrator_label(state.document().method.integrator) +
                      " has no techniques to show. Integrators with techniques: " + bidirectional_integrators() + ".");
    const auto draw_content = [&] {
      if (const TechniqueImages* techniques = task_.result())
        draw_pyramid(state, *techniques);
      else
        note(state.ui, "Rendering the first images.");
    };
    with_controls(state.ui, kControlColumnWidth * ImGui::GetFontSize(), draw_content, [&] { draw_controls(state); });
  }

  std::vector<ParameterInfo> parameters() const override { return describe_all(TechniqueTask::Parameters{}.all()); }

  std::vector<ItemInfo> items() const override {
    return {{"techniques.cell.N.N", "Technique", "Disables technique (s, t), or enables it again"}};
  }

  void add_actions(ActionList& actions) override {
    actions.add({.name = "techniques.export",
                 .menu = "Render",
                 .label = "Export techniques...",
                 .tooltip = "Saves the images of all techniques: .exr with one layer each, .png as a grid",
                 .run = [this](AppState& state) { request_export(state); },
                 .enabled =
                     [this](const AppState& state) {
                       return state.has_document() && TechniqueTask::is_available(state.document()) && task_.result();
                     }});
    actions.add({.name = "techniques.all",
                 .menu = "Render",
                 .label = "Enable all techniques",
                 .tooltip = "Enables the techniques that were disabled",
                 .run =
                     [](AppState& state) {
                       state.set_parameter(TechniqueTask::disabled_parameter(state.document()), std::string());
                     },
                 .enabled =
                     [](const AppState& state) {
                       return state.has_document() && TechniqueTask::is_available(state.document()) &&
                              !TechniqueTask::disabled_techniques(state.document()).empty();
                     }});
  }

  std::vector<WaitCondition> wait_conditions() override {
    const auto check = [this](AppState& state, std::optional<uint32_t>) -> StepStatus {
      if (!TechniqueTask::is_available(state.document())) return {.error = "this integrator has no techniques"};
      if (!state.panels.is_open(*this))
        return {.error = "techniques are rendered while their panel is open; click panel.techniques first"};
      return {.done = task_.is_complete(state.document()) && !task_.is_saving()};
    };
    return {{.name = "techniques", .check = check}};
  }

  void report(AppState& state, nlohmann::json& json) override {
    const bool open = state.has_document();
    auto& report = json["techniques"];
    report = {{"possible", open && TechniqueTask::is_available(state.document())},
              {"fresh", open && task_.is_current(state.document())},
              {"whole", open && task_.is_complete(state.document())},
              {"cells", nlohmann::json::array()}};
    const TechniqueImages* techniques = task_.result();
    if (!techniques) return;
    report["mean"] = techniques->combined.mean;
    const TechniqueImages::Sum sum = techniques->sum();
    report["sum"] = {{"share", sum.share}, {"error", sum.error}};
    for (const auto& image : techniques->images) {
      report["cells"].push_back({{"s", image.s},
                                 {"t", image.t},
                                 {"samples", image.samples},
                                 {"mean", image.mean},
                                 {"standard_error", image.standard_error},
                                 {"absent", image.unavailable}});
      if (const auto share = techniques->share(image)) report["cells"].back()["share"] = *share;
    }
  }

  void update(AppState& state) override {
    task_.update(state.task_context, state.is_visible(*this) && !state.tasks.exclusive->running());
  }
  std::vector<Task*> tasks() override { return {&task_}; }

 private:
  void request_export(AppState& state) {
    state.files.request =
        FileRequest{.title = "Export the techniques (.exr with layers, .png as a grid)",
                    .extensions = {".exr", ".png"},
                    .saves = true,
                    .name = scene_stem(state.document()) + "-techniques.exr",
                    .accept = [this, &state](const std::string& file) { task_.save(state.task_context, file); }};
  }

  static void toggle(AppState& state, const TechniqueImage& image) {
    const std::string disabled = TechniqueTask::disabled_techniques(state.document());
    state.set_parameter(TechniqueTask::disabled_parameter(state.document()),
                        toggle_technique(disabled, image.s, image.t));
  }

  // One row for each path length, one column for each number s of light vertices.
  void draw_pyramid(AppState& state, const TechniqueImages& techniques) {
    const UiContext& ui = state.ui;
    const float em = ImGui::GetFontSize();
    const float label_space = em * 3.2f;
    const float gap = std::floor(em * 0.5f);
    const float line = ImGui::GetTextLineHeight();
    const int longest = techniques.images.back().edges();
    const float available = (ImGui::GetContentRegionAvail().x - label_space) / static_cast<float>(longest + 2) - gap;
    const float width = std::floor(std::clamp(available, kMinImageWidth * ui.scale, kMaxImageWidth * ui.scale));
    const float aspect = static_cast<float>(techniques.height) / static_cast<float>(techniques.width);
    const Vec2 size(width, std::floor(width * aspect));
    const auto disabled = integrator::Techniques::parse(TechniqueTask::disabled_techniques(state.document()));
    const ImVec2 corner = ImGui::GetCursorPos();
    const auto column_x = [&](int s) { return corner.x + label_space + static_cast<float>(s) * (size.x + gap); };
    for (int s = 0; s <= longest + 1; ++s) {
      ImGui::SetCursorPos({column_x(s), corner.y});
      ImGui::TextDisabled("s = %d", s);
      if (ImGui::IsItemHovered()) tooltip(ui, formatted("%d vertices are sampled from the light", s));
    }
    const float row_height = size.y + line + gap;
    const float top = corner.y + line + gap * 0.5f;
    for (size_t i = 0; i < techniques.images.size(); ++i) {
      const TechniqueImage& image = techniques.images[i];
      const float y = top + row_height * static_cast<float>(image.edges() - 1);
      if (image.s == 0) {
        ImGui::SetCursorPos({corner.x, y});
        ImGui::TextDisabled("k = %d", image.edges());
        if (ImGui::IsItemHovered()) tooltip(ui, "Number of edges of the paths in this row");
      }
      ImGui::SetCursorPos({column_x(image.s), y});
      draw_image(state, techniques, i, size, disabled && disabled->contains(image.s, image.t));
    }
  }

  void draw_image(AppState& state, const TechniqueImages& techniques, size_t index, const Vec2& size, bool disabled) {
    UiContext& ui = state.ui;
    const TechniqueImage& image = techniques.images[index];
    const bool available = image.unavailable.empty();
    const ImVec2 corner = ImGui::GetCursorScreenPos();
    const ImVec2 end{corner.x + size.x, corner.y + size.y};
    const ImVec2 item_size{size.x, size.y + ImGui::GetTextLineHeight()};
    const bool clicked = ImGui::InvisibleButton(formatted("##%d.%d", image.s, image.t).c_str(), item_size);
    const bool hovered = ImGui::IsItemHovered();
    ui.items.add(formatted("techniques.cell.%d.%d", image.s, image.t));
    ImDrawList* draw = ImGui::GetWindowDrawList();
    draw->AddRectFilled(corner, end, ImGui::GetColorU32(ImGuiCol_FrameBg, available ? 1 : 0.4f));
    const auto& display = state.document().display;
    const ThumbnailImage thumbnail{.width = techniques.width,
                                   .height = techniques.height,
                                   .pixels = disabled ? nullptr : image.pixels,
                                   .exposure = display.exposure + task_.parameters.exposure,
                                   .curve = display.curve};
    const ImTextureID texture = thumbnail.pixels ? thumbnails_.texture(state.platform.gl(), index, thumbnail) : nullptr;
    if (texture) draw->AddImage(texture, corner, end);
    if (!disabled && !available) {
      const char* text = "none";
      const ImVec2 text_size = ImGui::CalcTextSize(text);
      draw->AddText({corner.x + (size.x - text_size.x) * 0.5f, corner.y + (size.y - text_size.y) * 0.5f},
                    ImGui::GetColorU32(ui.theme.secondary_text), text);
    }
    if (disabled) {
      const ImU32 color = ImGui::GetColorU32(ui.theme.warning);
      draw->AddLine(corner, end, color, 1.5f);
      draw->AddLine({corner.x, end.y}, {end.x, corner.y}, color, 1.5f);
    }
    if (hovered) draw->AddRect(corner, end, ImGui::GetColorU32(ui.theme.accent), 0, 0, 2);
    const ImVec4& caption_color = disabled || !available ? ui.theme.secondary_text : ui.theme.text;
    draw->AddText({corner.x, end.y}, ImGui::GetColorU32(caption_color), caption(techniques, image, disabled).c_str());
    if (hovered) image_tooltip(ui, texture, thumbnail, technique_description(techniques, image, disabled));
    if (clicked && (disabled || available)) toggle(state, image);
  }

  void draw_controls(AppState& state) {
    const UiContext& ui = state.ui;
    filtered_parameters(state, [&] { parameter_widgets(state, task_.parameters.all()); });
    action_button(state, "techniques.export");
    action_button(state, "techniques.all");
    ImGui::PushFont(ui.fonts.small);
    if (const TechniqueImages* techniques = task_.result()) draw_status(state, *techniques);
    note(ui, "(s, t): s vertices from the light, t from the camera. Click a technique to disable it.");
    ImGui::PopFont();
  }

  void draw_status(const AppState& state, const TechniqueImages& techniques) const {
    const UiContext& ui = state.ui;
    const TechniqueImages::Sum sum = techniques.sum();
    if (task_.running()) note(ui, "Rendering: more samples in each round.");
    if (!task_.is_current(state.document())) warning(ui, "Outdated: rendered before the last edit.");
    const char* remark = task_.parameters.weighted
                             ? ". Longer paths contribute the rest. Shares are estimates: their sum may exceed 100 % "
                               "within its standard error."
                             : ". Without weights, paths are counted once per technique.";
    note(ui, formatted("Sum: %.1f \u00b1 %.1f %% of the light", 100 * sum.share, 100 * sum.error) + remark);
  }

  TechniqueTask task_;
  Thumbnails thumbnails_;
};

}  // namespace

std::unique_ptr<Panel> make_techniques_panel() { return std::make_unique<TechniquesPanel>(); }

}  // namespace etendue::viewer
