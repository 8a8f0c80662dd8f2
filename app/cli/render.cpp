// etendue render: a scene to a file, until enough samples, time or accuracy.
#include <CLI/CLI.hpp>
#include <atomic>
#include <cstdio>
#include <memory>
#include <nlohmann/json.hpp>
#include <thread>

#include "advisor/certificate.h"
#include "base/file.h"
#include "command.h"
#include "integrator/integrator.h"
#include "interrupt.h"
#include "memory.h"
#include "progress.h"
#include "render/aov.h"
#include "render/checkpoint.h"
#include "render/image_output.h"
#include "render/incompatibility.h"
#include "render/session.h"
#include "scene/builtin/builtin.h"
#include "settings.h"

namespace etendue::cli {
namespace {

struct Options {
  std::string scene, out, png, integrator, sampler, size, camera, paths, aov, env, json, resume, like;
  std::vector<std::string> sets;
  std::string filter;
  uint32_t spp = 0;
  double time = 0, error = 0, checkpoint = 0;
  int threads = 0, max_depth = -1;
  int64_t seed = -1;
  double exposure = NAN;
};

struct ResumePoint {
  render::Document document;
  std::optional<film::Film> film;
  double seconds = 0;
  std::vector<std::byte> integrator_state;
};

// Where a rendering starts: a checkpoint, a snapshot, or a scene with defaults.
Result<ResumePoint> starting_point(const Options& o) {
  ResumePoint start;
  if (!o.resume.empty()) {
    auto checkpoint = render::read_checkpoint(o.resume);
    if (!checkpoint) return checkpoint.error();
    auto document = render::document_from_state(checkpoint->state, o.resume);
    if (!document) return document.error();
    start = {std::move(*document), std::move(checkpoint->film), checkpoint->seconds,
             std::move(checkpoint->integrator_state)};
    return start;
  }
  if (!o.like.empty()) {
    auto snapshot = image::read_exr(o.like);
    if (!snapshot) return snapshot.error();
    const auto state = snapshot->attributes.find(render::kStateAttribute);
    if (state == snapshot->attributes.end())
      return input_error(o.like + ": carries no settings; give an .exr that this program wrote");
    auto document = render::document_from_state(state->second, o.like, nullptr);
    if (!document) return document.error();
    start.document = std::move(*document);
    return start;
  }
  if (o.scene.empty())
    return usage_error("render: no scene; give a .gltf or .glb file, or one of " + scene::builtin_names());
  auto document = render::new_document(o.scene, o.camera);
  if (!document) return document.error();
  start.document = std::move(*document);
  return start;
}

Result<void> apply(const Options& o, render::Document& d) {
  const auto give = [&](const std::string& name, const std::string& value) { return set(d, name, value); };
  if (auto r = set_size(d, o.size); !r) return r;
  if (!o.integrator.empty())
    if (auto r = give("render.integrator", o.integrator); !r) return r;
  if (!o.sampler.empty())
    if (auto r = give("render.sampler", o.sampler); !r) return r;
  if (auto r = set_environment(d, o.env); !r) return r;
  if (auto r = set_all(d, o.sets); !r) return r;
  if (!o.paths.empty())
    if (auto r = give("film.paths", o.paths); !r) return r;
  if (o.max_depth >= 0)
    if (auto r = give("max-depth", std::to_string(o.max_depth)); !r) return r;
  if (o.seed >= 0)
    if (auto r = give("render.seed", std::to_string(o.seed)); !r) return r;
  if (!std::isnan(o.exposure))
    if (auto r = give("camera.exposure", std::to_string(o.exposure)); !r) return r;
  const std::string even = render::adaptive_incompatibility(d.method.integrator);
  if (d.method.adaptive != render::Adaptive::off && !even.empty()) return usage_error("render.adaptive: " + even);
  return {};
}

// What a resumed rendering may not change: everything that the film depends on.
bool changes_light(const Options& o) {
  return !o.size.empty() || !o.integrator.empty() || !o.sampler.empty() || !o.env.empty() || !o.sets.empty() ||
         !o.paths.empty() || o.max_depth >= 0 || o.seed >= 0 || !o.camera.empty();
}

void set_limits(const Options& o, bool inherits, render::Document& d) {
  if (o.spp > 0 || o.time > 0 || o.error > 0 || !inherits) d.limits = {o.spp, o.time, o.error};
  if (d.limits == render::Limits{}) d.limits.samples = 64;
}

Result<std::vector<std::string>> aov_list(const std::string& text) {
  std::vector<std::string> names;
  const auto& known = render::aov_names();
  for (const auto& name : CLI::detail::split(text, ',')) {
    if (name == "all") return known;
    if (!name.empty() && name != "sample-count" && std::find(known.begin(), known.end(), name) == known.end()) {
      std::string all = "sample-count";
      for (const auto& k : known) all += ", " + k;
      return usage_error("--aov: there is no '" + name + "'; there are " + all);
    }
    if (!name.empty()) names.push_back(name);
  }
  return names;
}

std::string progress_text(const render::Status& s) {
  char text[128];
  std::snprintf(text, sizeof text, "%u spp  %.2f Ms/s  %.2f Mrays/s", s.samples, s.paths_per_second * 1e-6,
                s.rays_per_second * 1e-6);
  std::string line = text;
  if (s.phase_progress > 0) {
    std::snprintf(text, sizeof text, "  %s %.0f %%", s.phase.c_str(), 100 * s.phase_progress);
    line += text;
  }
  if (s.error.known) {
    std::snprintf(text, sizeof text, "  rmse %.2g", s.error.rmse);
    line += text;
  }
  return line;
}

nlohmann::json number(std::optional<double> v) {
  return v && std::isfinite(*v) ? nlohmann::json(*v) : nlohmann::json();
}

nlohmann::json rejected_json(const film::InvalidSamples& rejected) {
  auto first = nlohmann::json::array();
  for (const auto& r : rejected.first)
    first.push_back({{"x", r.x}, {"y", r.y}, {"sample", r.sample}, {"kind", film::flaw_name(r.flaw)}});
  return {{"nan", rejected.nan}, {"infinite", rejected.infinite}, {"negative", rejected.negative}, {"first", first}};
}

nlohmann::json health_json(const render::Reliability& h) {
  return {{"verdict", render::verdict_name(h.verdict)},
          {"reason", h.reason},
          {"khat_heavy_share", h.heavy_share},
          {"khat_limit", film::khat_limit(h.samples)},
          {"khat_error", h.tail.khat ? number(h.tail.khat_error) : nlohmann::json()},
          {"vov", number(h.tail.vov)},
          {"brightest_share", number(h.tail.brightest)},
          {"samples", h.samples}};
}

// Little time goes into what the method may miss; nothing, if it declares to miss nothing.
constexpr double kCertificatePart = 0.1, kCertificateSeconds = 0.5;

std::string certificate_of(render::Session& session, const render::Document& d, const render::Status& s,
                           const film::Film& film) {
  const double seconds = std::min(kCertificateSeconds, kCertificatePart * s.seconds);
  const advisor::Evidence evidence{film.error(), film::relative_error(film), s.rejected, session.model(),
                                   s.reliability ? s.reliability->tail.khat : std::optional<double>()};
  return advisor::certificate_json(
      advisor::certificate(session, d, evidence, seconds, [](double, const std::string&) { return true; }));
}

nlohmann::json statistics_json(const std::vector<integrator::Statistic>& statistics) {
  nlohmann::json all = nlohmann::json::object();
  for (const auto& s : statistics) all[s.name] = {{"value", s.value}, {"unit", s.unit}, {"doc", s.doc}};
  return all;
}

nlohmann::json stats(const render::Document& d, const render::Status& s, const transport::Model& model, int threads,
                     const std::string& certificate) {
  nlohmann::json flags = nlohmann::json::object();
  for (const auto& decision : model.decisions)
    flags[decision.flag] = {{"value", decision.value}, {"reason", decision.reason}};
  return {{"integrator", d.method.integrator},
          {"sampler", d.method.sampler},
          {"spp", s.samples},
          {"seconds", s.seconds},
          {"rays", s.rays},
          {"statistics", statistics_json(s.statistics)},
          {"width", d.width},
          {"height", d.height},
          {"threads", threads},
          {"seed", d.seed},
          {"rmse_estimate", s.error.known ? nlohmann::json(s.error.rmse) : nlohmann::json()},
          {"rejected", rejected_json(s.rejected)},
          {"khat", s.reliability ? number(s.reliability->tail.khat) : nlohmann::json()},
          {"health", s.reliability ? health_json(*s.reliability) : nlohmann::json()},
          {"peak_rss_bytes", peak_memory()},
          {"model", flags},
          {"obstacle", s.incompatibility.empty() ? nlohmann::json() : nlohmann::json(s.incompatibility)},
          {"certificate", nlohmann::json::parse(certificate)}};
}

int run(const Options& o) {
  if (o.out.empty()) return fail(usage_error("render: no output; give -o FILE.exr, .hdr or .png"));
  if (auto ok = render::check_output_name(o.out); !ok) return fail(ok.error());
  if (!o.png.empty())
    if (auto ok = render::check_output_name(o.png); !ok) return fail(ok.error());
  if (!o.resume.empty() && changes_light(o))
    return fail(usage_error("--resume: a checkpoint goes on with its own settings; leave out what changes the image"));
  auto aovs = aov_list(o.aov);
  if (!aovs) return fail(aovs.error());
  auto start = starting_point(o);
  if (!start) return fail(start.error());
  render::Document& d = start->document;
  if (auto ok = apply(o, d); !ok) return fail(ok.error());
  set_limits(o, !o.like.empty() || !o.resume.empty(), d);
  for (const auto& warning : d.scene->warnings)
    std::fprintf(stderr, "etendue: %s: %s\n", d.scene_name.c_str(), warning.c_str());

  const std::atomic<bool>& interrupted = watch_interrupts();
  render::SessionOptions session_options;
  session_options.threads = o.threads;
  render::Session session(session_options);
  if (start->film)
    session.submit(d, {std::move(*start->film), std::move(start->integrator_state)});
  else
    session.submit(d);

  Progress progress;
  bool warned = false;
  const auto warn = [&](const render::Status& s) {
    if (!warned && !s.incompatibility.empty()) std::fprintf(stderr, "etendue: %s\n", s.incompatibility.c_str());
    warned = warned || !s.incompatibility.empty();
  };
  auto last_checkpoint = std::chrono::steady_clock::now();
  const std::string checkpoint_file = o.resume.empty() ? o.out + ".checkpoint" : o.resume;
  const auto save_checkpoint = [&]() -> Result<void> {
    const auto status = session.status();
    render::ResumePoint copy = session.resume_point();
    return render::write_checkpoint(
        checkpoint_file, {render::state_json(d, status.samples), std::move(copy.film), status.seconds + start->seconds,
                          std::move(copy.integrator_state)});
  };
  while (!session.status().finished && !interrupted) {
    std::this_thread::sleep_for(std::chrono::milliseconds(5));
    const auto status = session.status();
    warn(status);
    progress.show(status.progress, progress_text(status));
    const double since = std::chrono::duration<double>(std::chrono::steady_clock::now() - last_checkpoint).count();
    if (o.checkpoint > 0 && since >= o.checkpoint) {
      if (auto ok = save_checkpoint(); !ok) return fail(ok.error());
      last_checkpoint = std::chrono::steady_clock::now();
    }
  }
  session.stop();
  progress.finish();

  const auto status = session.status();
  warn(status);
  const film::Film film = session.film_copy();
  if (interrupted && o.checkpoint > 0)
    if (auto ok = save_checkpoint(); !ok) return fail(ok.error());
  render::Rendering rendering{d, film, status.samples, {}, session.reweighted_copy()};
  rendering.sample_counts = std::find(aovs->begin(), aovs->end(), "sample-count") != aovs->end();
  if (const auto compiled = session.scene(); compiled && !aovs->empty())
    rendering.layers = render::render_aovs(*compiled, d, *aovs, std::min(16u, std::max(1u, status.samples)), o.threads);
  const transport::Model model = session.model();
  const bool has_place = !o.json.empty() || !(o.out.ends_with(".png") || o.out.ends_with(".hdr"));
  if (has_place) rendering.certificate = certificate_of(session, d, status, film);
  if (auto ok = render::write_image(o.out, rendering); !ok) return fail(ok.error());
  if (!o.png.empty())
    if (auto ok = render::write_image(o.png, rendering); !ok) return fail(ok.error());
  if (!o.json.empty()) {
    const std::string text =
        stats(d, status, model, o.threads > 0 ? o.threads : static_cast<int>(std::thread::hardware_concurrency()),
              rendering.certificate)
            .dump(2) +
        "\n";
    if (o.json == "-")
      std::fputs(text.c_str(), stdout);
    else if (auto ok = write_file(o.json, text.data(), text.size()); !ok)
      return fail(ok.error());
  }
  if (status.reliability && status.reliability->verdict == render::Verdict::unreliable)
    std::fprintf(stderr, "etendue: %s: unreliable: %s\n", o.out.c_str(), status.reliability->reason.c_str());
  if (interrupted) {
    std::fprintf(stderr, "etendue: interrupted at %u spp; %s holds what there is\n", status.samples, o.out.c_str());
    return static_cast<int>(Fault::interrupted);
  }
  std::error_code code;
  if (o.checkpoint > 0 || !o.resume.empty()) std::filesystem::remove(checkpoint_file, code);
  return 0;
}

}  // namespace

Command add_render(CLI::App& app) {
  auto o = std::make_shared<Options>();
  app.add_option("scene", o->scene, "A .gltf or .glb file, or one of " + scene::builtin_names());
  app.add_option("-o,--out", o->out, "What to write: .exr (linear, with all settings), .hdr or .png (as displayed)");
  app.add_option("--png", o->png, "The same picture once more, as displayed");
  app.add_option("--spp", o->spp, "Samples per pixel (64 if no limit is given)")->check(CLI::Range(1u, 1000000u));
  app.add_option("--time", o->time, "Seconds of rendering")->check(CLI::PositiveNumber);
  app.add_option("--error", o->error, "Stop at this estimated RMSE")->check(CLI::PositiveNumber);
  app.add_option("--integrator", o->integrator, "See 'etendue list integrators'");
  app.add_option("--sampler", o->sampler, "See 'etendue list samplers'");
  app.add_option("--set", o->sets, "NAME=VALUE: any setting by name; repeatable")->take_all();
  app.add_option("--size", o->size, "WIDTHxHEIGHT");
  app.add_option("--camera", o->camera, "A camera of the scene by name or index");
  app.add_option("--seed", o->seed, "Another seed is independent noise")->check(CLI::NonNegativeNumber);
  app.add_option("--threads", o->threads, "0: one per hardware thread")->check(CLI::Range(0, 1024));
  app.add_option("--max-depth", o->max_depth, "Path segments from camera to light; 0 is no limit")
      ->check(CLI::Range(0, 1000));
  app.add_option("--paths", o->paths, "Only light paths that match this expression, e.g. 'E(D|G)L' or 'EDS+L'");
  app.add_option("--aov", o->aov, "Layers to add, comma separated, or 'all'");
  app.add_option("--env", o->env, "Environment map, .hdr or .exr");
  app.add_option("--exposure", o->exposure, "EV, for .png")->check(CLI::Range(-30.0, 30.0));
  app.add_option("--json", o->json, "Statistics as JSON; '-' is standard output");
  app.add_option("--checkpoint", o->checkpoint, "Seconds between checkpoints, written to OUT.checkpoint")
      ->check(CLI::PositiveNumber);
  app.add_option("--resume", o->resume, "Go on from a checkpoint");
  app.add_option("--like", o->like, "Take all settings from an .exr of this program");
  return [o] { return run(*o); };
}

}  // namespace etendue::cli
