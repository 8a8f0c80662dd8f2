// The redraw interval while samples accumulate and there is no user input.
#pragma once
#include <algorithm>
#include <cstdint>

namespace etendue::viewer {

class Pacing {
 public:
  // With software OpenGL, drawing and rendering compete for the processor. Drawing gets at most 1/14 of the time.
  static constexpr double kIntervalPerCost = 14;
  static constexpr double kMaxInterval = 1;  // seconds

  // Records the seconds that one redraw took.
  void add_redraw(double seconds) { cost_ += kSmoothing * (seconds - cost_); }

  // Seconds between two redraws. With more samples per pixel, successive frames differ less.
  double interval(uint32_t samples) const {
    const double min_interval = samples < 32 ? 0.1 : samples < 256 ? 0.25 : 0.5;
    return std::clamp(kIntervalPerCost * cost_, min_interval, kMaxInterval);
  }

 private:
  static constexpr double kSmoothing = 0.4;  // weight of the latest redraw in the moving average
  double cost_ = 0;                          // moving average of the redraw time, seconds
};

}  // namespace etendue::viewer
