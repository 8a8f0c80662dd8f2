// The solution of the radiosity equation of the current rendering, and the patches that its camera sees.
//
// The session lends its solution between two slices of work, so a thread of its own waits for it.
#pragma once
#include <array>
#include <chrono>
#include <memory>
#include <vector>

#include "base/vec.h"
#include "integrator/solution_view.h"
#include "viewer/tasks/background_task.h"
#include "viewer/tasks/task.h"

namespace etendue::viewer {

// A visible side of a patch in the image.
struct VisiblePatch {
  std::array<Vec2, 3> corners;  // in pixels of the image
  uint32_t patch = 0;
  bool front = true;
  float distance = 0;  // of the centroid from the camera

  bool contains(Vec2 pixel) const;
};

struct VisibleSolution {
  uint64_t version = 0;                                      // of the document
  std::shared_ptr<const integrator::SolutionView> solution;  // null: the integrator has none
  std::vector<VisiblePatch> patches;                         // the most distant ones first

  const integrator::SolutionView::Side& side(const VisiblePatch& p) const {
    return p.front ? solution->patches[p.patch].front : solution->patches[p.patch].back;
  }
};

class RadiosityTask final : public Task {
 public:
  // Called once per frame. Fetches the solution at most twice per second while it is requested and not complete.
  void update(const TaskContext& context, bool requested);
  // The solution of the current document; null while it is unknown.
  const VisibleSolution* result() const { return result_.get(); }

  void reset(const TaskContext& context) override;
  bool has_update() const override { return task_.has_result(); }

 private:
  using Clock = std::chrono::steady_clock;

  std::shared_ptr<const VisibleSolution> result_;
  Clock::time_point start_;
  BackgroundTask<std::shared_ptr<const VisibleSolution>> task_;
};

}  // namespace etendue::viewer
