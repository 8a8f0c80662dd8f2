#include "render/pixel_samples.h"

#include "base/hash.h"
#include "film/film.h"
#include "integrator/shared/camera_path_integrator.h"

namespace etendue::render {
namespace {

uint64_t seed_of(uint64_t seed, uint32_t replication) {
  return replication == 0 ? seed : mix_bits(seed ^ uint64_t{replication} << 32);
}

}  // namespace

bool PixelSamples::supports(const Document& document) {
  return integrator::find_integrator(document.method.integrator)->accumulation == integrator::Accumulation::per_pixel;
}

PixelSamples::PixelSamples(const Document& document, std::shared_ptr<const scene::CompiledScene> scene, Vec2i pixel)
    : prepared_(document, std::move(scene)), pixel_(pixel) {}

bool PixelSamples::draw(uint32_t first, uint32_t replication, std::span<Rgb> samples,
                        const std::function<bool()>& keep_going) {
  const auto state = prepared_.begin(prepared_.context(seed_of(prepared_.seed(), replication)));
  for (size_t i = 0; i < samples.size(); ++i) {
    const uint32_t sample = first + static_cast<uint32_t>(i);
    prepared_.prepare_sampler(sample / film::kHalfBuffers);
    if (!state->sample(block_of(sample), samples.subspan(i, 1), {&keep_going})) return false;
    if (!film::is_radiance(samples[i])) samples[i] = Rgb(0);
  }
  return true;
}

std::optional<DimensionCounts> PixelSamples::drawn_dimensions(uint32_t samples,
                                                              const std::function<bool()>& keep_going) {
  DimensionCounts counts;
  auto context = prepared_.context();
  const CountingSampler sampler(*context.sampler, counts);
  context.sampler = &sampler;
  const auto state = prepared_.begin(context);
  Rgb radiance;
  for (uint32_t sample = 0; sample < samples; ++sample) {
    prepared_.prepare_sampler(sample / film::kHalfBuffers);
    counts.begin_sample();
    if (!state->sample(block_of(sample), {&radiance, 1}, {&keep_going})) return {};
  }
  return counts;
}

std::vector<Dimension> path_dimensions(uint32_t vertices) {
  std::vector<Dimension> list{{"pixel-x", "Pixel x", 0, camera_dimension::kPixel},
                              {"pixel-y", "Pixel y", 0, camera_dimension::kPixel + 1},
                              {"lens-u", "Lens u", 0, camera_dimension::kLens},
                              {"lens-v", "Lens v", 0, camera_dimension::kLens + 1},
                              {"time", "Time", 0, camera_dimension::kTime}};
  for (uint32_t k = 1; k <= vertices; ++k) {
    const auto add = [&](const char* name, const char* label, int index) {
      const std::string number = std::to_string(k);
      list.push_back({"vertex-" + number + "." + name, "Vertex " + number + ": " + label, k, index});
    };
    add("direction-x", "BSDF direction x", vertex_dimension::kBsdfDirection);
    add("direction-y", "BSDF direction y", vertex_dimension::kBsdfDirection + 1);
    add("light-x", "light point x", vertex_dimension::kLightPoint);
    add("light-y", "light point y", vertex_dimension::kLightPoint + 1);
    add("light-choice", "light selection", vertex_dimension::kLightChoice);
    add("lobe", "lobe selection", vertex_dimension::kBsdfLobe);
    add("roulette", "Russian roulette", vertex_dimension::kRoulette);
  }
  return list;
}

std::vector<Vec2> sample_points(const Document& document, Vec2i pixel, const Dimension& x, const Dimension& y,
                                uint32_t count) {
  const auto sampler = sampler_of(document);
  std::vector<Vec2> points(count);
  SampleBlock block_x, block_y;
  for (uint32_t i = 0; i < count; ++i) {
    const uint32_t seed = integrator::PixelSeeds(*sampler, document.seed, i % film::kHalfBuffers)(pixel.x, pixel.y);
    const uint32_t sample = i / film::kHalfBuffers;
    if (sample % kTableSamples == 0) sampler->prepare(sample, kTableSamples);
    sampler->block(seed, sample, x.block, block_x);
    sampler->block(seed, sample, y.block, block_y);
    points[i] = {block_x[static_cast<size_t>(x.index)], block_y[static_cast<size_t>(y.index)]};
  }
  return points;
}

}  // namespace etendue::render
