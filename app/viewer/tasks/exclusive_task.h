// The background task that uses all processor cores, if there is one. The main rendering is paused while it runs.
#pragma once
#include <functional>
#include <optional>
#include <string>

namespace etendue::render {
class Session;
}

namespace etendue::viewer {

class ExclusiveTask {
 public:
  struct Description {
    std::string status;                  // one word for the status bar: "comparing"
    bool measures_path_classes = false;  // a separate measurement of path classes would be redundant
    std::function<void()> cancel;        // cancels the task, which then calls `end`
  };

  explicit ExclusiveTask(render::Session& session) : session_(session) {}

  // Cancels the current task and pauses the main rendering.
  void begin(Description description);
  // The main rendering continues, unless it was paused before `begin`.
  void end();

  bool running() const { return current_.has_value(); }
  bool measures_path_classes() const { return current_ && current_->measures_path_classes; }
  // Empty if no task runs.
  std::string status() const { return current_ ? current_->status : ""; }

 private:
  render::Session& session_;
  std::optional<Description> current_;
  bool was_paused_ = false;
};

}  // namespace etendue::viewer
