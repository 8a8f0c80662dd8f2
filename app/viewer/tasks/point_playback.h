// Shows a number of points one by one, first slowly.
#pragma once
#include <chrono>
#include <cstdint>
#include <optional>

#include "viewer/tasks/task.h"

namespace etendue::viewer {

class PointPlayback final : public Task {
 public:
  // Starts, or ends and shows all points.
  void toggle();
  bool is_playing() const { return start_.has_value(); }
  // The number of points to draw in this frame, from 1 to `count`. Ends when all of them are shown.
  uint32_t shown(uint32_t count);

  void reset(const TaskContext&) override { start_.reset(); }
  bool has_update() const override;
  bool is_waiting() const override { return wants_frames(); }

 private:
  using Clock = std::chrono::steady_clock;

  // Not for longer than the points take, also if they are not drawn.
  bool wants_frames() const;

  std::optional<Clock::time_point> start_;
  Clock::time_point drawn_;
};

// The number of points after a fraction of the time: count^fraction.
uint32_t points_at(double fraction, uint32_t count);

}  // namespace etendue::viewer
