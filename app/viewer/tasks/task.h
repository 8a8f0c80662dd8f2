// The interface between the main loop and the background tasks of panels.
#pragma once
#include <functional>

namespace etendue::render {
class Session;
}

namespace etendue::viewer {

class Editor;
class ExclusiveTask;
class Notices;

// What a task may use. All references stay valid as long as the viewer runs.
struct TaskContext {
  render::Session& session;  // of the main rendering
  Editor& editor;
  ExclusiveTask& exclusive;
  Notices& notices;
  int threads = 0;             // that a task may use if the main rendering is paused; 0: one per hardware thread
  std::function<void()> wake;  // wakes up the main loop; may be called from any thread
};

class Task {
 public:
  virtual ~Task() = default;

  // Another document is about to be opened: cancels the work and discards results of the old document.
  virtual void reset(const TaskContext& context) = 0;
  // Whether there is a result that has not been taken yet. The main loop then draws a frame.
  virtual bool has_update() const = 0;
  // Whether has_update will become true after some time without an event. The main loop then looks again soon.
  virtual bool is_waiting() const { return false; }
  // Whether a file is being written. The main loop then draws frames until that has ended.
  virtual bool is_saving() const { return false; }
};

}  // namespace etendue::viewer
