// The outlines of the selected objects: where the visible surface of one borders on something else. Computed in the background
// when the camera has come to rest.
#pragma once
#include <chrono>
#include <functional>
#include <memory>
#include <vector>

#include "base/vec.h"
#include "viewer/tasks/background_task.h"

namespace etendue::render {
class Session;
}

namespace etendue::viewer {

class Editor;

// A horizontal or vertical piece of the outline, in pixels of the image.
struct OutlineSegment {
  Vec2 from;
  Vec2 to;
};

class SelectionOutline {
 public:
  SelectionOutline(render::Session& session, const Editor& editor, std::function<void()> wake)
      : session_(session), editor_(editor), wake_(std::move(wake)) {}

  // Called once per frame with the selected nodes.
  void update(std::vector<int> nodes);
  // The outline for the current document; null while it is unknown.
  const std::vector<OutlineSegment>* segments() const;

 private:
  using Clock = std::chrono::steady_clock;
  struct Outline {
    uint64_t version = 0;  // of the document
    std::vector<int> nodes;
    std::vector<OutlineSegment> segments;
  };

  render::Session& session_;
  const Editor& editor_;
  std::function<void()> wake_;
  std::vector<int> nodes_;           // that are selected
  uint64_t version_ = 0;             // of the document in the last frame
  Clock::time_point last_change_{};  // of that version
  std::shared_ptr<const Outline> outline_;
  BackgroundTask<std::shared_ptr<const Outline>> task_;
};

}  // namespace etendue::viewer
