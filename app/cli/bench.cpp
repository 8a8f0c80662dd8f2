// etendue bench: errors of several methods over time, against a reference.
#include "bench/report.h"

#include <CLI/CLI.hpp>
#include <cmath>
#include <cstdio>
#include <filesystem>
#include <memory>
#include <optional>
#include <thread>

#include "bench/benchmark.h"
#include "command.h"
#include "interrupt.h"
#include "progress.h"
#include "scene/builtin/builtin.h"
#include "settings.h"

namespace etendue::cli {
namespace {

struct Options {
  std::string scene, methods, out, reference, size, camera, env;
  std::vector<std::string> sets;
  double budget = 0, reference_time = 0;
  uint32_t samples = 0, reference_samples = 0;
  int repeats = 3, threads = 0;
  uint64_t seed = 0;
  bool no_cache = false;
};

// Without a size it is the reference's, if one is given.
std::string size_of(const Options& o, const std::optional<bench::Reference>& given) {
  if (!o.size.empty() || !given) return o.size;
  return std::to_string(given->image.width) + "x" + std::to_string(given->image.height);
}

Result<render::Document> open(const Options& o, const std::optional<bench::Reference>& given) {
  auto document = render::new_document(o.scene, o.camera);
  if (!document) return document;
  if (auto r = set_size(*document, size_of(o, given)); !r) return r.error();
  if (auto r = set_environment(*document, o.env); !r) return r.error();
  if (auto r = set_all(*document, o.sets); !r) return r.error();
  return document;
}

// As long as all methods together, unless something else is asked for.
bench::ReferenceBudget effort_of(const Options& o, size_t methods) {
  if (o.reference_time > 0 || o.reference_samples > 0) return {o.reference_time, o.reference_samples};
  const double runs = static_cast<double>(methods) * o.repeats;
  if (o.budget > 0) return {o.budget * runs, 0};
  return {0, static_cast<uint32_t>(std::min(o.samples * runs, 1e9))};
}

// One bar for the reference and the methods.
class Meter {
 public:
  explicit Meter(const std::atomic<bool>& interrupted) : interrupted_(interrupted) {}

  // What comes next takes the part of the bar up to `end`.
  bench::Progress part(double begin, double end) {
    return [this, begin, end](double done, const std::string& what) {
      bar_.show(begin + done * (end - begin), what);
      return !interrupted_;
    };
  }
  void finish() { bar_.finish(); }

