#include "viewer/script/state_report.h"

#include <algorithm>
#include <nlohmann/json.hpp>

#include "base/json_text.h"
#include "render/session.h"
#include "render/shared_sampling.h"
#include "viewer/state/app_state.h"
#include "viewer/state/editor.h"
#include "viewer/viewport/aov_layer.h"
#include "viewer/viewport/comparison.h"
#include "viewer/viewport/pixel_readout.h"
#include "viewer/viewport/stored_points.h"

namespace etendue::viewer {
namespace {

using nlohmann::json;

// Percentiles of durations in milliseconds; only the count if there are none.
json percentiles(std::vector<double> values) {
  json j{{"count", values.size()}};
  if (values.empty()) return j;
  std::ranges::sort(values);
  const auto quantile = [&](double q) {
    return values[static_cast<size_t>(q * static_cast<double>(values.size() - 1) + 0.5)];
  };
  j["p50"] = quantile(0.5);
  j["p95"] = quantile(0.95);
  j["p99"] = quantile(0.99);
  j["max"] = values.back();
  return j;
}

// The messages since the start, oldest first: all of them, or errors only.
json messages(const AppState& state, bool errors_only) {
  json list = json::array();
  for (const auto& entry : state.notices.log())
    if (entry.is_error || !errors_only) list.push_back(entry.text);
  return list;
}

json document_parameters(const AppState& state) {
  json parameters = json::object();
  if (!state.has_document()) return parameters;
  const auto& d = state.document();
  for (const auto& section : render::sections(d))
    for (const auto& parameter : render::section_parameters(d, section))
      parameters[parameter.info.name] = to_json_value<json>(parameter.info.default_value);
  return parameters;
}

json placement_json(const Placement& placement) {
  return {placement.corner.x, placement.corner.y, placement.size.x, placement.size.y};
}

// What is on screen, by the names that scripts use.
json items_report(const ItemRegistry& items) {
  json j = json::object();
  for (const auto& [name, placement] : items.placements()) j[name] = placement_json(placement);
  return j;
}

json comparison_report(const Comparison& c) {
  json j{{"mode", name_of(c.mode)}, {"divider", c.divider}, {"swapped", c.swapped},
         {"a", c.first().name},     {"b", c.b.name},        {"reference", c.reference.name}};
  j["reference_on_screen"] = c.reference_is_shown();
  if (c.mode != CompareMode::off && !c.problem().empty()) j["problem"] = c.problem();
  const auto map = c.map();
  if (!map) return j;
  // Whether the map belongs to the newest images.
  j["fresh"] = map->input.left == c.left().frame->pixels && map->input.right == c.right().frame->pixels;
  j[c.mode == CompareMode::flip ? "flip" : "mean_difference"] = map->mean;
  if (c.mode == CompareMode::difference) j["scale"] = map->scale;
  return j;
}

json aov_report(const AovImage& image) {
  Rgb sum(0);
  for (const Rgb& pixel : image.pixels) sum += pixel;
  const float mean = image.pixels.empty() ? 0 : luminance(sum) / static_cast<float>(image.pixels.size());
  return {{"name", image.name}, {"samples", image.samples}, {"mean_luminance", mean}, {"scale", image.scale}};
}

json pixel_report(const AppState& state, const std::optional<Vec2i>& pixel) {
  const auto values = pixel ? pixel_values(state, *pixel) : std::nullopt;
  if (!values) return nullptr;
  const auto array = [](const Rgb& c) { return json{c.r, c.g, c.b}; };
  json j{{"x", values->pixel.x},
         {"y", values->pixel.y},
         {"radiance", array(values->radiance)},
         {"displayed", array(values->displayed)},
         {"preview", values->is_preview}};
  if (values->samples) j["samples"] = *values->samples;
  if (values->standard_error) j["standard_error"] = *values->standard_error;
  if (values->layer) j["layer"] = array(*values->layer);
  return j;
}

json region_report(const render::Status& status) {
  if (!status.focus) return nullptr;
  const render::FocusStatus& focus = *status.focus;
  const render::PixelRect& r = focus.region;
  json j{{"pixels", {r.x, r.y, r.width, r.height}}, {"samples", focus.samples}, {"note", focus.incompatibility}};
  if (focus.error.known) j["error"] = focus.error.value;
  return j;
}

json ranks_report(const AppState& state) {
  if (!state.options.sharing) return nullptr;
  const render::SharingStatus status = state.options.sharing->status();
  return {{"all", status.ranks},
          {"active", status.active},
          {"own_samples", status.own_samples},
          {"other_samples", status.other_samples},
          {"note", status.note}};
}

// Characters of names and messages that a font of the interface does not have.
size_t missing_glyphs(const UiContext& ui) {
  size_t most = 0;
  for (const ImFont* font : {ui.fonts.text, ui.fonts.monospace, ui.fonts.small})
    most = std::max(most, count_missing(*font, ui.glyphs));
  return most;
}

const char* darkness_name(Darkness darkness) {
  constexpr const char* kNames[] = {"none", "surfaces are black", "no surfaces"};
  return kNames[static_cast<size_t>(darkness)];
}

// The former name of a bottom panel, "sheet.health" for "panel.reliability"; an empty text for none.
std::string sheet_name(const Panel* panel) {
  if (!panel) return "";
  const std::string name = panel->info().name;
  if (name == "panel.reliability") return "sheet.health";
  return "sheet" + name.substr(name.find('.'));
}

}  // namespace

std::string state_report(AppState& state) {
  const render::Status status = state.session->status();
  const Editor& editor = *state.editor;
  const Selection& selection = state.selection;
  const Panel* tab = state.panels.open_tab();
  const Panel* bottom_panel = state.panels.open_bottom_panel();
  // The titles of the windows of detached panels.
  json detached = json::object();
  for (const Panel* panel : state.panels.detached()) {
    const std::string name = panel->info().name;
    const Placement* title = state.ui.items.find("detached." + name);
    detached[name] = title ? placement_json(*title) : json();
  }
  json j{{"parameters", document_parameters(state)},
         {"detached", detached},
         {"edited", editor.has_unsaved_scene_edits()},
         {"session", state.files.session_file},
         {"ui_scale", state.ui.scale},
         {"glyphs", {{"added", state.ui.glyphs.characters().size()}, {"missing", missing_glyphs(state.ui)}}},
         {"messages", state.notices.log().size()},
         {"log", messages(state, false)},
         {"errors", messages(state, true)},
         {"undo_depth", editor.undo_depth()},
         {"redo_depth", editor.redo_depth()},
         {"undo", editor.undo_name()},
         {"redo", editor.redo_name()},
         {"samples", status.version == editor.version() ? status.samples : 0},
         {"seconds", status.seconds},
         {"traced_paths", status.paths},
         {"paused", state.session->paused()},
         {"ranks", ranks_report(state)},
         {"phase", status.phase},
         {"obstacle", state.incompatibility()},
         {"scene", editor.document().scene_name},
         {"selection",
          {{"node", selection.node},
           {"material", selection.material},
           {"light", selection.light},
           {"others", selection.others}}},
         {"popup_open", state.interface.popup_open},
         {"palette_selection_is_visible", state.ui.items.find("palette.selected") != nullptr},
         {"tab", tab ? tab->info().name : ""},
         {"bottom_panel", bottom_panel ? bottom_panel->info().name : ""},
         {"sheet", sheet_name(bottom_panel)},
         {"comparison", comparison_report(*state.viewport.comparison)},
         {"zoom", state.viewport.zoom.scale},
         {"darkness", darkness_name(state.viewport.darkness)},
         {"image", placement_json(state.viewport.image)},
         {"items", items_report(state.ui.items)},
         {"texts_fit", state.ui.items.fits()},
         {"tooltip", state.ui.items.tooltip()},
         {"points", nullptr},
         {"aov", nullptr},
         {"interface_share", state.timing.interface_share},
         {"loading_picture_seconds", state.timing.loading_picture_seconds},
         {"first_picture_seconds", state.timing.first_image_seconds},
         {"latency_ms", percentiles(state.session->take_latencies())},
         {"restart_latency_ms", percentiles(state.session->take_restart_latencies())},
         {"notes", status.notes},
         {"statistics", json::object()}};
  for (const auto& statistic : status.statistics) j["statistics"][statistic.name] = statistic.value;
  if (const auto* points = state.viewport.stored_points->result())
    j["points"] = {{"kept", points->stored}, {"seen", points->points.size()}};
  if (state.shows_aov()) j["aov"] = aov_report(state.viewport.aov->image());
  if (state.viewport.show_pixel_values)
    j["pixel_values"] = {{"pointer", pixel_report(state, pixel_under_pointer(state))},
                         {"pinned", pixel_report(state, state.viewport.pinned_pixel)},
                         {"window", placement_json(state.viewport.pixel_readout->window().placement())}};
  j["region"] = region_report(status);
  for (const auto& panel : state.panels.all()) panel->report(state, j);
  return json_text(j, 2) + "\n";
}

}  // namespace etendue::viewer
