#include "viewer/viewport/dark_image.h"

#include <algorithm>
#include <cmath>

#include "render/automatic_exposure.h"
#include "render/display_frame.h"
#include "render/document.h"
#include "scene/scene.h"

namespace etendue::viewer {
namespace {

constexpr uint32_t kMinSamples = 8;
constexpr float kBlack = 0.008f;       // displayed luminance, 23 of 255
constexpr float kDarkestShare = 0.5f;  // of the surfaces that are visible

}  // namespace

Darkness find_darkness(const render::Document& document, const scene::CompiledScene& scene,
                       const render::Frame& frame) {
  if (frame.samples < kMinSamples || frame.preview_scale > 1 || !frame.pixels) return Darkness::none;
  const auto luminances = render::surface_luminances(document, scene, *frame.pixels);
  if (luminances.empty()) {
    const Environment& environment = document.scene->environment;
    return environment.black() || !environment.visible ? Darkness::no_surfaces : Darkness::none;
  }
  const float limit = kBlack / std::exp2(document.display.exposure);
  const auto black = std::ranges::lower_bound(luminances, limit) - luminances.begin();
  const bool dark = static_cast<float>(black) > kDarkestShare * static_cast<float>(luminances.size());
  return dark ? Darkness::surfaces_are_black : Darkness::none;
}

}  // namespace etendue::viewer
