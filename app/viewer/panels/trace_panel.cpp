// One sample of a pixel as the integrator computed it: a table of its vertices, and its paths in the picture.
#include <imgui.h>

#include <nlohmann/json.hpp>

#include "base/number_text.h"
#include "camera/segment_projection.h"
#include "trace/trace_drawing.h"
#include "trace/trace_json.h"
#include "viewer/actions/action.h"
#include "viewer/files/file_names.h"
#include "viewer/panels/panel.h"
#include "viewer/state/app_state.h"
#include "viewer/state/document_info.h"
#include "viewer/tasks/trace_task.h"
#include "viewer/widgets/action_widgets.h"
#include "viewer/widgets/basic_widgets.h"
#include "viewer/widgets/filter_box.h"
#include "viewer/widgets/parameter_widgets.h"
#include "viewer/widgets/value_text.h"

namespace etendue::viewer {
namespace {

constexpr const char* kPickTracedPixel = "trace.pick";

ImU32 color_of(const metrics::Color& c) { return IM_COL32(c.r, c.g, c.b, 255); }

// A dark border makes the line visible on bright images.
void draw_line(ImDrawList& draw, const Vec2& from, const Vec2& to, ImU32 color, float width) {
  draw.AddLine({from.x, from.y}, {to.x, to.y}, IM_COL32(0, 0, 0, 150), width + 2);
  draw.AddLine({from.x, from.y}, {to.x, to.y}, color, width);
}

void draw_dashed_line(ImDrawList& draw, const Vec2& from, const Vec2& to, ImU32 color, float width) {
  const metrics::Polyline line{.points = {{double{from.x}, double{from.y}}, {double{to.x}, double{to.y}}},
                               .color = {},
                               .width = double{width},
                               .dashed = true};
  for (const auto& [a, b] : metrics::dash_segments(line)) draw_line(draw, Vec2(a.x, a.y), Vec2(b.x, b.y), color, width);
}

struct Column {
  const char* label;
  const char* tooltip;
};
constexpr Column kColumns[] = {{"Event", "Vertices are numbered in the order in which paths reach them"},
                               {"Details", "Surface, direction, distance, throughput"},
                               {"Density", "Per solid angle at the vertex, or the measure of a delta"},
                               {"MIS weight", "Weight of this technique for this path"},
                               {"Contribution", "Added to the radiance of the sample, cd/m\u00b2"}};
constexpr int kDetails = 1;

class TracePanel final : public Panel {
 public:
  PanelInfo info() const override {
    return {.name = "panel.trace",
            .label = "Trace",
            .description = "One sample of a pixel: vertices, densities, weights and contributions, and its paths",
            .place = PanelPlace::bottom};
  }

  void draw(AppState& state) override {
    const float em = ImGui::GetFontSize();
    const ImVec2 available = ImGui::GetContentRegionAvail();
    if (available.x >= 3 * kControlColumnWidth * em)
      return with_controls(
          state.ui, kControlColumnWidth * em, [&] { draw_content(state); },
          [&] {
            draw_buttons(state);
            draw_parameters(state);
          });
    // In a narrow panel the table is between the buttons and the parameters.
    draw_buttons(state);
    ImGui::BeginChild("##table", {0, std::max(ImGui::GetContentRegionAvail().y, 8 * em)});
    draw_content(state);
    ImGui::EndChild();
    draw_parameters(state);
  }

  std::vector<ParameterInfo> parameters() const override { return describe_all(TraceTask::Parameters{}.all()); }

