// Renderings on many ranks: bytes and duration of adding a result on rank 0, and a simulation with up to 1000
// ranks that uses the schedule of the program.
//
//   build/release/bench/cluster_bench
#include <chrono>
#include <cstdio>

#include "cluster/piece_renderer.h"
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

void print_run(const char* name, const SimulatedJob& job) {
  const SimulatedRun run = simulate(job);
  std::printf("%-24s %6d %9.0f %7.1f%% %7.1f%% %7.1f%% %9.1f %8u %6d\n", name, job.ranks, run.seconds,
              100 * run.utilisation, 100 * run.merging, 100 * run.receiving, run.bytes * 1e-9, run.repeated,
              run.dead_ranks);
}

}  // namespace
}  // namespace etendue::test

int main() {
  using namespace etendue::test;
  std::printf("%-12s %12s %12s\n", "image", "MB/result", "ms/result");
  Costs costs{};
  for (const auto& [width, height] : {std::pair(480, 270), std::pair(960, 540), std::pair(1920, 1080)}) {
    costs = measure_costs(width, height);
    std::printf("%4d x %-5d %12.1f %12.1f\n", width, height, costs.bytes * 1e-6, costs.seconds * 1e3);
  }
  std::printf("\n%-24s %6s %9s %8s %8s %8s %9s %8s %6s\n", "1920 x 1080", "ranks", "seconds", "used", "merging", "link",
              "GB", "repeated", "dead");
  for (const int ranks : {1, 4, 16, 64, 256, 1000}) {
    // Half an hour per rank if all of its time is used.
    SimulatedJob job{.ranks = ranks, .samples = static_cast<uint32_t>(900 * ranks), .seconds_per_sample = 2};
    job.bytes_per_result = costs.bytes;
    job.merge_seconds = costs.seconds;
    print_run("equal ranks", job);
    job.speed_spread = 0.3;
    print_run("unequal speeds", job);
    job.slow_pieces = 0.01;
    job.lifetime = 36'000;
    job.damaged_results = 0.001;
    print_run("with failures", job);
  }
}
