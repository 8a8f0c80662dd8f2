// Renderings on many ranks: bytes and duration of adding a result on rank 0, and a simulation with up to 1000
// ranks that uses the schedule of the program.
//
//   build/release/bench/cluster_bench [CHART.svg [MILLISECONDS]]
//
// CHART.svg receives a chart of the simulation. MILLISECONDS replaces the measured duration of adding a result of
// 1920 x 1080 pixels, to repeat a simulation.
#include <chrono>
#include <cstdio>
#include <cstdlib>
#include <fstream>
#include <utility>
#include <vector>

#include "cluster/piece_renderer.h"
#include "metrics/function_chart.h"
#include "support/cluster_simulation.h"

namespace etendue::test {
namespace {

struct Costs {
  double bytes, seconds;  // of one result
};

// The costs of reading a result and adding it to a film.
Costs measure_costs(int width, int height) {
  using Clock = std::chrono::steady_clock;
  auto document = render::new_document("cornell");
  document->width = width;
  document->height = height;
  cluster::PieceRenderer renderer(*document, 0);
  renderer.begin({1, {0, 4}});
  std::optional<cluster::PieceResult> result;
  while (!result) result = renderer.take_result();
  const auto bytes = cluster::bytes_of(*result);
  constexpr int kRepeats = 5;
  const auto start = Clock::now();
  for (int i = 0; i < kRepeats; ++i)
    cluster::add_samples(result->samples, cluster::piece_result_from(bytes, width, height)->samples);
  const double seconds = std::chrono::duration<double>(Clock::now() - start).count();
  return {static_cast<double>(bytes.size()), seconds / kRepeats};
}

SimulatedRun print_run(const char* name, const SimulatedJob& job) {
  const SimulatedRun run = simulate(job);
  std::printf("%-24s %6d %6d %9.0f %7.1f%% %7.1f%% %7.1f%% %9.1f %8u %6d %6u\n", name, job.ranks, run.collectors,
              run.seconds, 100 * run.utilisation, 100 * run.merging, 100 * run.receiving, run.bytes * 1e-9,
              run.repeated, run.dead_ranks, run.retired_collectors);
  return run;
}

// The jobs of one number of ranks: half an hour per rank if all of its time is used.
void simulate_jobs(int ranks, const Costs& costs, bool uses_collectors, std::vector<metrics::FunctionCurve>& curves) {
  SimulatedJob job{.ranks = ranks, .samples = static_cast<uint32_t>(900 * ranks), .seconds_per_sample = 2};
  job.bytes_per_result = costs.bytes;
  job.merge_seconds = costs.seconds;
  if (!uses_collectors) job.options.collectors = 0;
  print_run("equal ranks", job);
  const auto add = [&](size_t curve, const SimulatedRun& run) {
    curves[curve].points.push_back({static_cast<double>(ranks), 100 * run.utilisation});
  };
  job.speed_spread = 0.3;
  add(uses_collectors ? 0 : 1, print_run("unequal speeds", job));
  job.slow_pieces = 0.01;
  job.lifetime = 36'000;
  job.damaged_results = 0.001;
  add(uses_collectors ? 2 : 3, print_run("with failures", job));
}

}  // namespace
}  // namespace etendue::test

int main(int argc, char** argv) {
  using namespace etendue;
  using namespace etendue::test;
  std::printf("%-12s %12s %12s\n", "image", "MB/result", "ms/result");
  Costs costs{};
  for (const auto& [width, height] : {std::pair(480, 270), std::pair(960, 540), std::pair(1920, 1080)}) {
    costs = measure_costs(width, height);
    std::printf("%4d x %-5d %12.1f %12.1f\n", width, height, costs.bytes * 1e-6, costs.seconds * 1e3);
  }
  if (argc > 2) costs.seconds = 1e-3 * std::atof(argv[2]);
  std::printf("\n%-24s %6s %6s %9s %8s %8s %8s %9s %8s %6s %6s\n", "1920 x 1080", "ranks", "coll.", "seconds", "used",
              "merging", "link", "GB", "repeated", "dead", "lost");
  std::vector<metrics::FunctionCurve> curves{
      {.name = "with collectors", .points = {}},
      {.name = "without collectors", .style = metrics::CurveStyle::dashed, .points = {}},
      {.name = "with collectors, failures", .points = {}},
      {.name = "without collectors, failures", .style = metrics::CurveStyle::dashed, .points = {}}};
  for (const bool uses_collectors : {false, true})
    for (const int ranks : {1, 4, 16, 64, 256, 1000}) simulate_jobs(ranks, costs, uses_collectors, curves);
  if (argc < 2) return 0;
  const metrics::FunctionChart chart{.title = "Simulated ranks: images of 1920 x 1080 pixels, half an hour",
                                     .x_label = "ranks",
                                     .y_label = "time of ranks used (%)",
                                     .curves = std::move(curves),
                                     .logarithmic_x = true};
  std::ofstream(argv[1]) << metrics::to_svg(metrics::function_drawing(chart, {}));
  return 0;
}
