// Cost of a block of eight dimensions, by sampler: the block of the camera, the block of a path vertex, and a block
// beyond the dimensions of the low-discrepancy sequence.
//
// Pixel and sample index change between calls as in a rendering. `unprepared` uses sample indices outside the
// precomputed table.
#include <benchmark/benchmark.h>

#include "base/hash.h"
#include "sampling/sampler.h"

namespace etendue {
namespace {

constexpr uint32_t kPrepared = 64;

void draw(benchmark::State& state, const std::string& name, uint32_t block, uint32_t first) {
  const auto sampler = make_sampler(name);
  sampler->prepare(0, kPrepared);
  SampleBlock values;
  uint32_t call = 0;
  for (auto _ : state) {
    sampler->block(mix_bits(call / kPrepared), first + call % kPrepared, block, values);
    benchmark::DoNotOptimize(values);
    ++call;
  }
}

void register_all() {
  for (const auto& info : sampler_infos()) {
    const auto add = [&](const char* what, uint32_t block, uint32_t first) {
      benchmark::RegisterBenchmark((info.name + '/' + what).c_str(), draw, info.name, block, first);
    };
    add("camera", 0, 0);
    add("vertex", 3, 0);
    add("padded", 9, 0);
    add("unprepared", 3, 1'000'000);
  }
}

}  // namespace
}  // namespace etendue

int main(int argc, char** argv) {
  etendue::register_all();
  benchmark::Initialize(&argc, argv);
  benchmark::RunSpecifiedBenchmarks();
}
