// Parts of renderings. A part that is accepted adds counts and radiances that a part can have.
#include <cmath>

#include "base/file.h"
#include "integration/fuzz/memory_file.h"
#include "integration/fuzz/target.h"
#include "render/partial_result.h"
#include "render/tail_statistics.h"
#include "unit/image/file_bytes.h"

namespace etendue::fuzz {
namespace {

constexpr int kWidth = 5, kHeight = 4;

render::PartialSamples no_samples() {
  render::PartialSamples samples{film::Film(kWidth, kHeight), {}};
  samples.tails.resize(render::TailStatistics::tile_count(kWidth, kHeight));
  return samples;
}

void read_part(Input input) {
  const MemoryFile file(input);
  const auto info = render::read_part_info(file.path());
  if (!info || info->width != kWidth || info->height != kHeight) return;
  const auto part = render::load_part(file.path(), *info);
  if (!part) return;
  render::PartialSamples samples = no_samples();
  render::add_part(*part, *info, samples);
  for (int y = 0; y < kHeight; ++y)
    for (int x = 0; x < kWidth; ++x) {
      require(samples.film.samples(x, y) <= 2, "a pixel has too many samples");
      require(std::isfinite(samples.film.mean(x, y).r), "a radiance is not finite");
    }
}

Bytes part_of(uint32_t first, float radiance) {
  render::PartialSamples samples = no_samples();
  for (uint32_t s = first; s < first + 2; ++s)
    for (int x = 0; x < kWidth; ++x) samples.film.add(x, 1, s % 2, Rgb(radiance, 0.5f, 1e-30f));
  const test::TemporaryFile file("part.exr");
  const render::PartInfo info{.state = R"({"settings":{"render.seed":1}})",
                              .version = "1",
                              .width = kWidth,
                              .height = kHeight,
                              .blocks = {{first, first + 2, {0, 0, kWidth, kHeight}}}};
  require(static_cast<bool>(render::write_part(file.path(), info, samples)), "a seed cannot be written");
  const auto bytes = read_file(file.path());
  require(static_cast<bool>(bytes), "a seed cannot be read");
  return *bytes;
}

std::vector<Bytes> parts() { return {part_of(0, 0.1f), part_of(7, NAN)}; }

}  // namespace

const Target kTarget{.run = read_part, .seeds = parts};

}  // namespace etendue::fuzz
