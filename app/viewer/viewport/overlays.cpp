#include "viewer/viewport/overlays.h"

#include <imgui.h>

#include <algorithm>
#include <cmath>

#include "camera/segment_projection.h"
#include "render/session.h"
#include "scene/compiled_scene.h"
#include "spectrum/colormap.h"
#include "viewer/panels/panel.h"
#include "viewer/state/app_state.h"
#include "viewer/state/document_info.h"
#include "viewer/state/object_edits.h"
#include "viewer/viewport/aov_layer.h"
#include "viewer/viewport/comparison.h"
#include "viewer/viewport/comparison_overlay.h"
#include "viewer/viewport/dark_image.h"
#include "viewer/viewport/image_view.h"
#include "viewer/viewport/object_icons.h"
#include "viewer/viewport/picking.h"
#include "viewer/viewport/pixel_readout.h"
#include "viewer/viewport/reliability_overlay.h"
#include "viewer/viewport/safe_frames.h"
#include "viewer/viewport/selection_outline.h"
#include "viewer/viewport/stored_points.h"
#include "viewer/widgets/action_widgets.h"
#include "viewer/widgets/basic_widgets.h"
#include "viewer/widgets/scale_bar.h"
#include "viewer/widgets/value_text.h"

namespace etendue::viewer {
namespace {

// A light line on a dark one is visible on any image.
constexpr ImU32 kOutlineBorder = IM_COL32(0, 0, 0, 140);
constexpr ImU32 kOutlineColor = IM_COL32(120, 190, 240, 255);

// Messages over the image.
constexpr ImGuiWindowFlags kOverlayWindow = ImGuiWindowFlags_NoDecoration | ImGuiWindowFlags_NoMove |
                                            ImGuiWindowFlags_NoSavedSettings | ImGuiWindowFlags_AlwaysAutoResize |
                                            ImGuiWindowFlags_NoFocusOnAppearing;

void draw_outline(const Placement& image, Vec2 scale, const std::vector<OutlineSegment>& segments, ImDrawList* draw) {
  const auto draw_lines = [&](ImU32 color, float width) {
    for (const OutlineSegment& segment : segments) {
      const Vec2 from = image.corner + segment.from * scale;
      const Vec2 to = image.corner + segment.to * scale;
      draw->AddRectFilled({from.x - width, from.y - width}, {to.x + width, to.y + width}, color);
    }
  };
  draw_lines(kOutlineBorder, 1.5f);
  draw_lines(kOutlineColor, 0.75f);
}

// The bounding box of a selected node, while the outline is computed.
void draw_bounding_box(const AppState& state, int node, ImDrawList* draw) {
  const auto scene = state.session->scene();
  const Placement& image = state.viewport.image;
  if (!scene || image.size.x < 2) return;
  const Bounds bounds = bounds_of_node(*scene, node);
  if (bounds.empty()) return;
  const Camera& camera = state.document().camera;
  const auto corner = [&](int i) {
    return Vec3(i & 1 ? bounds.max.x : bounds.min.x, i & 2 ? bounds.max.y : bounds.min.y,
                i & 4 ? bounds.max.z : bounds.min.z);
  };
  const auto draw_edges = [&](ImU32 color, float width) {
    for (int i = 0; i < 8; ++i)
      for (const int bit : {1, 2, 4}) {
        if (i & bit) continue;
        const auto ends = project_segment(camera, Vec2i(image.size), corner(i), corner(i | bit));
        if (!ends) continue;
        const Vec2 from = image.corner + (*ends)[0], to = image.corner + (*ends)[1];
        draw->AddLine({from.x, from.y}, {to.x, to.y}, color, width);
      }
  };
  draw_edges(kOutlineBorder, 3.5f);
  draw_edges(kOutlineColor, 1.5f);
}

void draw_selection(const AppState& state, ImDrawList* draw) {
  const Placement& image = state.viewport.image;
  const auto* segments = state.viewport.selection_outline->segments();
  const bool is_visible = segments && !segments->empty();
  if (!is_visible) {
    for (const int node : selected_nodes(state)) draw_bounding_box(state, node, draw);
    return;
  }
  draw_outline(image, image.size / Vec2(state.document().width, state.document().height), *segments, draw);
}

void draw_false_color_scale(const AppState& state, ImDrawList* draw) {
  const Vec2 range = false_color_range(state.document().display.exposure);
  std::string labels[5];
  for (int i = 0; i <= 4; ++i) {
    const float stops = range.x + (range.y - range.x) * static_cast<float>(i) / 4;
    labels[i] = formatted("%.2g", static_cast<double>(std::exp2(stops)));
  }
  draw_scale_bar(state.ui, draw, state.viewport.visible_image(), viridis, labels, "luminance, cd/m\u00b2");
}

std::string aov_title(const AppState& state) {
  const std::string& name = state.viewport.aov_name;
  const std::string label = label_of_name(name);
  const AovImage& image = state.viewport.aov->image();
  if (image.name != name) return label + ": computing";
  if (!image.scale.empty()) return label + ", " + image.scale;
  return state.viewport.aov->is_busy() ? label + ": computing" : label;
}

// Says at the upper edge that the image is not the integrator's.
void draw_substitute_label(const AppState& state, ImDrawList* draw) {
  const auto frame = state.session->frame();
  if (!frame || !frame->is_substitute || !state.viewport.aov_name.empty()) return;
  draw_label(
      draw, state.viewport.visible_image().corner + Vec2(ImGui::GetFontSize() * 0.5f),
      "Path-traced preview, until " + integrator_label(state.document().method.integrator) + " has its first image");
}

void draw_stored_points(const AppState& state, ImDrawList* draw) {
  const VisiblePoints* visible = state.viewport.stored_points->result();
  if (!visible || state.shows_aov()) return;
  const Placement& image = state.viewport.image;
  const auto& d = state.document();
  const Vec2 scale = image.size / Vec2(d.width, d.height);
  const float em = ImGui::GetFontSize();
  const float half = std::max(1.0f, em * (visible->points.size() > 2000 ? 0.07f : 0.14f));
  for (const VisiblePoint& point : visible->points) {
    const Vec2 at = image.corner + point.raster * scale;
    const ImVec4 color{std::sqrt(point.color.r), std::sqrt(point.color.g), std::sqrt(point.color.b), 1};
    // A dark border separates a point from the image and from other points.
    draw->AddRectFilled({at.x - half - 1, at.y - half - 1}, {at.x + half + 1, at.y + half + 1}, IM_COL32(0, 0, 0, 150));
    draw->AddRectFilled({at.x - half, at.y - half}, {at.x + half, at.y + half}, ImGui::GetColorU32(color));
  }
  const std::string text =
      visible->stored == 0
          ? integrator_label(d.method.integrator) + " stores no photons or virtual lights"
          : formatted("%zu points stored, %zu visible from the camera", visible->stored, visible->points.size());
  const Placement visible_part = state.viewport.visible_image();
  const float bottom = visible_part.corner.y + visible_part.size.y - em * 0.6f;
  draw_label(draw, Vec2(visible_part.corner.x + em * 0.6f, bottom - label_size(text).y), text);
}

// Says at the lower edge of the image, above other messages, that it is dark, and offers remedies.
void draw_darkness(AppState& state) {
  const ViewportState& viewport = state.viewport;
  if (viewport.darkness == Darkness::none || state.shows_aov()) return;
  if (viewport.comparison->mode != CompareMode::off || !state.incompatibility().empty()) return;
  const Placement& region = viewport.region;
  const float em = ImGui::GetFontSize();
  const float height_of_messages = std::max(viewport.playback.bar_height, viewport.height_of_notices);
  const float bottom = region.corner.y + region.size.y - em - height_of_messages;
  ImGui::SetNextWindowPos({region.corner.x + region.size.x / 2, bottom}, ImGuiCond_Always, {0.5f, 1});
  ImGui::Begin("##dark image", nullptr, kOverlayWindow);
  const bool has_surfaces = viewport.darkness == Darkness::surfaces_are_black;
  ImGui::TextUnformatted(has_surfaces ? "Most of the visible surfaces are black." : "The camera sees no surface.");
  if (has_surfaces) {
    action_button(state, "environment.studio");
    ImGui::SameLine();
  }
  action_button(state, "view.reset-camera");
  ImGui::SameLine();
  action_button(state, "view.frame-all");
  ImGui::End();
}

// Says in the middle of the image why it stays black. Buttons lead to the parameters that the reason names.
void draw_incompatibility(AppState& state) {
  const std::string reason = state.incompatibility();
  if (reason.empty() || state.shows_aov()) return;
  const LabelledMessage message = with_labels(state.document(), reason);
  const Placement image = state.viewport.visible_image();
  const float em = ImGui::GetFontSize();
  const float width = std::min(em * 26, state.viewport.region.size.x - 2 * em);
  const Vec2 centre = image.corner + image.size * 0.5f;
  ImGui::SetNextWindowPos({std::floor(centre.x), std::floor(centre.y)}, ImGuiCond_Always, {0.5f, 0.5f});
  ImGui::PushStyleColor(ImGuiCol_Border, state.ui.theme.warning);
  ImGui::PushStyleVar(ImGuiStyleVar_WindowBorderSize, 1);
  ImGui::Begin("##incompatibility", nullptr, kOverlayWindow);
  ImGui::PushTextWrapPos(width);
  ImGui::TextUnformatted(message.text.c_str());
  ImGui::PopTextWrapPos();
  for (const std::string& name : message.parameters) {
    const auto parameter = document_parameter(state.document(), name);
    if (ImGui::Button(("Set " + lower_case(parameter->info.label) + "...").c_str())) state.show_parameter(name);
    state.ui.items.add("incompatibility." + name);
    if (ImGui::IsItemHovered()) tooltip(state.ui, parameter->info.label + ": " + parameter->info.doc);
  }
  ImGui::End();
  ImGui::PopStyleVar();
  ImGui::PopStyleColor();
}

}  // namespace

void draw_viewport_overlays(AppState& state) {
  if (!state.has_document()) return;
  const ViewportState& viewport = state.viewport;
  ImDrawList* draw = ImGui::GetBackgroundDrawList();
  const Placement& region = viewport.region;
  draw->PushClipRect({region.corner.x, region.corner.y},
                     {region.corner.x + region.size.x, region.corner.y + region.size.y});
  if (state.interface.visible) draw_selection(state, draw);
  if (state.interface.visible && viewport.show_icons) draw_object_icons(state, *draw);
  if (viewport.show_reliability)
    if (const auto reliability = state.session->status().reliability)
      draw_reliability_overlay(state, *reliability, draw);
  if (viewport.show_stored_points) draw_stored_points(state, draw);
  if (viewport.show_safe_frames) draw_safe_frames(state, *draw);
  const Comparison& comparison = *viewport.comparison;
  const bool shows_map = comparison.map() && !comparison.reference_is_shown();
  if (viewport.false_color && viewport.aov_name.empty() && !shows_map) draw_false_color_scale(state, draw);
  if (state.interface.visible) viewport.gizmo.draw(state, *draw);
  viewport.focus.draw(state);
  draw_comparison_overlay(state, draw);
  for (const auto& panel : state.panels.all()) panel->draw_overlay(state, *draw);
  if (state.interface.visible) {
    draw_substitute_label(state, draw);
    draw_incompatibility(state);
    draw_darkness(state);
  }
  if (state.interface.visible && viewport.show_pixel_values) draw_pixel_readout(state);
  if (!viewport.aov_name.empty())
    draw_label(draw, viewport.visible_image().corner + Vec2(ImGui::GetFontSize() * 0.5f), aov_title(state));
  draw->PopClipRect();
}

}  // namespace etendue::viewer
