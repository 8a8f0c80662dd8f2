#include "render/pixel_samples.h"

#include "integrator/shared/camera_path_integrator.h"
#include "render/renderer.h"

namespace etendue::render {
namespace {

// What a film does to a sample before it adds it.
Rgb accepted(const Rgb& radiance) {
  const bool rejected = !is_finite(radiance) || radiance.r < 0 || radiance.g < 0 || radiance.b < 0;
  return rejected ? Rgb(0) : radiance;
}

uint64_t seed_of(uint64_t seed, uint32_t half_buffer) {
  return half_buffer == 0 ? seed : mix_bits(seed ^ uint64_t{half_buffer} << 32);
}

}  // namespace

bool PixelSamples::supports(const Document& document) {
  return integrator::find_integrator(document.method.integrator)->accumulation == integrator::Accumulation::per_pixel;
}

PixelSamples::PixelSamples(const Document& document, std::shared_ptr<const scene::CompiledScene> scene, Vec2i pixel)
    : scene_(std::move(scene)),
      model_(transport::model_for(*scene_, document.forced_flags, document.method.paths)),
      sampler_(make_sampler(document.method.sampler, document.method.settings_of(document.method.sampler))),
      integrator_(integrator::make_integrator(document.method.integrator,
                                              document.method.settings_of(document.method.integrator))),
      camera_(document.camera, document.width, document.height, scene_->camera_motion()),
      filter_(document.filter),
      seed_(document.seed),
      width_(document.width),
      height_(document.height),
      pixel_(pixel) {}

void PixelSamples::prepare(uint32_t sample) {
  const uint32_t window = sample / film::kHalves / kTableSamples;
  if (window + 1 == prepared_) return;
  sampler_->prepare(window * kTableSamples, kTableSamples);
  prepared_ = window + 1;
}

bool PixelSamples::draw(uint32_t first, uint32_t half_buffer, std::span<Rgb> samples,
                        const std::function<bool()>& keep_going) {
  const integrator::RenderContext pass{
      scene_.get(), &model_, sampler_.get(), &camera_, &filter_, seed_of(seed_, half_buffer), width_, height_};
  const auto work = integrator_->begin(pass, nullptr);
  for (size_t i = 0; i < samples.size(); ++i) {
    const uint32_t sample = first + static_cast<uint32_t>(i);
    prepare(sample);
    if (!work->sample({pixel_.x, pixel_.y, 1, 1, sample}, samples.subspan(i, 1), {&keep_going})) return false;
    samples[i] = accepted(samples[i]);
  }
  return true;
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
    add("direction-x", "direction x", vertex_dimension::kBsdfDirection);
    add("direction-y", "direction y", vertex_dimension::kBsdfDirection + 1);
    add("light-x", "light point x", vertex_dimension::kLightPoint);
    add("light-y", "light point y", vertex_dimension::kLightPoint + 1);
    add("light-choice", "light choice", vertex_dimension::kLightChoice);
    add("lobe", "lobe", vertex_dimension::kBsdfLobe);
    add("roulette", "roulette", vertex_dimension::kRoulette);
  }
  return list;
}

std::vector<Vec2> sample_points(const Document& document, Vec2i pixel, const Dimension& x, const Dimension& y,
                                uint32_t count) {
  const auto sampler = make_sampler(document.method.sampler, document.method.settings_of(document.method.sampler));
  std::vector<Vec2> points(count);
  SampleBlock block_x, block_y;
  for (uint32_t i = 0; i < count; ++i) {
    const uint32_t seed = integrator::pixel_seed(document.seed, pixel.x, pixel.y, i % film::kHalves);
    const uint32_t sample = i / film::kHalves;
    if (sample % kTableSamples == 0) sampler->prepare(sample, kTableSamples);
    sampler->block(seed, sample, x.block, block_x);
    sampler->block(seed, sample, y.block, block_y);
    points[i] = {block_x[static_cast<size_t>(x.index)], block_y[static_cast<size_t>(y.index)]};
  }
  return points;
}

}  // namespace etendue::render
