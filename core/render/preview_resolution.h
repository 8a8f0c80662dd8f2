// How coarse the first frames after an edit are: as fine as can be done in time.
//
// Scale n makes one pixel stand for n x n; 1 is the picture itself. Each frame that is done is followed by one two
// steps finer, one that had to be given up by one two steps coarser.
#pragma once
#include <algorithm>
#include <cstddef>
#include <cstdint>

namespace etendue::render {

class PreviewResolution {
 public:
  int scale() const { return scale_; }
  bool is_coarsest() const { return scale_ == kCoarsest; }

  // The finest scale at which a frame of so many pixels is expected within these seconds.
  void begin(size_t pixels, double seconds) {
    scale_ = rate_ > 0 ? 1 : kCoarsest;
    while (scale_<kCoarsest&& static_cast<double>(pixels) / (scale_ * scale_)> rate_ * seconds) scale_ *= 2;
  }
  void begin_with_the_picture() { scale_ = 1; }
  void done() { scale_ = scale_ > 4 ? scale_ / 4 : 1; }
  void cancelled() { scale_ = std::min(4 * scale_, kCoarsest); }

  // What first frames can count on: bad news is believed at once, good news by and by.
  void note(uint64_t paths, double seconds) {
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
