// Runs an experiment in the background, again after each change of its parameters (experiments/experiment.h).
#pragma once
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "experiments/experiment.h"
#include "viewer/tasks/progressive_task.h"
#include "viewer/tasks/task.h"

namespace etendue::viewer {

// What is run: an experiment, the values of all its parameters, and the seed.
struct LabInput {
  std::string experiment;
  std::vector<std::string> values;  // as texts, in the order of the parameters
  int seed = 0;
  friend bool operator==(const LabInput&, const LabInput&) = default;
};

struct LabOutcome {
  experiments::ExperimentResult result;
  std::string error;  // why there is no result; empty if there is one
};

class LabTask final : public Task {
 public:
  // Called once per frame while the experiment is shown.
  void update(const TaskContext& context, const LabInput& input);
  // Experiments do not depend on the document.
  void reset(const TaskContext&) override {}
  bool has_update() const override { return task_.has_update() || export_.has_result(); }
  bool is_saving() const override { return export_.running(); }

  // The newest result, also of an experiment that still runs. Null before the first one.
  const LabOutcome* outcome() const { return task_.result().get(); }
  bool running() const { return task_.running(); }
  double progress() const { return task_.progress(); }
  // Whether the outcome is the complete one of this input.
  bool is_current(const LabInput& input) const { return started_ == input && !task_.running() && outcome(); }

  // Writes the result in the background: .csv, .json, .png or .svg.
  void save(const TaskContext& context, const std::string& file);

 private:
  std::optional<LabInput> started_;
  ProgressiveTask<LabOutcome> task_;
  BackgroundTask<Result<std::string>> export_;
};

}  // namespace etendue::viewer
