// etendue bench: the error of several methods over time, against a reference.
#include <cmath>
#include <cstdio>
#include <filesystem>
#include <memory>
#include <optional>
#include <thread>

#include "advisor/method_choice.h"
#include "base/number_text.h"
#include "base/user_folders.h"
#include "bench/benchmark.h"
#include "bench/reference_method.h"
#include "bench/report.h"
#include "command.h"
#include "interrupt.h"
#include "progress_bar.h"
#include "scene_options.h"

namespace etendue::cli {
namespace {

struct BenchArguments {
  SceneArguments scene;
  std::string methods, out, reference, measure = "rmse";
  double budget = 0, reference_time = 0;
  uint32_t samples = 0, reference_samples = 0;
  int repeats = 3, threads = 0;
  uint64_t seed = 0;
  bool no_cache = false;
};

// Effort for computing the reference. The default is twice the time, or the samples, of all methods together.
bench::ReferenceBudget reference_effort(const BenchArguments& a, size_t methods) {
  if (a.reference_time > 0 || a.reference_samples > 0) return {a.reference_time, a.reference_samples};
  const double renderings = static_cast<double>(methods) * a.repeats;
  if (a.budget > 0) return {2 * a.budget * renderings, 0};
  return {0, static_cast<uint32_t>(std::min(a.samples * renderings, 1e9))};
}

// One progress bar for the reference and the methods.
class BenchProgress {
 public:
  explicit BenchProgress(const std::atomic<bool>& interrupted) : interrupted_(interrupted) {}

  // The part of the bar from `begin` to `end`, both fractions.
  bench::Progress part(double begin, double end) {
    return [this, begin, end](double done, const std::string& task) {
      progress_.show(begin + done * (end - begin), task);
      return !interrupted_;
    };
  }
  void finish() { progress_.finish(); }

