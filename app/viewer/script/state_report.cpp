// The state as scripts see it, and the list of everything they can name.
#include <algorithm>
#include <cmath>
#include <nlohmann/json.hpp>

#include "integrator/integrator.h"
#include "viewer/layout/bottom_panel.h"
#include "viewer/layout/interface.h"
#include "viewer/script/script.h"
#include "viewer/widgets/parameter_field.h"
#include "viewer/widgets/parameter_widgets.h"

namespace etendue::viewer {
namespace {

using nlohmann::json;

json to_json(const Value& value) {
  return std::visit([](const auto& v) { return json(v); }, value);
}

// In milliseconds; what was not measured is not there.
json percentiles(std::vector<double> values) {
  json j{{"count", values.size()}};
  if (values.empty()) return j;
  std::sort(values.begin(), values.end());
  const auto at = [&](double q) {
    return values[static_cast<size_t>(q * static_cast<double>(values.size() - 1) + 0.5)];
  };
  j["p50"] = at(0.5), j["p95"] = at(0.95), j["p99"] = at(0.99), j["max"] = values.back();
  return j;
}

json describe(const ParameterInfo& p) {
  json j{{"name", p.name}, {"label", p.label}, {"type", type_name(p.type)},           {"unit", p.unit},
         {"min", nullptr}, {"max", nullptr},   {"default", to_json(p.default_value)}, {"doc", p.doc}};
  if (p.type == ParameterType::integer || p.type == ParameterType::number) j["min"] = p.min, j["max"] = p.max;
  if (p.type == ParameterType::choice) j["options"] = p.options;
  return j;
}

json parameter(const ParameterInfo& p) {
  return {{"name", p.name},
          {"label", p.label},
          {"doc", p.doc},
          {"kind", "parameter"},
          {"parameters", json::array({describe(p)})}};
}

json item(const std::string& name, const std::string& label, const std::string& doc) {
  return {{"name", name}, {"label", label}, {"doc", doc}, {"kind", "item"}, {"parameters", json::array()}};
}

// A document that has one of everything a section can stand for.
render::Document specimen() {
  render::Document d;
  if (auto cornell = render::new_document("cornell")) d = std::move(*cornell);
  auto scene = std::make_shared<scene::Scene>(*d.scene);
  scene->lights.emplace_back().type = LightType::spot;
  d.scene = std::move(scene);
  return d;
}

struct PlainItem {
  const char *name, *label, *doc;
};

// Items that are neither actions nor settings. N stands for a number.
constexpr PlainItem kItems[] = {
    {"menu.file", "File", "Opens the menu"},
    {"menu.edit", "Edit", "Opens the menu"},
    {"menu.view", "View", "Opens the menu"},
    {"menu.compare", "Compare", "Opens the menu"},
    {"menu.integrator", "Integrator", "Opens the menu"},
    {"menu.render", "Render", "Opens the menu"},
    {"menu.help", "Help", "Opens the menu"},
    {"menu.palette", "Find an action", "Opens the palette"},
    {"layout.column", "Splitter", "Drag it to change the width of the right column; double click resets it"},
    {"status.health", "Health", "Opens the sheet that says why"},
    {"layout.drawer", "Edge of the drawer", "Drag it to change the height of the drawer; double click resets it"},
    {"compare.divider", "Divider", "Drag it to move the border between A and B; double click centres it"},
    {"scene.node.N", "Object", "Selects node N"},
    {"scene.node.N.visible", "Visible", "Shows or hides node N"},
    {"material.choose", "Material", "Opens the list of materials"},
    {"material.choose.N", "Material N", "Chooses material N in the open list"},
    {"light.choose.N", "Light N", "Chooses light N"},
    {"light.surface.N", "Shining surface", "Goes to material N, which emits"},
    {"camera.choose", "Camera", "Opens the list of the file's cameras"},
    {"camera.choose.N", "Camera N", "Takes camera N in the open list"},
    {"camera.focus-by-click", "Focus by click", "The next click in the picture sets the focus distance"},
    {"compare.add", "Add", "Puts the integrator and the sampler beside it on the list of methods"},
    {"compare.a.N", "A", "Shows method N left of the divider"},
    {"compare.b.N", "B", "Shows method N right of the divider"},
    {"compare.remove.N", "Remove", "Takes method N off the list"},
    {"compare.chart", "Chart", "Rest the pointer on it to read the curves"},
    {"paths.row.N", "Class", "Has only the paths of row N of the table count; all, if they already do"},
    {"techniques.cell.N.N", "Technique", "Leaves technique (s, t) to the others, or brings it back"},
    {"light.preset", "Preset", "Gives the chosen light the colour and amount of a lamp that people know"},
    {"surface.badge.NAME", "Verdict", "Rest the pointer on it to read what it rests on"},
    {"surface.ball", "Ball", "The chosen material in a light of its own"},
    {"surface.ball-kept", "Ball", "The kept material in the same light"},
    {"surface.lobe", "Lobe", "Drag it to look from elsewhere"},
    {"surface.lobe-kept", "Lobe", "Drag it to look from elsewhere"},
    {"surface.polar", "Slice", "f in the plane of incidence"},
    {"surface.albedo", "Albedo", "Over the angle of the light"},
    {"advice.use.N", "Use", "Takes method N of the ranking, and its error as the limit to stop at"},
    {"files.name", "Name", "The name field of the file dialog"},
    {"files.accept", "Open or Save", "Accepts the file dialog"},
    {"files.cancel", "Cancel", "Closes the file dialog"},
    {"help.close", "Close", "Closes the help sheet"},
    {"notice.close", "Close", "Closes a line of error"},
};

json comparison_json(const Comparison& c) {
  json j{{"mode", name_of(c.mode)}, {"divider", c.divider}, {"swapped", c.swapped},
         {"a", c.first().name},     {"b", c.b.name},        {"reference", c.reference.name}};
  j["reference_on_screen"] = c.reference_on_screen();
  if (c.mode != CompareMode::off && !c.problem().empty()) j["problem"] = c.problem();
  if (const auto map = c.map()) {
    // Whether it is of the newest pictures.
    j["fresh"] = map->key.left == c.left().frame->pixels && map->key.right == c.right().frame->pixels;
    j[c.mode == CompareMode::flip ? "flip" : "mean_difference"] = map->mean;
    if (c.mode == CompareMode::difference) j["scale"] = map->scale;
  }
  return j;
}

json contest_json(const ContestHand& hand) {
  json j{{"running", hand.running()}, {"up_to_date", hand.up_to_date()}, {"methods", json::array()}};
  const auto* contest = hand.shown();
  if (!contest) return j;
  constexpr const char* kPhases[] = {"preparing", "comparing", "stopped", "done"};
  j["phase"] = kPhases[static_cast<size_t>(contest->phase)];
  j["progress"] = contest->progress, j["repeat"] = contest->repeat;
  j["reference"] = {{"samples", contest->reference_samples},
                    {"seconds", contest->reference_seconds},
                    {"too_noisy", contest->too_noisy}};
  if (std::isfinite(contest->reference_error)) j["reference"]["error"] = contest->reference_error;
  for (const auto& m : contest->methods) {
    json method{{"name", m.name}, {"samples", m.samples}, {"seconds", m.seconds}, {"rmse", m.rmse}, {"slope", nullptr}};
    if (m.slope.known) method["slope"] = m.slope.value;
    j["methods"].push_back(std::move(method));
  }
  return j;
}

json paths_json(PathsHand& hand) {
  json j{{"fresh", hand.fresh()}, {"running", hand.running()}, {"rows", json::array()}};
  if (!hand.shown()) return j;
  constexpr const char* kFound[] = {"yes", "in part", "no"};
  const auto& rows = hand.shown()->table.rows;
  for (size_t i = 0; i < rows.size(); ++i)
    j["rows"].push_back({{"paths", rows[i].paths},
                         {"share", rows[i].share},
                         {"found", kFound[static_cast<size_t>(hand.seen().rows[i])]}});
  j["missing_share"] = hand.seen().misses.share;
  return j;
}

json advice_json(const AdviceHand& hand) {
  json j{{"running", hand.running()}, {"fresh", hand.fresh()}, {"best", nullptr}};
  const auto* ranking = hand.shown();
  if (!ranking) return j;
  j["target"] = ranking->target;
  if (const auto* best = ranking->best()) j["best"] = best->method.name;
  return j;
}

json techniques_json(const TechniquesHand& hand) {
  json j{{"possible", hand.possible()}, {"fresh", hand.fresh()}, {"whole", hand.whole()}, {"cells", json::array()}};
  const auto* pyramid = hand.shown();
  if (!pyramid) return j;
  j["mean"] = pyramid->whole.mean;
  for (const auto& cell : pyramid->cells) {
    j["cells"].push_back(
        {{"s", cell.s}, {"t", cell.t}, {"samples", cell.samples}, {"mean", cell.mean}, {"absent", cell.absent}});
    if (const auto share = pyramid->share(cell)) j["cells"].back()["share"] = *share;
  }
  return j;
}

json surface_json(const SurfaceHand& hand) {
  json j{{"fresh", hand.fresh()}, {"sides", json::array()}};
  for (size_t side = 0; side < 2; ++side) {
    const auto* reading = hand.shown(side);
    if (!reading) continue;
    json badges = json::object();
    for (const auto& badge : reading->audit.badges) badges[badge.name] = badge.holds;
    j["sides"].push_back({{"model", reading->name},
                          {"badges", badges},
                          {"albedo", bsdf_analysis::hemispherical_albedo(reading->audit.albedo)},
                          {"ball_samples", hand.ball(side).samples}});
  }
  return j;
}

json meter_json(const MeterHand& hand) {
  const auto* m = hand.shown();
  if (!m) return nullptr;
  const auto reading = [](const render::Reading& r) {
    return json{{"value", {r.value.r, r.value.g, r.value.b}}, {"standard_error", r.standard_error}};
  };
  return {{"whole", hand.whole()}, {"radiance", reading(m->radiance)}, {"irradiance", reading(m->irradiance)}};
}

json pixel_json(const PixelStudy& s) {
  json j{{"x", s.pixel.x},
         {"y", s.pixel.y},
         {"samples", s.samples()},
         {"wanted", s.wanted},
         {"mean", {s.mean.r, s.mean.g, s.mean.b}}};
  j["deviation"] = s.deviation, j["largest"] = s.largest, j["zeros"] = s.histogram.zeros;
  if (!s.course.empty()) j["luminance"] = s.course.back().mean, j["band"] = s.course.back().band;
  if (s.tail.khat) j["khat"] = *s.tail.khat;
  return j;
}

}  // namespace

std::string state_report(Workbench& w) {
  json parameters = json::object();
  const auto& d = w.editor.document();
  if (!w.editor.empty())
    for (const auto& section : render::sections(d))
      for (const auto& binding : render::bindings(d, section))
        parameters[binding.info.name] = to_json(binding.info.default_value);
  parameters["view.false-color"] = w.view.false_color;
  parameters["view.aov"] = w.view.aov.empty() ? "picture" : w.view.aov;
  const render::Status status = w.session.status();
  json state{
      {"parameters", parameters},
      {"undo_depth", w.editor.undo_depth()},
      {"redo_depth", w.editor.redo_depth()},
      {"undo", w.editor.undo_name()},
      {"redo", w.editor.redo_name()},
      {"samples", status.version == w.editor.version() ? status.samples : 0},
      {"seconds", status.seconds},
      {"paused", w.session.paused()},
      {"phase", status.phase},
      {"obstacle", w.incompatibility()},
      {"scene", d.scene_name},
      {"selection", {{"node", w.selection.node}, {"material", w.selection.material}, {"light", w.selection.light}}},
      {"tab", tabs()[static_cast<size_t>(w.view.tab)].name},
      {"sheet", w.view.sheet},
      {"comparison", comparison_json(w.comparison)},
      {"contest", contest_json(w.contest)},
      {"paths", paths_json(w.paths)},
      {"advice", advice_json(w.advice)},
      {"techniques", techniques_json(w.techniques)},
      {"surface", surface_json(w.surface)},
      {"meter", meter_json(w.meter)},
      {"misses", nullptr},
      {"points", nullptr},
      {"interface_share", w.pace.share},
      {"first_picture_seconds", w.first_picture_seconds},
      {"latency_ms", percentiles(w.session.take_latencies())},
      {"restart_latency_ms", percentiles(w.session.take_restart_latencies())}};
  state["statistics"] = json::object();
  for (const auto& statistic : status.statistics) state["statistics"][statistic.name] = statistic.value;
  if (const auto* misses = w.misses()) state["misses"] = misses->share;
  if (const auto* points = w.points.shown())
    state["points"] = {{"kept", points->kept}, {"seen", points->points.size()}};
  if (const auto study = w.probe.study()) state["pixel"] = pixel_json(*study);
  if (status.error.known) state["rmse"] = status.error.rmse;
  if (status.health)
    state["health"] = {{"verdict", render::verdict_name(status.health->verdict)}, {"reason", status.health->reason}};
  return state.dump(2, ' ', false, json::error_handler_t::replace) + "\n";
}

std::string widgets_json() {
  json list = json::array();
  Actions actions;
  add_actions(actions, nullptr);
  for (const auto& action : actions.all()) {
    json j = item(action.name, action.label, action.doc);
    j["shortcut"] = json::array();
    for (const Chord& chord : action.chords()) j["shortcut"].push_back(label(chord));
    list.push_back(j);
  }
  for (const TabInfo& tab : tabs()) list.push_back(item(tab.name, tab.label, tab.doc));
  for (const SheetInfo& sheet : sheets()) list.push_back(item(sheet.name, sheet.label, sheet.doc));
  for (const PlainItem& plain : kItems) list.push_back(item(plain.name, plain.label, plain.doc));
  for (const auto& info : loose_parameters()) list.push_back(parameter(info));
  for (const auto& info : contest_parameters()) list.push_back(parameter(info));
  for (const auto& info : advice_parameters()) list.push_back(parameter(info));
  for (const auto& info : sampling_parameters()) list.push_back(parameter(info));
  for (const auto& info : techniques_parameters()) list.push_back(parameter(info));
  for (const auto& info : surface_parameters()) list.push_back(parameter(info));
  for (const auto& info : meter_parameters()) list.push_back(parameter(info));
  const auto d = specimen();
  for (const auto& section : render::sections(d)) {
    // Objects are numbered; the first stands for all.
    const size_t dot = section.find('.');
    if (dot != std::string::npos && section.substr(dot + 1) != "0") continue;
    for (const auto& binding : render::bindings(d, section)) list.push_back(parameter(binding.info));
    if (section.starts_with("node."))
      for (const auto& info : euler_parameters(section, Vec3(0))) list.push_back(parameter(info));
  }
  return list.dump(2);
}

}  // namespace etendue::viewer
