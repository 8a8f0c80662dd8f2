// The focus: a region of the image that receives all samples while the rest of the image keeps what it has.
//
// The samples of a pixel follow from its position and their numbers only, so a pixel in the focus has the same value as
// in an image of that many samples, and is unbiased. When the focus ends, the rest of the image catches up: the next
// samples are those of the pixels that have the fewest.
#pragma once
#include <cstdint>
#include <functional>
#include <optional>
#include <string>

#include "film/error_measure.h"
#include "render/document.h"
#include "render/error_monitor.h"

namespace etendue::render {

// The samples per pixel that the whole image receives before the focus begins: one in each half-buffer, so that its
// error is known.
inline constexpr uint32_t kSamplesBeforeFocus = 2;

// Why samples of the document cannot be restricted to a region, with a remedy; empty if they can.
std::string focus_incompatibility(const Document& document);

// The smallest rectangle of whole pixel blocks of an image that contains a region.
PixelRect enclosing_blocks(const PixelRect& region, int image_width, int image_height);

// What a session says about its focus.
struct FocusStatus {
  PixelRect region;
  uint32_t samples = 0;         // complete samples of every pixel of the region
  film::MeasuredError error;    // of the region, in the measure of the document's limits
  std::string incompatibility;  // why the region receives no samples of its own, or empty
};

// The error of the region while it is sampled.
class FocusMonitor {
 public:
  // `samples`: samples per pixel that the region has already. `independent` as in ErrorMonitor.
  FocusMonitor(ThreadPool& workers, const PixelRect& region, uint32_t samples, bool independent)
      : region_(region), first_samples_(samples), monitor_(workers) {
    monitor_.reset(independent);
  }

  const PixelRect& region() const { return region_; }
  const film::MeasuredError& error() const { return monitor_.measured(); }
  const TimeEstimator& estimator() const { return monitor_.estimator(); }
  void set_measure(film::ErrorMeasure measure, const film::DisplayTransform& display) {
    monitor_.set_measure(measure, display);
  }

  void add_seconds(double seconds) { seconds_ += seconds; }
  // The time in which the region alone would have received this many samples per pixel, at the speed of the focus.
  double seconds_of(uint32_t samples) const;

  // Measures the error if it is due after `samples` per pixel; with `at_end`, whenever there are new samples.
  void update(const film::Film& film, uint32_t samples, const std::function<bool()>& keep_going, bool at_end = false);

 private:
  PixelRect region_;
  uint32_t first_samples_;
  double seconds_ = 0;  // of sampling the region
  ErrorMonitor monitor_;
};

}  // namespace etendue::render