  void add_actions(ActionList& actions) override {
    const auto use = [this](AppState& state, Vec2 position) {
      select_pixel(state, position);
      return true;
    };
    actions.add({.name = kPickTracedPixel,
                 .menu = "View",
                 .label = "Trace pixel",
                 .tooltip = "Shows the paths of one sample of the pixel where you click next",
                 .run =
                     [this, use](AppState& state) {
                       state.toggle_tool({.name = kPickTracedPixel, .use = use});
                       state.panels.open(*this);
                     },
                 .enabled = [](const AppState& state) { return state.has_document(); },
                 .checked = [](const AppState& state) { return state.is_active_tool(kPickTracedPixel); }});
    actions.add({.name = "trace.export",
                 .menu = "View",
                 .label = "Export trace...",
                 .tooltip = "Saves the paths over the current image (.svg), or all values (.json)",
                 .run = [this](AppState& state) { request_export(state); },
                 .enabled = [this](const AppState& state) { return state.has_document() && task_.result(); }});
  }

  std::vector<WaitCondition> wait_conditions() override {
    const auto check = [this](AppState& state, std::optional<uint32_t>) -> StepStatus {
      if (const auto reason = render::why_untraceable(state.document()); !reason.empty()) return {.error = reason};
      if (!task_.pixel()) return {.error = "no pixel is selected; click trace.pick and then the image first"};
      return {.done = task_.is_current(state.task_context) && !task_.is_saving()};
    };
    return {{.name = "trace", .check = check, .needs_frames = true}};
  }

  void report(AppState&, nlohmann::json& json) override {
    if (const ShownTrace* shown = task_.result()) json["trace"] = trace::to_json(shown->trace);
  }

  void update(AppState& state) override {
    if (state.panels.is_open(*this) && state.has_document()) task_.update(state.task_context);
  }

  std::vector<Task*> tasks() override { return {&task_}; }

  // Ctrl+click selects a pixel.
  bool handle_click(AppState& state, Vec2 position) override {
    if (!state.ui.input.control()) return false;
    select_pixel(state, position);
    return true;
  }

  void draw_overlay(AppState& state, ImDrawList& draw) override {
    const ShownTrace* shown = task_.result();
    if (!shown || !state.is_visible(*this)) return;
    const Placement& image = state.viewport.image;
    for (const trace::PathSegment& s : shown->segments) {
      using Kind = trace::PathSegment::Kind;
      if (!task_.parameters.shadow_rays && (s.kind == Kind::shadow_ray || s.kind == Kind::occluded)) continue;
      const auto ends = project_segment(state.document().camera, Vec2i(image.size), s.from, s.to);
      if (!ends) continue;
      const Vec2 from = image.corner + (*ends)[0], to = image.corner + (*ends)[1];
      const float width = state.ui.scale * (s.kind == Kind::path ? 2.0f : 1.3f);
      (trace::is_dashed(s.kind) ? draw_dashed_line : draw_line)(draw, from, to, color_of(trace::color_of(s.kind)),
                                                                width);
    }
    draw_vertices(state, shown->trace, draw);
  }

 private:
  void select_pixel(AppState& state, Vec2 position) {
    const auto& d = state.document();
    task_.set_pixel(pixel_at(state.viewport.image, {d.width, d.height}, position));
    state.panels.open(*this);
  }

  void request_export(AppState& state) {
    state.files.request =
        FileRequest{.title = "Export the paths (.svg) or all values (.json)",
                    .extensions = {".svg", ".json"},
                    .saves = true,
                    .name = scene_stem(state.document()) + "-trace.svg",
                    .accept = [this, &state](const std::string& file) { task_.save(state.task_context, file); }};
  }

  // Dots with the numbers of the vertices.
  static void draw_vertices(const AppState& state, const render::PixelTrace& trace, ImDrawList& draw) {
    const Placement& image = state.viewport.image;
    const float radius = 3 * state.ui.scale;
    for (size_t i = 0; i < trace.record.vertices.size(); ++i) {
      const auto& v = trace.record.vertices[i];
      if (v.escaped) continue;
      const Vec3& at = v.point.position;
      const auto ends = project_segment(state.document().camera, Vec2i(image.size), at, at);
      if (!ends) continue;
      const Vec2 p = image.corner + (*ends)[0];
      draw.AddCircleFilled({p.x, p.y}, radius + 1, IM_COL32(0, 0, 0, 200));
      draw.AddCircleFilled({p.x, p.y}, radius, color_of(trace::color_of(trace::PathSegment::Kind::path)));
      const ImVec2 label{p.x + 1.5f * radius, p.y - ImGui::GetFontSize()};
      const std::string number = std::to_string(i + 1);
      draw.AddText({label.x + 1, label.y + 1}, IM_COL32(0, 0, 0, 255), number.c_str());
      draw.AddText(label, IM_COL32(255, 255, 255, 255), number.c_str());
    }
  }

