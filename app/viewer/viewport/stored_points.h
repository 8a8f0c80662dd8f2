// The photons or virtual point lights that an integrator has stored, as points over the image. Points that are hidden
// by a surface are left out.
#pragma once
#include <chrono>
#include <functional>
#include <memory>
#include <vector>

#include "base/vec.h"
#include "spectrum/rgb.h"
#include "viewer/tasks/background_task.h"

namespace etendue::render {
class Session;
}

namespace etendue::viewer {

class Editor;

struct VisiblePoint {
  Vec2 raster;  // in pixels of the image
  Rgb color;    // of the power, scaled to a maximum of one
};

struct VisiblePoints {
  uint64_t version = 0;  // of the document; 0 if it was edited during the search
  uint32_t samples = 0;  // of the rendering
  size_t stored = 0;     // number of points that the integrator has stored
  std::vector<VisiblePoint> points;
};

class StoredPoints {
 public:
  StoredPoints(render::Session& session, const Editor& editor, std::function<void()> wake)
      : session_(session), editor_(editor), wake_(std::move(wake)) {}

  // The points for the current document; null while they are unknown.
  const VisiblePoints* result() const;
  // Called once per frame. Searches the points at most twice per second if `requested`.
  void update(bool requested);

 private:
  using Clock = std::chrono::steady_clock;

  render::Session& session_;
  const Editor& editor_;
  std::function<void()> wake_;
  std::shared_ptr<const VisiblePoints> result_;
  Clock::time_point start_;
  BackgroundTask<std::shared_ptr<const VisiblePoints>> task_;
};

}  // namespace etendue::viewer