 private:
  const std::atomic<bool>& interrupted_;
  Progress progress_;
};

// Warns if errors may be those of the reference.
void print_reference_warning(const bench::Outcome& outcome, const bench::Reference& reference) {
  if (!reference.noise) {
    std::fprintf(stderr,
                 "etendue: the error of the reference is unknown, so small errors may be errors of the reference\n");
    return;
  }
  if (!bench::reference_too_noisy(outcome, reference)) return;
  const double seconds = bench::required_reference_seconds(outcome, reference);
  std::string advice;
  if (seconds > 0) advice = "; use --reference-time " + std::to_string(std::lround(seconds) + 1);
  std::fprintf(stderr,
               "etendue: reference too noisy: its standard error is %s, and errors below %s are uncertain by more than "
               "5 %%%s\n",
               format_number(reference.standard_error(), 2).c_str(),
               format_number(metrics::smallest_certain_rmse(*reference.noise), 2).c_str(), advice.c_str());
}

Result<bench::ChosenMethod> chosen_method(render::Session& session, const render::Document& document,
                                          const bench::Progress& progress) {
  const auto choice = advisor::choose_method(session, document, progress);
  if (!choice) return choice.error();
  return bench::ChosenMethod{advisor::with_choice(document, *choice), choice->reason, choice->seconds,
                             choice->interrupted};
}

// Everything that can be checked before rendering. Wrong arguments fail before anything is rendered or written.
struct Job {
  render::Document document;
  bench::Plan plan;
  std::optional<bench::Reference> given_reference;
};

Result<Job> prepare(const BenchArguments& a) {
  if (a.budget <= 0 && a.samples == 0) return usage_error("bench: no budget; give --budget SECONDS or --samples N");
  std::optional<bench::Reference> given;
  if (!a.reference.empty()) {
    auto read = bench::read_reference(a.reference);
    if (!read) return read.error();
    given = std::move(*read);
  }
  SceneArguments scene = a.scene;
  if (scene.size.empty() && given)
    scene.size = std::to_string(given->image.width) + "x" + std::to_string(given->image.height);
  auto document = open_document(scene);
  if (!document) return document.error();
  auto methods = bench::parse_methods(a.methods, *document);
  if (!methods) return methods.error();
  Job job{std::move(*document), {std::move(*methods), a.budget, a.samples, a.repeats, a.seed, chosen_method}, {}};
  if (given) {
    auto fitted = bench::resized_reference(std::move(*given), job.document.width, job.document.height);
    if (!fitted) return fitted.error();
    job.given_reference = std::move(*fitted);
  }
  if (auto ok = bench::create_folder(a.out); !ok) return ok.error();
  return job;
}

// A computed reference is written beside the report.
Result<void> write_results(const BenchArguments& a, const Job& job, bench::Reference& reference,
                           const bench::Outcome& outcome) {
  if (!job.given_reference) {
    reference.file = (std::filesystem::path(a.out) / "reference.exr").string();
    if (auto ok = image::write_exr(reference.file, reference.image); !ok) return ok;
  }
  const int threads = a.threads > 0 ? a.threads : static_cast<int>(std::thread::hardware_concurrency());
  return bench::write_report(a.out, {job.document, job.plan, reference, outcome, threads, measure_of(a.measure)});
}

bench::Reference computed_reference(const BenchArguments& a, const Job& job, render::Session& session,
                                    const bench::Progress& progress) {
  constexpr double kPilotShare = 0.05;  // of the reference's time, for each candidate
  const bench::ReferenceBudget effort = reference_effort(a, job.plan.methods.size());
  // With a number of samples, results are to be reproducible, and pilots are timed.
  const std::string integrator =
      effort.seconds > 0 ? bench::reference_integrator(session, job.document, job.plan.methods,
                                                       std::clamp(kPilotShare * effort.seconds, 0.05, 5.0), progress)
                         : "path";
  return bench::render_reference(session, job.document, effort, a.no_cache ? "" : cache_folder(), progress, integrator);
}

int run_bench(const BenchArguments& a) {
  const auto job = prepare(a);
  if (!job) return fail(job.error());
  print_warnings(job->document);
  BenchProgress progress(watch_interrupts());
  render::Session session({.threads = a.threads});
  const double methods_begin = job->given_reference ? 0 : 0.67;
  auto reference = job->given_reference ? *job->given_reference
                                        : computed_reference(a, *job, session, progress.part(0, methods_begin));
  bench::set_display(reference, job->document.display.transform());
  const auto outcome = bench::run(session, job->plan, reference, progress.part(methods_begin, 1));
  progress.finish();

  if (auto ok = write_results(a, *job, reference, outcome); !ok) return fail(ok.error());
  if (outcome.interrupted) {
    std::fprintf(stderr, "etendue: interrupted; %s holds the results so far\n", a.out.c_str());
    return static_cast<int>(Fault::interrupted);
  }
  for (const auto& method : outcome.methods) {
    if (!method.incompatibility.empty())
      std::fprintf(stderr, "etendue: %s: not measured: %s\n", method.curves.name.c_str(),
                   method.incompatibility.c_str());
    for (const std::string& reason : method.choices)
      std::fprintf(stderr, "etendue: %s: %s\n", method.curves.name.c_str(), reason.c_str());
  }
  print_reference_warning(outcome, reference);
  return 0;
}

}  // namespace

Command bench_command() {
  const auto a = std::make_shared<BenchArguments>();
  return {
      .name = "bench",
      .summary = "Compare methods: error over time against a reference",
      .options =
          {scene_option(a->scene.scene),
           {.names = "--methods",
            .target = &a->methods,
            .doc = "Methods separated by commas, INTEGRATOR[:NAME=VALUE]..., e.g. path:sampler=sobol,path-pure; auto: "
                   "chosen "
                   "for each repeat; another renderer: external:\"COMMAND {spp} {seed} {out}\"",
            .required = true},
           {.names = "--budget",
            .target = &a->budget,
            .doc = "Rendering time of each method in each repeat, in seconds",
            .bounds = kPositive},
           {.names = "--samples",
            .target = &a->samples,
            .doc = "Samples per pixel of each repeat, instead of or in addition to --budget",
            .bounds = between(1, 1'000'000)},
           {.names = "--repeats",
            .target = &a->repeats,
            .doc = "Independent repeats of each method, from which error bars are computed (3)",
            .bounds = between(1, 10'000)},
           error_measure_option(a->measure, "Measure of the charts: rmse, relative or displayed (rmse)"),
           {.names = "-o,--out", .target = &a->out, .doc = "Folder for the results", .required = true},
           {.names = "--reference",
            .target = &a->reference,
            .doc = "Reference image, of the image's size or a multiple of it; by default it is computed and cached"},
           {.names = "--reference-time",
            .target = &a->reference_time,
            .doc = "Rendering time of the reference in seconds; by default twice that of all methods together",
            .bounds = kPositive},
           {.names = "--reference-samples",
            .target = &a->reference_samples,
            .doc = "Samples per pixel of the reference, instead of --reference-time",
            .bounds = between(1, 1'000'000'000)},
           {.names = "--no-cache",
            .target = &a->no_cache,
            .doc = "Compute the reference again and do not store it in the cache"},
           {.names = "--size",
            .target = &a->scene.size,
            .doc = "Size of the images in pixels, WIDTHxHEIGHT; by default that of the reference or of the scene"},
           camera_option(a->scene.camera),
           seed_option(a->seed),
           threads_option(a->threads),
           set_option(a->scene.settings),
           environment_option(a->scene.environment)},
      .run = [a] { return run_bench(*a); }};
}

}  // namespace etendue::cli
