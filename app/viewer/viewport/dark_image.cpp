#include "viewer/viewport/dark_image.h"

#include <cmath>

#include "render/automatic_exposure.h"
#include "render/display_frame.h"
#include "render/document.h"
#include "scene/scene.h"

namespace etendue::viewer {
namespace {

constexpr uint32_t kMinSamples = 8;
constexpr float kBlack = 0.008f;  // displayed luminance, 23 of 255

}  // namespace

Darkness find_darkness(const render::Document& document, const scene::CompiledScene& scene,
                       const render::Frame& frame) {
  if (frame.samples < kMinSamples || frame.preview_scale > 1 || !frame.pixels) return Darkness::none;
  const auto luminances = render::surface_luminances(document, scene, *frame.pixels);
  if (luminances.empty()) {
    const Environment& environment = document.scene->environment;
    return environment.black() || !environment.visible ? Darkness::no_surfaces : Darkness::none;
  }
  const bool dark = document.display.exposure < lowest_exposure(luminances);
  return dark ? Darkness::surfaces_are_black : Darkness::none;
}

float lowest_exposure(std::span<const float> luminances) {
  if (luminances.empty()) return -INFINITY;
  const float median = luminances[luminances.size() / 2];
  return median > 0 ? std::log2(kBlack / median) : INFINITY;
}

}  // namespace etendue::viewer