  void draw_buttons(AppState& state) {
    action_button(state, kPickTracedPixel);
    ImGui::SameLine();
    action_button(state, "trace.export");
    if (!task_.pixel()) return;
    ImGui::SameLine();
    ImGui::PushFont(state.ui.fonts.monospace);
    ImGui::Text("%d, %d", task_.pixel()->x, task_.pixel()->y);
    ImGui::PopFont();
  }

  void draw_parameters(AppState& state) {
    filtered_parameters(state, [&] { parameter_widgets(state, task_.parameters.all()); });
  }

  void draw_content(AppState& state) {
    const UiContext& ui = state.ui;
    if (const auto reason = render::untraceable_reason(state.document()); !reason.empty())
      return warning(ui, "No sample of " + integrator_label(state.document().method.integrator) +
                             " belongs to one pixel: " + reason + ". Choose another integrator, such as " +
                             integrator_label("path") + ".");
    if (!task_.pixel())
      return note(ui, "Select a pixel with Trace pixel and a click in the image, or with Ctrl+click.");
    const ShownTrace* shown = task_.result();
    if (!shown) return note(ui, "Tracing the sample.");
    draw_table(ui, *shown);
  }

  static void draw_table(const UiContext& ui, const ShownTrace& shown) {
    const auto flags = ImGuiTableFlags_SizingFixedFit | ImGuiTableFlags_ScrollY | ImGuiTableFlags_BordersInnerH;
    if (!ImGui::BeginTable("##trace", static_cast<int>(std::size(kColumns)), flags)) return;
    draw_header(ui);
    for (const trace::TraceRow& row : shown.rows) draw_row(ui, row);
    const Rgb& sum = shown.trace.record.radiance;
    draw_row(ui,
             {.event = "sum",
              .details = sum == shown.trace.radiance ? "equal to the sample of the film" : "not equal to the sample",
              .contribution = format_number(double{sum.r}, 4) + " " + format_number(double{sum.g}, 4) + " " +
                              format_number(double{sum.b}, 4)});
    ImGui::EndTable();
  }

  static void draw_header(const UiContext& ui) {
    for (const Column& column : kColumns)
      ImGui::TableSetupColumn(column.label, &column == kColumns + kDetails ? ImGuiTableColumnFlags_WidthStretch
                                                                           : ImGuiTableColumnFlags_WidthFixed);
    ImGui::TableSetupScrollFreeze(0, 1);
    ImGui::TableNextRow();
    for (const Column& column : kColumns) {
      ImGui::TableNextColumn();
      ImGui::TextDisabled("%s", column.label);
      if (ImGui::IsItemHovered()) tooltip(ui, column.tooltip);
    }
  }

  static void draw_row(const UiContext& ui, const trace::TraceRow& row) {
    const ImVec4& color = row.rejected ? ui.theme.secondary_text : ui.theme.text;
    ImGui::PushStyleColor(ImGuiCol_Text, color);
    ImGui::TableNextRow();
    for (const std::string* text : {&row.event, &row.details, &row.pdf, &row.mis_weight, &row.contribution}) {
      ImGui::TableNextColumn();
      // The other columns have the width of their text.
      (text == &row.details ? ImGui::TextWrapped : ImGui::Text)("%s", text->c_str());
    }
    ImGui::PopStyleColor();
  }

  TraceTask task_;
};

}  // namespace

std::unique_ptr<Panel> make_trace_panel() { return std::make_unique<TracePanel>(); }

}  // namespace etendue::viewer
