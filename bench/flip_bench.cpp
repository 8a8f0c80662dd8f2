// Time of FLIP for one megapixel on one thread. The bound is one second.
#include <benchmark/benchmark.h>

#include "base/hash.h"
#include "metrics/flip.h"

namespace {

using namespace etendue;

void flip(benchmark::State& state) {
  constexpr int kSide = 1024;
  std::vector<float> a(size_t{3} * kSide * kSide), b(a.size());
  for (size_t i = 0; i < a.size(); ++i) {
    a[i] = to_unit_float(hash_combine(1, static_cast<uint32_t>(i)));
    b[i] = to_unit_float(hash_combine(2, static_cast<uint32_t>(i)));
  }
  for (auto _ : state) benchmark::DoNotOptimize(metrics::flip_map(kSide, kSide, a, b));
  state.SetItemsProcessed(state.iterations() * kSide * kSide);
}
BENCHMARK(flip)->Unit(benchmark::kMillisecond);

}  // namespace

BENCHMARK_MAIN();
