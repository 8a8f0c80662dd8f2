// etendue advise: ranks the methods for a scene by the predicted time to a target error.
#include <cstdio>
#include <memory>

#include "advisor/advice_report.h"
#include "command.h"
#include "interrupt.h"
#include "progress_bar.h"
#include "scene_options.h"

namespace etendue::cli {
namespace {

struct AdviseArguments {
  SceneArguments scene;
  advisor::AdviceRequest question;
  int threads = 0;
  bool json = false;
};

int run_advise(const AdviseArguments& a) {
  const auto document = open_document(a.scene);
  if (!document) return fail(document.error());
  print_warnings(*document);
  const std::atomic<bool>& interrupted = watch_interrupts();
  render::Session session({.threads = a.threads});
  Progress progress;
  const auto ranking = advisor::advise(session, *document, a.question, [&](double done, const std::string& task) {
    progress.show(done, task);
    return !interrupted;
  });
  progress.finish();
  const std::string text =
      a.json ? advisor::ranking_json(ranking, document->scene_name) + "\n" : advisor::ranking_text(ranking);
  std::fputs(text.c_str(), stdout);
  return ranking.interrupted ? static_cast<int>(Fault::interrupted) : 0;
}

}  // namespace

Command advise_command() {
  const auto a = std::make_shared<AdviseArguments>();
  return {.name = "advise",
          .summary = "Rank the methods for a scene by the predicted time to a target error",
          .options = {scene_option(a->scene.scene),
                      {.names = "--error",
                       .target = &a->question.target,
                       .doc = "Target error (RMSE)",
                       .required = true,
                       .bounds = kPositive},
                      json_flag(a->json),
                      {.names = "--pilot",
                       .target = &a->question.pilot_seconds,
                       .doc = "Approximate duration of the pilot rendering of each method, in seconds",
                       .bounds = kPositive},
                      size_option(a->scene.size),
                      camera_option(a->scene.camera),
                      seed_option(a->question.seed),
                      threads_option(a->threads),
                      set_option(a->scene.settings),
                      paths_option(a->scene.paths),
                      environment_option(a->scene.environment)},
          .run = [a] { return run_advise(*a); }};
}

}  // namespace etendue::cli
