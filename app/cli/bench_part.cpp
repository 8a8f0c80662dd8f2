// Parts of etendue bench, and their union.
#include <cstdio>

#include "base/number_text.h"
#include "bench/measured_part.h"
#include "bench/reference_key.h"
#include "bench/report.h"
#include "bench_job.h"
#include "bench_progress.h"

namespace etendue::cli {
namespace {

constexpr const char* kSceneHash = "the hash of the scene and its settings";

std::string exact(double value) { return format_number(value, 17); }
std::string hexadecimal(unsigned long long value) { return format_text("%016llx", value); }

// What the results depend on.
job_part::Settings settings_of(const BenchArguments& a, const BenchJob& job, const bench::Reference& reference) {
  return {{"--methods", a.methods},
          {"--budget", exact(a.budget)},
          {"--samples", std::to_string(a.samples)},
          {"--repeats", std::to_string(a.repeats)},
          {"--seed", std::to_string(a.seed)},
          {"--error-measure", a.measure},
          {"the size", std::to_string(job.document.width) + "x" + std::to_string(job.document.height)},
          {"the number of threads", std::to_string(a.actual_threads())},
          {kSceneHash, hexadecimal(bench::image_key(job.document))},
          {"the number of samples of the reference", std::to_string(reference.samples)},
          {"the hash of the reference", hexadecimal(bench::hash_of(reference))}};
}

job_part::Settings arguments_of(const BenchArguments& a) {
  job_part::Settings list{{"scene", a.scene.scene},
                          {"--camera", a.scene.camera},
                          {"--env", a.scene.environment},
                          {"--reference", a.reference}};
  for (const std::string& setting : a.scene.settings) list.emplace_back("--set", setting);
  return list;
}

// The arguments that the parts of a set share; those that may differ are of the first.
BenchArguments arguments_from(const job_part::PartHeader& header) {
  const auto& s = header.settings;
  BenchArguments a;
  a.scene.scene = setting_of(header.arguments, "scene");
  a.scene.camera = setting_of(header.arguments, "--camera");
  a.scene.environment = setting_of(header.arguments, "--env");
  for (const auto& [name, value] : header.arguments)
    if (name == "--set") a.scene.settings.push_back(value);
  a.scene.size = setting_of(s, "the size");
  a.methods = setting_of(s, "--methods");
  a.measure = setting_of(s, "--error-measure");
  a.budget = number_of(setting_of(s, "--budget"));
  a.samples = static_cast<uint32_t>(integer_of(setting_of(s, "--samples")));
  a.repeats = static_cast<int>(integer_of(setting_of(s, "--repeats")));
  a.seed = integer_of(setting_of(s, "--seed"));
  return a;
}

}  // namespace

int run_bench_part(const BenchArguments& a) {
  const auto share = job_part::parse_share(a.part);
  if (!share) return fail(share.error());
  const auto job = prepare_bench(a);
  if (!job) return fail(job.error());
  if (!job->given_reference && reference_effort(a, job->plan.methods.size()).seconds > 0)
    return fail(
        usage_error("bench --part: all parts need the same reference, so its time cannot be limited; give --reference "
                    "FILE or --reference-samples N"));
  const auto path = job_part::new_part_path(a.out, *share);
  if (!path) return fail(path.error());
  print_warnings(job->document);
  BenchProgress progress(watch_interrupts());
  render::Session session({.threads = a.threads});
  const double methods_begin = job->given_reference ? 0 : kReferenceProgress;
  bench::MeasuredPart measured{.reference = reference_of(a, *job, session, progress.part(0, methods_begin)),
                               .threads = a.actual_threads(),
                               .outcome = {}};
  const auto [first, end] = share->range(bench::unit_count(job->plan));
  measured.outcome =
      bench::run_part(session, job->plan, first, end, measured.reference, progress.part(methods_begin, 1));
  progress.finish();
  if (measured.outcome.interrupted)
    return fail({Fault::interrupted, "interrupted; " + path->string() + " was not written"});
  const job_part::Part part{{.job = "bench",
                             .version = ETENDUE_VERSION,
                             .share = *share,
                             .settings = settings_of(a, *job, measured.reference),
                             .arguments = arguments_of(a)},
                            bench::bytes_of(measured)};
  if (auto ok = job_part::write_part(*path, part); !ok) return fail(ok.error());
  std::fprintf(stderr, "etendue: %s: %zu of %zu repeats\n", path->c_str(), end - first, bench::unit_count(job->plan));
  return 0;
}

int merge_bench(const job_part::PartSet& parts, const std::string& folder) {
  BenchArguments a = arguments_from(parts.header);
  a.out = folder;
  auto job = prepare_bench(a);
  if (!job) return fail(job.error());
  if (hexadecimal(bench::image_key(job->document)) != setting_of(parts.header.settings, kSceneHash))
    return fail(input_error(a.scene.scene + ": has changed since " + parts.files[0].string() +
                            " was computed; merge with the scene of the parts"));
  std::optional<bench::OutcomeBuilder> builder;
  bench::Reference reference;
  int threads = 0;
  for (const auto& file : parts.files) {
    const auto part = job_part::read_part(file);
    if (!part) return fail(part.error());
    auto measured =
        bench::measured_part_from(part->content, job->plan.methods.size(), job->document.width, job->document.height);
    if (!measured) return fail(job_part::damaged(file));
    if (!builder) {
      builder.emplace(job->plan, measured->outcome.incompatibilities);
      reference = std::move(measured->reference);
      threads = measured->threads;
    }
    for (auto& result : measured->outcome.repeats) builder->add(std::move(result));
  }
  if (auto ok = bench::create_folder(folder); !ok) return fail(ok.error());
  bench::set_display(reference, job->document.display.transform());
  if (reference.integrator.empty()) job->given_reference = reference;  // it was read from a file
  return write_bench(a, *job, std::move(reference), builder->take(false), threads);
}

}  // namespace etendue::cli
