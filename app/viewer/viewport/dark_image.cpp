#include "viewer/viewport/dark_image.h"

#include <algorithm>
#include <cmath>

#include "camera/camera_ray.h"
#include "render/display_frame.h"
#include "render/document.h"
#include "scene/compiled_scene.h"

namespace etendue::viewer {
namespace {

constexpr int kColumns = 24, kRows = 16;
constexpr uint32_t kMinSamples = 8;
constexpr float kBlack = 0.002f;       // displayed luminance
constexpr float kDarkestShare = 0.8f;  // of the surfaces that are visible

// The mean luminance of three times three pixels.
float luminance_around(const render::Frame& frame, int x, int y) {
  float sum = 0;
  int count = 0;
  for (int j = std::max(y - 1, 0); j <= std::min(y + 1, frame.height - 1); ++j)
    for (int i = std::max(x - 1, 0); i <= std::min(x + 1, frame.width - 1); ++i) {
      sum += luminance(
          (*frame.pixels)[static_cast<size_t>(j) * static_cast<size_t>(frame.width) + static_cast<size_t>(i)]);
      ++count;
    }
  return sum / static_cast<float>(count);
}

}  // namespace

Darkness find_darkness(const render::Document& document, const scene::CompiledScene& scene,
                       const render::Frame& frame) {
  if (frame.samples < kMinSamples || frame.preview_scale > 1 || !frame.pixels) return Darkness::none;
  Camera pinhole = document.camera;
  pinhole.lens_radius = 0;
  const CameraRays rays(pinhole, frame.width, frame.height);
  const float gain = std::exp2(document.display.exposure);
  int surfaces = 0, black = 0;
  for (int row = 0; row < kRows; ++row)
    for (int column = 0; column < kColumns; ++column) {
      const int x = (2 * column + 1) * frame.width / (2 * kColumns);
      const int y = (2 * row + 1) * frame.height / (2 * kRows);
      if (!scene.intersect(rays.ray(Vec2(x, y) + 0.5f, Vec2(0.5f)), 0)) continue;
      ++surfaces;
      if (gain * luminance_around(frame, x, y) < kBlack) ++black;
    }
  if (surfaces == 0) {
    const Environment& environment = document.scene->environment;
    return environment.black() || !environment.visible ? Darkness::no_surfaces : Darkness::none;
  }
  const bool dark = static_cast<float>(black) > kDarkestShare * static_cast<float>(surfaces);
  return dark ? Darkness::surfaces_are_black : Darkness::none;
}

}  // namespace etendue::viewer
