// The work of etendue bench, as a whole or in parts.
#pragma once
#include <optional>
#include <string>

#include "bench/benchmark.h"
#include "job_parts.h"
#include "scene_options.h"

namespace etendue::cli {

struct BenchArguments {
  SceneArguments scene;
  std::string methods, out, part, reference, measure = "rmse";
  double budget = 0, reference_time = 0;
  uint32_t samples = 0, reference_samples = 0;
  int repeats = 3, threads = 0;
  uint64_t seed = 0;
  bool no_cache = false;

  int actual_threads() const;
};

// Everything that can be checked before rendering.
struct BenchJob {
  render::Document document;
  bench::Plan plan;
  std::optional<bench::Reference> given_reference;
};

Result<BenchJob> prepare_bench(const BenchArguments& arguments);

// Effort for computing the reference. The default is twice the time, or the samples, of all methods together.
bench::ReferenceBudget reference_effort(const BenchArguments& arguments, size_t methods);

// The given reference, or a computed one.
bench::Reference reference_of(const BenchArguments& arguments, const BenchJob& job, render::Session& session,
                              const bench::Progress& progress);

// Writes the files and prints warnings. Returns the exit code. A computed reference is written beside the report.
int write_bench(const BenchArguments& arguments, const BenchJob& job, bench::Reference reference,
                const bench::Outcome& outcome, int threads);

// Renders the repeats of the part `arguments.part` and writes them. Returns the exit code.
int run_bench_part(const BenchArguments& arguments);

}  // namespace etendue::cli
