#include "render/automatic_exposure.h"

#include <algorithm>
#include <cmath>

#include "camera/camera_ray.h"
#include "render/document.h"
#include "scene/compiled_scene.h"

namespace etendue::render {
namespace {

constexpr int kColumns = 48, kRows = 32;
constexpr float kTarget = 0.6f;                       // displayed luminance of the 90th percentile
constexpr float kDarkest = 0.06f, kBrightest = 2.5f;  // beyond them, the exposure is unsuitable
constexpr float kMinLuminance = 1e-9f;
constexpr float kLeastContrast = 30 / 255.0f;

// The mean luminance of three times three pixels. NaN counts as black.
float luminance_around(std::span<const Rgb> pixels, Vec2i size, Vec2i center) {
  float sum = 0;
  int count = 0;
  for (int y = std::max(center.y - 1, 0); y <= std::min(center.y + 1, size.y - 1); ++y)
    for (int x = std::max(center.x - 1, 0); x <= std::min(center.x + 1, size.x - 1); ++x) {
      const size_t index = static_cast<size_t>(y) * static_cast<size_t>(size.x) + static_cast<size_t>(x);
      const float value = luminance(pixels[index]);
      sum += value > 0 ? value : 0;
      ++count;
    }
  return sum / static_cast<float>(count);
}

// The 90th percentile; 0 if there are no values.
float highlights(std::span<const float> sorted) { return sorted.empty() ? 0 : sorted[sorted.size() * 9 / 10]; }

// Calls visit(ray, luminance) at the pixels of a regular grid where a pinhole camera sees a surface.
template <class Visit>
void for_each_surface(const Document& document, const scene::CompiledScene& scene, std::span<const Rgb> pixels,
                      Visit&& visit) {
  Camera pinhole = document.camera;
  pinhole.lens_radius = 0;
  const Vec2i size(document.width, document.height);
  const CameraRays rays(pinhole, size.x, size.y);
  for (int row = 0; row < kRows; ++row)
    for (int column = 0; column < kColumns; ++column) {
      const Vec2i at((2 * column + 1) * size.x / (2 * kColumns), (2 * row + 1) * size.y / (2 * kRows));
      const Ray ray = rays.ray(Vec2(at) + 0.5f, Vec2(0.5f));
      if (scene.intersect(ray, 0)) visit(ray, luminance_around(pixels, size, at));
    }
}

}  // namespace

std::vector<float> surface_luminances(const Document& document, const scene::CompiledScene& scene,
                                      std::span<const Rgb> pixels) {
  std::vector<float> luminances;
  for_each_surface(document, scene, pixels, [&](const Ray&, float luminance) { luminances.push_back(luminance); });
  std::ranges::sort(luminances);
  return luminances;
}

float share_like_backdrop(const Document& document, const scene::CompiledScene& scene, std::span<const Rgb> pixels,
                          float factor) {
  const Display& display = document.display;
  const auto level = [&](float luminance) {
    return image::displayed(Rgb(luminance), display.exposure, display.curve).g;
  };
  int surfaces = 0, alike = 0;
  for_each_surface(document, scene, pixels, [&](const Ray& ray, float surface) {
    const float backdrop = factor * luminance(scene.lights().environment().seen_radiance(ray.direction));
    ++surfaces;
    alike += std::abs(level(surface) - level(backdrop)) < kLeastContrast ? 1 : 0;
  });
  return surfaces > 0 ? static_cast<float>(alike) / static_cast<float>(surfaces) : 0;
}

std::optional<float> automatic_exposure(std::span<const float> luminances) {
  const float bright = highlights(luminances);
  if (!(bright > kMinLuminance) || !std::isfinite(bright)) return {};
  return std::round(2 * std::log2(kTarget / bright)) / 2 + 0.0f;  // not -0
}

bool exposure_is_unsuitable(std::span<const float> luminances, float exposure) {
  const float displayed = std::exp2(exposure) * highlights(luminances);
  return displayed < kDarkest || displayed > kBrightest;
}

}  // namespace etendue::render
