// etendue advise: ranks the methods for a scene by the predicted time to a target error.
#include <cstdio>
#include <memory>

#include "advisor/advice_report.h"
#include "base/number_text.h"
#include "command.h"
#include "interrupt.h"
#include "progress_bar.h"
#include "scene_options.h"

namespace etendue::cli {
namespace {

struct AdviseArguments {
  SceneArguments scene;
  advisor::AdviceRequest question;
  std::string measure = "rmse";
  int threads = 0;
  bool json = false;
  bool all = false;
};

constexpr size_t kListed = 5;  // methods in a short list

int run_advise(const AdviseArguments& a) {
  const auto document = open_document(a.scene);
  if (!document) return fail(document.error());
  print_warnings(*document);
  advisor::AdviceRequest request = a.question;
  request.measure = measure_of(a.measure);
  const std::atomic<bool>& interrupted = watch_interrupts();
  render::Session session({.threads = a.threads});
  Progress progress;
  const auto show_progress = [&](double done, const std::string& task) {
    progress.show(done, task);
    return !interrupted;
  };
  const auto print_plan = [&](size_t pilots, double seconds) {
    progress.finish();
    std::fprintf(stderr, "%zu pilots take at most about %s%s\n", pilots, format_duration(seconds).c_str(),
                 request.seconds > 0 ? "" : "; --time limits it");
  };
  const auto ranking = advisor::advise(session, *document, request, show_progress, {}, print_plan);
  progress.finish();
  const size_t listed = a.all ? ranking.methods.size() : kListed;
  const std::string text =
      a.json ? advisor::ranking_json(ranking, document->scene_name) + "\n" : advisor::ranking_text(ranking, listed);
  std::fputs(text.c_str(), stdout);
  if (!a.json && listed < ranking.methods.size()) std::fputs("--all lists every method with its reason\n", stdout);
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
                       .doc = "Target error; 0.01 is 1 % of a relative or displayed error",
                       .required = true,
                       .bounds = kPositive},
                      error_measure_option(a->measure, "Measure of --error: rmse, relative or displayed (rmse)"),
                      json_flag(a->json),
                      {.names = "--all", .target = &a->all, .doc = "List all methods instead of the five best"},
                      {.names = "--pilot",
                       .target = &a->question.pilot_seconds,
                       .doc = "Approximate duration of the pilot rendering of each method, in seconds",
                       .bounds = kPositive},
                      {.names = "--time",
                       .target = &a->question.seconds,
                       .doc = "Longest total time in seconds; less time gives less certain predictions",
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
