// The resolution of the preview frames after an edit: as fine as the time allows.
//
// At scale n one preview pixel covers n x n pixels of the image; scale 1 is the image itself. After a completed preview
// the next frame has a quarter of the scale; after a cancelled one, four times the scale.
#pragma once
#include <algorithm>
#include <cstddef>
#include <cstdint>

namespace etendue::render {

class PreviewResolution {
 public:
  int scale() const { return scale_; }
  bool is_coarsest() const { return scale_ == kCoarsest; }

  // Selects the finest scale at which a frame of an image with this many pixels is expected within `seconds`.
  void begin(size_t pixels, double seconds) {
    const double affordable = rate_ * seconds;  // paths
    scale_ = rate_ > 0 ? 1 : kCoarsest;
    while (static_cast<double>(pixels) / (scale_ * scale_) > affordable && !is_coarsest()) scale_ *= 2;
  }
  void begin_at_full_resolution() { scale_ = 1; }
  void frame_completed() { scale_ = scale_ > 4 ? scale_ / 4 : 1; }
  void frame_cancelled() { scale_ = std::min(4 * scale_, kCoarsest); }

  // Updates the expected speed. A lower measured speed applies at once, a higher one gradually.
  void add_measurement(uint64_t paths, double seconds) {
    if (seconds < 0.001) return;
    const double rate = static_cast<double>(paths) / seconds;
    rate_ = rate < rate_ || rate_ <= 0 ? rate : rate_ + 0.25 * (rate - rate_);
  }

 private:
  static constexpr int kCoarsest = 32;
  double rate_ = 0;  // paths per second
  int scale_ = 1;
};

}  // namespace etendue::render
