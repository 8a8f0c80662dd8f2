#include "render/pixel_trace.h"

#include <array>

#include "film/film.h"
#include "render/pixel_samples.h"

namespace etendue::render {
namespace {

using integrator::Accumulation;

std::string per_pixel_integrators() {
  std::string names;
  for (const auto& info : integrator::integrator_infos())
    if (info.accumulation == Accumulation::per_pixel) names += (names.empty() ? "" : ", ") + info.name;
  return names;
}

}  // namespace

std::string untraceable_reason(const Document& document) {
  if (PixelSamples::supports(document)) return {};
  const auto& info = *integrator::find_integrator(document.method.integrator);
  return info.accumulation == Accumulation::per_image
             ? "its samples depend on other pixels through photons, virtual lights or learned densities"
             : "its paths contribute to any pixel";
}

std::string why_untraceable(const Document& document) {
  const std::string reason = untraceable_reason(document);
  if (reason.empty()) return {};
  return "no sample of '" + document.method.integrator + "' belongs to one pixel: " + reason + "; use one of " +
         per_pixel_integrators();
}

Result<PixelTrace> trace_pixel(const Document& document, std::shared_ptr<const scene::CompiledScene> scene, Vec2i pixel,
                               uint32_t sample) {
  if (auto reason = why_untraceable(document); !reason.empty()) return usage_error(std::move(reason));
  if (pixel.x < 0 || pixel.y < 0 || pixel.x >= document.width || pixel.y >= document.height)
    return usage_error("pixel " + std::to_string(pixel.x) + "," + std::to_string(pixel.y) +
                       " lies outside of the image, which has " + std::to_string(document.width) + "x" +
                       std::to_string(document.height) + " pixels");
  PreparedDocument prepared(document, scene);
  prepared.prepare_sampler(sample / film::kHalfBuffers);
  const auto state = prepared.begin(prepared.context());
  const auto block = integrator::block_containing(pixel.x, pixel.y, document.width, document.height, sample);
  std::array<Rgb, integrator::PixelBlock::kMostPixels> radiance;
  transport::PathRecorder recorder(pixel);
  state->sample(block, radiance, {.recorder = &recorder});
  const auto index = static_cast<size_t>((pixel.y - block.y) * block.width + pixel.x - block.x);
  return PixelTrace{.pixel = pixel,
                    .sample = sample,
                    .integrator = document.method.integrator,
                    .scene = std::move(scene),
                    .record = recorder.record(),
                    .radiance = radiance[index]};
}

}  // namespace etendue::render