 private:
  const std::atomic<bool>& interrupted_;
  Progress bar_;
};

void say_what_is_uncertain(const bench::Outcome& outcome, const bench::Reference& reference) {
  if (!reference.noise) {
    std::fprintf(stderr, "etendue: the error of the reference is unknown; small errors may be the reference's\n");
    return;
  }
  if (!bench::reference_too_noisy(outcome, reference)) return;
  const double wanted = bench::required_reference_seconds(outcome, reference);
  std::string advice;
  if (wanted > 0) advice = "; --reference-time " + std::to_string(std::lround(wanted) + 1) + " would do";
  std::fprintf(stderr,
               "etendue: the reference is too noisy to tell: its standard error %.2g is not ten times smaller "
               "than the smallest error measured%s\n",
               reference.standard_error(), advice.c_str());
}

// Everything that is decided before the first ray: what cannot work fails before anything was rendered or written.
struct Job {
  render::Document document;
  bench::Plan plan;
  std::optional<bench::Reference> given;
};

Result<Job> prepare(const Options& o) {
  if (o.budget <= 0 && o.samples == 0) return usage_error("bench: no budget; give --budget SECONDS or --samples N");
  std::optional<bench::Reference> given;
  if (!o.reference.empty()) {
    auto read = bench::read_reference(o.reference);
    if (!read) return read.error();
    given = std::move(*read);
  }
  auto document = open(o, given);
  if (!document) return document.error();
  auto methods = bench::parse_methods(o.methods, *document);
  if (!methods) return methods.error();
  Job job{std::move(*document), {std::move(*methods), o.budget, o.samples, o.repeats, o.seed}, {}};
  if (given) {
    auto fitting = bench::resized_reference(std::move(*given), job.document.width, job.document.height);
    if (!fitting) return fitting.error();
    job.given = std::move(*fitting);
  }
  if (auto ok = bench::create_folder(o.out); !ok) return ok.error();
  return job;
}

// A reference that was made is left beside the report.
Result<void> write(const Options& o, const Job& job, bench::Reference& reference, const bench::Outcome& outcome) {
  if (!job.given) {
    reference.file = (std::filesystem::path(o.out) / "reference.exr").string();
    if (auto ok = image::write_exr(reference.file, reference.image); !ok) return ok;
  }
  const int threads = o.threads > 0 ? o.threads : static_cast<int>(std::thread::hardware_concurrency());
  return bench::write_report(o.out, {job.document, job.plan, reference, outcome, threads});
}

int run(const Options& o) {
  const auto job = prepare(o);
  if (!job) return fail(job.error());
  for (const auto& warning : job->document.scene->warnings)
    std::fprintf(stderr, "etendue: %s: %s\n", job->document.scene_name.c_str(), warning.c_str());

  Meter meter(watch_interrupts());
  render::SessionOptions session_options;
  session_options.threads = o.threads;
  render::Session session(session_options);
  const double begin = job->given ? 0 : 0.5;
  auto reference = job->given ? *job->given
                              : bench::render_reference(session, job->document, effort_of(o, job->plan.methods.size()),
                                                      o.no_cache ? "" : bench::cache_folder(), meter.part(0, begin));
  const auto outcome = bench::run(session, job->plan, reference, meter.part(begin, 1));
  meter.finish();

  if (auto ok = write(o, *job, reference, outcome); !ok) return fail(ok.error());
  if (outcome.interrupted) {
    std::fprintf(stderr, "etendue: interrupted; %s holds what was whole by then\n", o.out.c_str());
    return static_cast<int>(Fault::interrupted);
  }
  say_what_is_uncertain(outcome, reference);
  return 0;
}

}  // namespace

Command add_bench(CLI::App& app) {
  auto o = std::make_shared<Options>();
  app.add_option("scene", o->scene, "A .gltf or .glb file, or one of " + scene::builtin_names())->required();
  app.add_option("--methods", o->methods,
                 "integrator[:name=value]..., comma separated, as path:sampler=sobol,path-pure")
      ->required();
  app.add_option("--budget", o->budget, "Seconds of rendering of each method in each repeat")
      ->check(CLI::PositiveNumber);
  app.add_option("--samples", o->samples, "Samples per pixel instead of, or as well as, seconds")
      ->check(CLI::Range(1u, 1000000u));
  app.add_option("--repeats", o->repeats, "How often, with seeds of their own; error bars come from these")
      ->check(CLI::Range(1, 10000));
  app.add_option("-o,--out", o->out, "The folder to write into")->required();
  app.add_option("--reference", o->reference,
                 "The picture to measure against, of this size or a multiple; otherwise it is made and kept");
  app.add_option("--reference-time", o->reference_time,
                 "Seconds for making the reference; otherwise as long as all methods together")
      ->check(CLI::PositiveNumber);
  app.add_option("--reference-samples", o->reference_samples, "Samples per pixel of the reference instead of seconds")
      ->check(CLI::Range(1u, 1000000000u));
  app.add_flag("--no-cache", o->no_cache, "Make the reference anew and do not keep it");
  app.add_option("--size", o->size, "WIDTHxHEIGHT; otherwise the reference's, or the scene's own");
  app.add_option("--camera", o->camera, "A camera of the scene by name or index");
  app.add_option("--seed", o->seed, "Another seed is independent noise")->check(CLI::NonNegativeNumber);
  app.add_option("--threads", o->threads, "0: one per hardware thread")->check(CLI::Range(0, 1024));
  app.add_option("--set", o->sets, "NAME=VALUE: any setting of the scene by name; repeatable")->take_all();
  app.add_option("--env", o->env, "Environment map, .hdr or .exr");
  return [o] { return run(*o); };
}

}  // namespace etendue::cli
