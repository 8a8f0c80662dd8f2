#include "viewer/tasks/exclusive_task.h"

#include <utility>

#include "render/session.h"

namespace etendue::viewer {

void ExclusiveTask::begin(Description description) {
  if (current_) {
    const auto cancel = current_->cancel;
    cancel();
  }
  was_paused_ = session_.paused();
  session_.pause(true);
  current_ = std::move(description);
}

void ExclusiveTask::end() {
  if (!current_) return;
  current_.reset();
  session_.pause(was_paused_);
}

}  // namespace etendue::viewer
