// etendue advise: which method to use on a scene for an error, and for how long.
#include <CLI/CLI.hpp>
#include <cstdio>
#include <memory>

#include "advisor/report.h"
#include "command.h"
#include "interrupt.h"
#include "progress.h"
#include "scene/builtin/builtin.h"
#include "settings.h"

namespace etendue::cli {
namespace {

struct Options {
  std::string scene, size, camera, env, paths;
  std::vector<std::string> sets;
  advisor::AdviceRequest question;
  int threads = 0;
  bool json = false;
};

Result<render::Document> open(const Options& o) {
  auto document = render::new_document(o.scene, o.camera);
  if (!document) return document;
  if (auto r = set_size(*document, o.size); !r) return r.error();
  if (auto r = set_environment(*document, o.env); !r) return r.error();
  if (auto r = set_all(*document, o.sets); !r) return r.error();
  if (!o.paths.empty())
    if (auto r = set(*document, "film.paths", o.paths); !r) return r.error();
  return document;
}

int run(const Options& o) {
  const auto document = open(o);
  if (!document) return fail(document.error());
  for (const auto& warning : document->scene->warnings)
    std::fprintf(stderr, "etendue: %s: %s\n", document->scene_name.c_str(), warning.c_str());

  const std::atomic<bool>& interrupted = watch_interrupts();
  render::SessionOptions session_options;
  session_options.threads = o.threads;
  render::Session session(session_options);
  Progress bar;
  const auto ranking = advisor::advise(session, *document, o.question, [&](double done, const std::string& what) {
    bar.show(done, what);
    return !interrupted;
  });
  bar.finish();
  const std::string text =
      o.json ? advisor::ranking_json(ranking, document->scene_name) + "\n" : advisor::ranking_text(ranking);
  std::fputs(text.c_str(), stdout);
  return ranking.interrupted ? static_cast<int>(Fault::interrupted) : 0;
}

}  // namespace

Command add_advise(CLI::App& app) {
  auto o = std::make_shared<Options>();
  app.add_option("scene", o->scene, "A .gltf or .glb file, or one of " + scene::builtin_names())->required();
  app.add_option("--error", o->question.target, "The RMSE to reach")->required()->check(CLI::PositiveNumber);
  app.add_flag("--json", o->json, "Print JSON");
  app.add_option("--pilot", o->question.pilot_seconds, "Seconds of trying out each method, about")
      ->check(CLI::PositiveNumber);
  app.add_option("--size", o->size, "WIDTHxHEIGHT");
  app.add_option("--camera", o->camera, "A camera of the scene by name or index");
  app.add_option("--seed", o->question.seed, "Another seed is independent noise")->check(CLI::NonNegativeNumber);
  app.add_option("--threads", o->threads, "0: one per hardware thread")->check(CLI::Range(0, 1024));
  app.add_option("--set", o->sets, "NAME=VALUE: any setting by name; repeatable")->take_all();
  app.add_option("--paths", o->paths, "Only light paths that match this expression");
  app.add_option("--env", o->env, "Environment map, .hdr or .exr");
  return [o] { return run(*o); };
}

}  // namespace etendue::cli
