// The luminance of the visible surfaces, an exposure at which they are neither dark nor clipped, and their contrast with
// the backdrop.
#pragma once
#include <optional>
#include <span>
#include <vector>

#include "scene/forward.h"
#include "spectrum/rgb.h"

namespace etendue::render {

struct Document;

// The luminances at the pixels of a regular grid where a pinhole camera sees a surface, sorted in ascending order. Each
// is the mean of three times three pixels. `pixels` is the image of the document: linear radiance, row by row.
std::vector<float> surface_luminances(const Document& document, const scene::CompiledScene& scene,
                                      std::span<const Rgb> pixels);

// The share of these surfaces that contrast little with the backdrop behind them, with a factor on the brightness of that:
// whose displayed values differ by less than 30 of 255.
float share_like_backdrop(const Document& document, const scene::CompiledScene& scene, std::span<const Rgb> pixels,
                          float factor);

// The exposure in EV that displays the 90th percentile of these luminances at 0.6, in steps of half a stop. Nothing if
// no surface is bright enough to judge.
std::optional<float> automatic_exposure(std::span<const float> luminances);

// Whether the 90th percentile is displayed so dark, or so far above white, that `exposure` should be changed.
bool exposure_is_unsuitable(std::span<const float> luminances, float exposure);

}  // namespace etendue::render
