// How often the picture on screen is worth drawing again while samples come in and nobody touches anything.
#pragma once
#include <algorithm>
#include <cstdint>

namespace etendue::viewer {

class Pacing {
 public:
  // Under software OpenGL drawing and rendering share the processor: drawing gets at most one part in so many.
  static constexpr double kParts = 14, kLongest = 1;

  void drew(double seconds) { cost_ += kNews * (seconds - cost_); }
  double cost() const { return cost_; }

  // Seconds from one drawing to the next: the more samples, the less a new frame differs from the one on screen.
  double interval(uint32_t samples) const {
    const double worthwhile = samples < 32 ? 0.1 : samples < 256 ? 0.25 : 0.5;
    return std::clamp(kParts * cost_, worthwhile, kLongest);
  }

 private:
  static constexpr double kNews = 0.4;  // one slow drawing is no rule
  double cost_ = 0;
};

}  // namespace etendue::viewer
