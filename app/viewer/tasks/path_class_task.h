// Measures how much energy of the view each class of light paths carries, and which of them the current integrator
// finds.
//
// The table covers all paths, also where a path filter is set, and is measured with a reference integrator. It
// therefore depends on scene and camera only. An edit of either leaves the table as it is, marked as outdated.
#pragma once
#include <memory>
#include <string>
#include <vector>

#include "advisor/missing_paths.h"
#include "render/document.h"
#include "viewer/tasks/progressive_task.h"
#include "viewer/tasks/task.h"

namespace etendue::viewer {

struct PathClasses {
  advisor::ClassTable table;
  std::vector<std::string> beyond_methods;  // light that no integrator finds, as sentences
};

// The table as seen by one integrator.
struct IntegratorCoverage {
  enum class Found : uint8_t { all, part, none };
  std::vector<Found> rows;  // of the table
  advisor::MissingPaths missing_paths;
};

class PathClassTask final : public Task {
 public:
  // Measures the current view.
  void start(const TaskContext& context);
  // Called once per frame. With `start_if_new`, measures a document that was not measured since it was opened.
  void update(const TaskContext& context, bool start_if_new);
  void reset(const TaskContext& context) override;
  bool has_update() const override { return task_.has_update(); }
  bool running() const { return task_.running(); }

  // Null until the first classes are measured.
  const PathClasses* result() const { return task_.result().get(); }
  // Whether the result belongs to the view of this document.
  bool is_current(const render::Document& document) const;
  // What the integrator of the document finds. Requires a result.
  const IntegratorCoverage& coverage(const TaskContext& context);

 private:
  bool started_ = false;       // since the document was opened
  render::Document document_;  // that was measured
  ProgressiveTask<PathClasses> task_;

  // The arguments and the result of the last call of `coverage`.
  std::shared_ptr<const PathClasses> covered_table_;
  render::MethodSettings covered_method_;
  bool covered_incompatible_ = false;
  IntegratorCoverage coverage_;
};

}  // namespace etendue::viewer
