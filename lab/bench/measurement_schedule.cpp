#include "bench/measurement_schedule.h"

#include "base/hash.h"
#include "metrics/metrics.h"

namespace etendue::bench {

uint64_t repeat_seed(uint64_t seed, size_t method, int repeat) {
  const uint64_t index = static_cast<uint64_t>(method) << 32 | static_cast<uint64_t>(repeat);
  return mix_bits(mix_bits(seed) ^ index) & 0x3fffffff;
}

uint32_t next_sample_count(uint32_t count) {
  if (count < 2) return count + 1;
  const bool is_power_of_two = (count & (count - 1)) == 0;
  return is_power_of_two ? count + count / 2 : count / 3 * 4;
}

metrics::ErrorPoint measure_error(std::span<const float> image, const Reference& reference, double seconds,
                                  uint32_t samples) {
  const auto m = metrics::metrics_of(image, reference.rgb());
  return {.seconds = seconds,
          .spp = static_cast<double>(samples),
          .mse = m.mse,
          .relmse = m.relmse,
          .bias = m.bias,
          .displayed_mse = metrics::displayed_mse(image, reference.rgb(), reference.display)};
}

}  // namespace etendue::bench
