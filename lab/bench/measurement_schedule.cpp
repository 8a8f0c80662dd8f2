#include "bench/measurement_schedule.h"

#include "base/hash.h"
#include "metrics/metrics.h"

namespace etendue::bench {

uint64_t seed_of(uint64_t seed, size_t method, int repeat) {
  const uint64_t name = mix_bits(seed) ^ (static_cast<uint64_t>(method) << 32 | static_cast<uint64_t>(repeat));
  return mix_bits(name) & 0x3fffffff;
}

uint32_t next_count(uint32_t count) {
  if (count < 2) return count + 1;
  const bool power = (count & (count - 1)) == 0;
  return power ? count + count / 2 : count / 3 * 4;
}

metrics::ErrorPoint point_of(std::span<const float> picture, const Reference& reference, double seconds,
                             uint32_t samples) {
  const auto m = metrics::metrics_of(picture, reference.rgb());
  return {seconds, static_cast<double>(samples), m.mse, m.relmse, m.bias};
}

}  // namespace etendue::bench
