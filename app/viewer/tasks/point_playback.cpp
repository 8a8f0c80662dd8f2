#include "viewer/tasks/point_playback.h"

#include <algorithm>
#include <cmath>

namespace etendue::viewer {
namespace {

using Seconds = std::chrono::duration<double>;
constexpr Seconds kDuration(10), kFrame(1.0 / 30);

}  // namespace

uint32_t points_at(double fraction, uint32_t count) {
  if (fraction >= 1) return count;
  return std::clamp(static_cast<uint32_t>(std::pow(count, std::max(fraction, 0.0))), uint32_t{1}, count);
}

void PointPlayback::toggle() {
  if (start_)
    start_.reset();
  else
    start_ = Clock::now();
}

uint32_t PointPlayback::shown(uint32_t count) {
  if (!start_ || count == 0) return count;
  drawn_ = Clock::now();
  const uint32_t points = points_at(Seconds(drawn_ - *start_) / kDuration, count);
  if (points == count) start_.reset();
  return points;
}

bool PointPlayback::wants_frames() const { return start_ && Clock::now() - *start_ < kDuration + 10 * kFrame; }

bool PointPlayback::has_update() const { return wants_frames() && Clock::now() - drawn_ >= kFrame; }

}  // namespace etendue::viewer
