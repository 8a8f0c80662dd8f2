// What a method keeps in space (photons, virtual lights), as points over the picture: those that the camera sees.
//
// They are asked for now and then beside the rendering, and looked for with one ray each: what a surface hides is not
// shown.
#pragma once
#include <chrono>
#include <memory>
#include <vector>

#include "viewer/state/editor.h"
#include "viewer/tasks/background_task.h"

namespace etendue::viewer {

struct SeenPoint {
  Vec2 raster;  // in pixels of the picture
  Rgb tint;     // of its power, the largest channel one
};

struct SeenPoints {
  uint64_t version = 0;  // of the document
  uint32_t samples = 0;  // of the picture, when they were asked for
  size_t kept = 0;       // by the method, before any were left out
  std::vector<SeenPoint> points;
};

class PointsHand {
 public:
  PointsHand(render::Session& session, const Editor& editor, std::function<void()> wake)
      : session_(session), editor_(editor), job_(std::move(wake)) {}

  // Of the document on the desk; null until they are known.
  const SeenPoints* shown() const { return shown_ && shown_->version == editor_.version() ? shown_.get() : nullptr; }
  // Called once a frame; somebody may be looking. True if there are others.
  bool advance(bool looked_at);

 private:
  using Clock = std::chrono::steady_clock;

  render::Session& session_;
  const Editor& editor_;
  std::shared_ptr<const SeenPoints> shown_;
  Clock::time_point asked_;
  Job<std::shared_ptr<const SeenPoints>> job_;
};

}  // namespace etendue::viewer
