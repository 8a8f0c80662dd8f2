#include "viewer/state/app_state.h"

#include <filesystem>

#include "integrator/integrator.h"

namespace etendue::viewer {
namespace {

std::string name_of_object(const render::Document& d, const std::string& section) {
  const size_t dot = section.find('.');
  if (dot == std::string::npos) return "";
  const auto index = static_cast<size_t>(std::stoul(section.substr(dot + 1)));
  std::string name;
  if (section.starts_with("material") && index < d.scene->materials.size()) name = d.scene->materials[index].name;
  if (section.starts_with("light") && index < d.scene->lights.size()) name = d.scene->lights[index].name;
  if (section.starts_with("node") && index < d.scene->nodes.size()) name = d.scene->nodes[index].name;
  return " of " + (name.empty() ? section : name);
}

// "path, sobol, 64 spp"
std::string name_of_picture(const render::Document& d, uint32_t samples) {
  return d.method.integrator + ", " + d.method.sampler + ", " + std::to_string(samples) + " spp";
}

}  // namespace

Workbench::Workbench(Platform& p, const ViewOptions& o)
    : platform(p),
      options(o),
      session({.threads = o.threads, .interactive = true, .publish_interval = 0.1}),
      loader([&p] { p.wake(); }),
      capture(session, editor, [&p] { p.wake(); }),
      scene_writer([&p] { p.wake(); }),
      aov(session, editor, [&p] { p.wake(); }),
      comparison([&p] { p.wake(); }),
      contest(session, editor, o.threads, bench::cache_folder(), [&p] { p.wake(); }),
      paths(session, editor, o.threads, [&p] { p.wake(); }),
      missing_paths(session, editor, [&p] { p.wake(); }),
      techniques(session, editor, [&p] { p.wake(); }),
      points(session, editor, [&p] { p.wake(); }),
      thumbnails(p.gl()),
      surface(editor, [&p] { p.wake(); }),
      balls(p.gl()),
      advice(session, editor, o.threads, [&p] { p.wake(); }),
      probe(session, editor, [&p] { p.wake(); }),
      meter(session, editor, [&p] { p.wake(); }) {
  session.on_update([&p] { p.wake(); });
  add_actions(actions, this);
}

void Workbench::open(const std::string& file) {
  last_opened = file;
  loader.open(file, editor.document());
}

void Workbench::edit(const render::DocumentParameter& binding, const Value& value, const std::string& gesture) {
  if (binding.info.name == "render.integrator" && to_string(value) != editor.document().method.integrator)
    previous_integrator = editor.document().method.integrator;
  render::Document changed = editor.document();
  binding.assign(changed, value);
  editor.apply(std::move(changed), binding.info.label + name_of_object(editor.document(), binding.section), gesture);
}

void Workbench::edit(std::span<const render::DocumentParameter> bindings, std::span<const Value> values,
                     const std::string& gesture) {
  render::Document changed = editor.document();
  for (size_t i = 0; i < bindings.size(); ++i) bindings[i].assign(changed, values[i]);
  const render::DocumentParameter& first = bindings.front();
  editor.apply(std::move(changed), first.info.label + name_of_object(editor.document(), first.section), gesture);
}

void Workbench::edit_camera(const Camera& camera, const std::string& name, const std::string& gesture) {
  render::Document changed = editor.document();
  changed.camera = camera;
  editor.apply(std::move(changed), name, gesture);
}

void Workbench::choose_integrator(const std::string& name) {
  if (editor.empty() || name == editor.document().method.integrator) return;
  for (const auto& binding : render::bindings(editor.document(), "render"))
    if (binding.info.name == "render.integrator") edit(binding, name);
}

void Workbench::choose_paths(const std::string& expression) {
  for (const auto& binding : render::bindings(editor.document(), "film"))
    if (binding.info.name == "film.paths") edit(binding, expression);
}

std::string Workbench::incompatibility() const {
  const auto status = session.status();
  return !editor.empty() && status.version == editor.version() ? status.incompatibility : "";
}

const advisor::MissingPaths* Workbench::misses() {
  return paths.fresh() ? &paths.seen().misses : missing_paths.shown();
}

void Workbench::select(int node, int material) {
  selection.node = node;
  if (material >= 0) selection.material = material;
  if (node < 0 || editor.empty()) return;
  const auto& n = editor.document().scene->nodes[static_cast<size_t>(node)];
  if (n.light >= 0) selection.light = n.light;
  if (material < 0 && n.mesh >= 0) {
    const auto& primitives = editor.document().scene->meshes[static_cast<size_t>(n.mesh)].primitives;
    if (!primitives.empty()) selection.material = primitives.front().material;
  }
}

void Workbench::focus_at(const Picked& picked) {
  hand.set_pivot(picked.position);
  Camera camera = editor.document().camera;
  camera.focus_distance = picked.axial_distance;
  if (!(camera == editor.document().camera)) edit_camera(camera, "Focus", "");
  char text[64];
  std::snprintf(text, sizeof text, "Focus and orbit centre at %.4g m", static_cast<double>(picked.axial_distance));
  notices.say(text);
}

void Workbench::frame_scene() {
  const auto scene = session.scene();
  if (editor.empty() || !scene) return;
  const auto& d = editor.document();
  edit_camera(hand.frame(d.camera, scene->bounds(), static_cast<float>(d.width) / static_cast<float>(d.height)),
              "Frame all", "");
}

void Workbench::frame_selection() {
  const auto scene = session.scene();
  if (editor.empty() || !scene) return;
  const Bounds bounds = bounds_of_node(*scene, selection.node);
  const auto& d = editor.document();
  if (bounds.empty()) return frame_scene();
  edit_camera(hand.frame(d.camera, bounds, static_cast<float>(d.width) / static_cast<float>(d.height)),
              "Frame selection", "");
}

void Workbench::take_opened(Result<Opened> opened) {
  if (!opened) return notices.complain(opened.error().message);
  remember_recent(settings, opened->file);
  if (opened->kind == Opened::Kind::environment) {
    // Edits made while the picture was read stay.
    render::Document lit = editor.document();
    auto scene = std::make_shared<scene::Scene>(*lit.scene);
    scene->environment = opened->document.scene->environment;
    lit.scene = std::move(scene);
    editor.apply(std::move(lit), "Environment");
    return notices.say("Lit by " + std::filesystem::path(opened->file).filename().string());
  }
  if (opened->kind == Opened::Kind::scene && opened->document.camera.aspect <= 0) {
    opened->document.width = std::max(16, static_cast<int>(view.region.size.x));
    opened->document.height = std::max(16, static_cast<int>(view.region.size.y));
  }
  selection = {};
  previous_integrator.clear();
  needs_pivot_ = true;
  contest.stop();
  paths.forget();
  missing_paths.forget();
  techniques.forget();
  surface.forget();
  meter.forget();
  advice.forget();
  session.pause(false);
  editor.open(std::move(opened->document));
  platform.set_title(std::filesystem::path(editor.document().scene_name).filename().string() + " - Étendue");
  for (const auto& warning : editor.document().scene->warnings) notices.say(warning);
}

bool Workbench::advance(Picture& on_screen) {
  bool redraw = false;
  if (auto opened = loader.take()) take_opened(std::move(*opened)), redraw = true;
  if (auto saved = capture.advance()) {
    if (*saved)
      notices.say("Saved " + **saved);
    else
      notices.complain(saved->error().message);
    redraw = true;
  }
  if (auto saved = scene_writer.take()) {
    if (*saved)
      notices.say("Saved " + (*saved)->file);
    else
      notices.complain(saved->error().message);
    if (*saved)
      for (const auto& warning : (*saved)->warnings) notices.say(warning);
    redraw = true;
  }
  if (auto loaded = comparison.take_loaded()) {
    if (*loaded)
      notices.say(**loaded);
    else
      notices.complain(loaded->error().message);
    redraw = true;
  }
  if (editor.empty()) return redraw;
  const bool layer_came = aov.advance(view.aov);
  const bool shows_aov = shows_layer();
  const auto latest = session.frame();
  if (shows_aov && (layer_came || !shows_aov_)) {
    on_screen.upload(aov.picture().width, aov.picture().height, aov.picture().pixels);
    redraw = true;
  }
  if (latest && (latest != frame || shows_aov_ != shows_aov)) {
    // An edit that changes no light gives the same pixels another version.
    const bool uploaded = frame && frame->pixels == latest->pixels && shows_aov_ == shows_aov;
    frame = latest;
    if (!shows_aov && !uploaded) on_screen.upload(frame->width, frame->height, *frame->pixels);
    redraw = true;
  }
  shows_aov_ = shows_aov;
  if (frame && frame->version == editor.version())
    comparison.live = {name_of_picture(editor.document(), frame->samples), frame};
  contest.advance(comparison, notices);
  advice.advance(notices);
  paths.advance(view.sheet == "sheet.paths" && !advice.running());
  if (points.advance(view.points)) redraw = true;
  techniques.advance(view.sheet == "sheet.techniques" && view.interface && !advice.running() && !contest.running(),
                     notices);
  const bool surface_sheet = view.interface && view.sheet == "sheet.surface";
  surface.advance(selection.material, surface_sheet || (view.interface && view.tab == Tab::material), surface_sheet);
  meter.advance();
  const bool busy = advice.running() || contest.running() || paths.running();
  missing_paths.advance(view.tab == Tab::render && view.interface && !busy && !paths.fresh());
  if (view.sheet != "sheet.sampling")
    probe.rest();
  else if (probe.advance(view.sampling.samples))
    redraw = true;
  if (comparison.advance(editor.document().display.exposure, editor.document().display.curve)) redraw = true;
  if (needs_pivot_ && session.status().version >= editor.version())
    if (const auto scene = session.scene()) hand.find_pivot(editor.document().camera, *scene), needs_pivot_ = false;
  return redraw;
}

Placement fitted(const Placement& region, Vec2i picture) {
  const Vec2 size = glm::max(Vec2(picture), Vec2(1));
  const float scale = std::min(region.size.x / size.x, region.size.y / size.y);
  const Vec2 shown = glm::max(glm::round(size * scale), Vec2(1));
  return {glm::floor(region.corner + (region.size - shown) * 0.5f), shown};
}

}  // namespace etendue::viewer
