// Chooses the integrator of a document whose integrator is "auto", once the image has rested for a moment.
//
// The document is rendered with its present integrator first, so the first image is not delayed. The pilots then have
// the processor to themselves. The chosen method is one step of undo; after undo, the choice is not repeated.
#pragma once
#include <chrono>
#include <optional>

#include "advisor/method_choice.h"
#include "render/document.h"
#include "viewer/tasks/progressive_task.h"
#include "viewer/tasks/task.h"

namespace etendue::viewer {

class AutomaticTask final : public Task {
 public:
  // Called once per frame.
  void update(const TaskContext& context);
  // Makes a new choice for the present document.
  void repeat(const TaskContext& context);
  void cancel(const TaskContext& context);
  void reset(const TaskContext& context) override;
  bool has_update() const override { return task_.has_update(); }
  bool running() const { return task_.running(); }
  double progress() const { return task_.progress(); }

  // The last choice, for the table of the compared integrators; null before the first one.
  const advisor::MethodChoice* choice() const { return choice_ ? &*choice_ : nullptr; }

 private:
  using Clock = std::chrono::steady_clock;

  bool image_rests(const TaskContext& context);
  void start(const TaskContext& context);
  void finish(const TaskContext& context);

  uint64_t edited_version_ = 0;
  Clock::time_point edit_time_ = Clock::now();
  std::optional<render::Document> examined_;  // the last document for which a choice was started
  std::optional<advisor::MethodChoice> choice_;
  ProgressiveTask<Result<advisor::MethodChoice>> task_;
};

}  // namespace etendue::viewer
