// etendue bench: the error of several methods over time, against a reference.
#include <memory>

#include "bench/report.h"
#include "bench_job.h"
#include "bench_progress.h"
#include "command.h"

namespace etendue::cli {
namespace {

int run_bench(const BenchArguments& a) {
  if (!a.part.empty()) return run_bench_part(a);
  const auto job = prepare_bench(a);
  if (!job) return fail(job.error());
  if (auto ok = bench::create_folder(a.out); !ok) return fail(ok.error());
  print_warnings(job->document);
  BenchProgress progress(watch_interrupts());
  render::Session session({.threads = a.threads});
  const double methods_begin = job->given_reference ? 0 : kReferenceProgress;
  const auto reference = reference_of(a, *job, session, progress.part(0, methods_begin));
  const auto outcome = bench::run(session, job->plan, reference, progress.part(methods_begin, 1));
  progress.finish();
  return write_bench(a, *job, reference, outcome, a.actual_threads());
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
            .doc =
                "Methods separated by commas, INTEGRATOR[:NAME=VALUE]..., e.g. path:sampler=sobol,path-pure; another "
                "renderer is external:\"COMMAND {spp} {seed} {out}\"",
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
           part_option(a->part),
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
