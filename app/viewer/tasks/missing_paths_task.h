// Measures which light paths the current integrator misses in the current view, and how much energy they carry.
//
// The measurement starts when the document has not been edited for a moment. Results are stored while the scene is
// open, so that switching between integrators measures each one once. An integrator that declares to find all paths
// needs no measurement.
#pragma once
#include <chrono>
#include <deque>

#include "advisor/missing_paths.h"
#include "render/document.h"
#include "viewer/tasks/progressive_task.h"
#include "viewer/tasks/task.h"

namespace etendue::viewer {

class MissingPathsTask final : public Task {
 public:
  // The result for this document, or null if it was not measured.
  const advisor::MissingPaths* result_for(const render::Document& document) const;

  // Called once per frame. Starts a measurement if `allowed`; an edit or `allowed == false` cancels it.
  void update(const TaskContext& context, bool allowed);
  void reset(const TaskContext& context) override;
  bool has_update() const override { return task_.has_update(); }

 private:
  using Clock = std::chrono::steady_clock;
  struct Result {
    render::Document document;
    advisor::MissingPaths missing_paths;
  };

  std::deque<Result> results_;   // the newest first
  render::Document document_;    // that is being measured
  uint64_t edited_version_ = 0;  // the document version at the last call of `update`
  Clock::time_point edit_time_;
  ProgressiveTask<advisor::MeasuredMissingPaths> task_;
};

}  // namespace etendue::viewer
