#include "bench_job.h"

#include <cmath>
#include <cstdio>
#include <filesystem>
#include <thread>

#include "advisor/method_choice.h"
#include "base/number_text.h"
#include "base/user_folders.h"
#include "bench/reference_method.h"
#include "bench/report.h"

namespace etendue::cli {
namespace {

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

bench::Reference computed_reference(const BenchArguments& a, const BenchJob& job, render::Session& session,
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

// A computed reference is written beside the report.
Result<void> write_results(const BenchArguments& a, const BenchJob& job, bench::Reference& reference,
                           const bench::Outcome& outcome, int threads) {
  if (!job.given_reference) {
    reference.file = (std::filesystem::path(a.out) / "reference.exr").string();
    if (auto ok = image::write_exr(reference.file, reference.image); !ok) return ok;
  }
  return bench::write_report(a.out, {job.document, job.plan, reference, outcome, threads, measure_of(a.measure)});
}

}  // namespace

int BenchArguments::actual_threads() const {
  return threads > 0 ? threads : static_cast<int>(std::thread::hardware_concurrency());
}

bench::ReferenceBudget reference_effort(const BenchArguments& a, size_t methods) {
  if (a.reference_time > 0 || a.reference_samples > 0) return {a.reference_time, a.reference_samples};
  const double renderings = static_cast<double>(methods) * a.repeats;
  if (a.budget > 0) return {2 * a.budget * renderings, 0};
  return {0, static_cast<uint32_t>(std::min(a.samples * renderings, 1e9))};
}

Result<BenchJob> prepare_bench(const BenchArguments& a) {
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
  BenchJob job{std::move(*document),
               {std::move(*methods), a.budget, a.samples, a.repeats, a.seed, chosen_method, a.threads},
               {}};
  if (given) {
    auto fitted = bench::resized_reference(std::move(*given), job.document.width, job.document.height);
    if (!fitted) return fitted.error();
    job.given_reference = std::move(*fitted);
  }
  return job;
}

bench::Reference reference_of(const BenchArguments& a, const BenchJob& job, render::Session& session,
                              const bench::Progress& progress) {
  auto reference = job.given_reference ? *job.given_reference : computed_reference(a, job, session, progress);
  bench::set_display(reference, job.document.display.transform());
  return reference;
}

int write_bench(const BenchArguments& a, const BenchJob& job, bench::Reference reference, const bench::Outcome& outcome,
                int threads) {
  if (auto ok = write_results(a, job, reference, outcome, threads); !ok) return fail(ok.error());
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

}  // namespace etendue::cli
