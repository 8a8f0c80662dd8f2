#include "render/focus.h"

#include <algorithm>

#include "film/film_crop.h"
#include "integrator/integrator_info.h"
#include "integrator/pixel_block.h"

namespace etendue::render {

std::string focus_incompatibility(const Document& document) {
  const auto& info = *integrator::find_integrator(document.method.integrator);
  if (info.division.unit == integrator::DivisionUnit::none || !info.division.regions)
    return info.label + " samples the image as a whole. Use Path tracing or another integrator that samples pixels";
  if (document.method.adaptive != Adaptive::off)
    return "Adaptive sampling distributes the samples itself. Set render.adaptive to off";
  if (!document.part.is_whole()) return "Only a part of the image is rendered";
  return {};
}

PixelRect enclosing_blocks(const PixelRect& region, int image_width, int image_height) {
  using integrator::PixelBlock;
  const int left = region.x - region.x % PixelBlock::kWidth, top = region.y - region.y % PixelBlock::kHeight;
  const auto rounded_up = [](int value, int size) { return (value + size - 1) / size * size; };
  const int right = std::min(rounded_up(region.right(), PixelBlock::kWidth), image_width);
  const int bottom = std::min(rounded_up(region.bottom(), PixelBlock::kHeight), image_height);
  return {left, top, right - left, bottom - top};
}

double FocusMonitor::seconds_of(uint32_t samples) const {
  const uint32_t taken = std::max(samples, first_samples_ + 1) - first_samples_;
  return seconds_ / taken * samples;
}

void FocusMonitor::update(const film::Film& film, uint32_t samples, const std::function<bool()>& keep_going,
                          bool at_end) {
  if (!monitor_.is_error_due(samples) && !(at_end && !monitor_.is_error_current(samples))) return;
  const film::Film part = film::cropped(film, region_.x, region_.y, region_.width, region_.height);
  monitor_.measure_error(part, samples, seconds_of(samples), keep_going);
}

}  // namespace etendue::render
