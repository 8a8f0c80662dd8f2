// Recommends an integrator: runs short pilots of all of them and ranks them by the predicted time to an error.
//
// The task has the processor to itself. An edit of the scene, the camera or the parameters of the method cancels it.
#pragma once
#include <optional>

#include "advisor/advisor.h"
#include "base/parameter.h"
#include "render/document.h"
#include "viewer/tasks/progressive_task.h"
#include "viewer/tasks/task.h"

namespace etendue::render {
struct Frame;
}

namespace etendue::viewer {

class RecommendationTask final : public Task {
 public:
  struct Parameters {
    std::optional<float> error;  // in the measure of the document's limits; if unset, see target_error
    Number<float> pilot{"advice.pilot",
                        "Pilot time",
                        1,
                        {0.125f, 60},
                        "Rendering time of the pilot of each integrator. Longer pilots predict better",
                        "s",
                        Scale::logarithmic};
  };
  Parameters parameters;

  // The error to reach, in the measure of the document's limits: the parameter if it is set, else the error limit of the
  // document, else one percent of the mean luminance, of the true value, or of the displayed range.
  float target_error(const render::Document& document) const;
  // The same without the parameter.
  float default_target(const render::Document& document) const;
  // Takes the mean luminance from a frame of the current document, once per document.
  void measure_luminance(const render::Frame& frame, uint64_t document_version);
  // The parameters as widgets and scripts see them.
  std::vector<ParameterInfo> describe_parameters(const render::Document& document) const;
  // The same with their defaults; without a document, with the usual target.
  std::vector<ParameterInfo> describe_defaults(const render::Document* document) const;

  void start(const TaskContext& context);
  void cancel(const TaskContext& context);
  // Called once per frame.
  void update(const TaskContext& context);
  void reset(const TaskContext& context) override;
  bool has_update() const override { return task_.has_update(); }
  bool running() const { return task_.running(); }
  double progress() const { return task_.progress(); }

  // Null until the first result.
  const advisor::Ranking* result() const { return task_.result().get(); }
  // Whether the result is valid for this document.
  bool is_current(const render::Document& document) const;
  // Makes a method of the ranking that of the document, and the error its limit, in one step.
  void apply(Editor& editor, size_t row) const;

 private:
  std::optional<float> default_error_;  // RMSE, from the mean luminance
  render::Document document_;           // of the ranking
  ProgressiveTask<advisor::Ranking> task_;
};

}  // namespace etendue::viewer
