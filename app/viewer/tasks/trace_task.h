// Traces one sample of a pixel again in the background (render/pixel_trace.h), after each edit of the document.
#pragma once
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "base/parameter.h"
#include "render/pixel_trace.h"
#include "trace/trace_drawing.h"
#include "trace/trace_text.h"
#include "viewer/tasks/background_task.h"
#include "viewer/tasks/task.h"

namespace etendue::viewer {

// A trace with the rows of its table and the segments of its paths.
struct ShownTrace {
  render::PixelTrace trace;
  std::vector<trace::TraceRow> rows;
  std::vector<trace::PathSegment> segments;
};

class TraceTask final : public Task {
 public:
  struct Parameters {
    Number<int> sample{"trace.sample", "Sample", 0, {0, 65535}, "Index of the sample of the pixel, from 0"};
    Toggle shadow_rays{"trace.shadow-rays", "Show shadow rays", true,
                       "Draws the connections to lights; occluded ones are dashed"};
    auto all() { return std::tie(sample, shadow_rays); }
  };
  Parameters parameters;

  void set_pixel(Vec2i pixel) { pixel_ = pixel; }
  const std::optional<Vec2i>& pixel() const { return pixel_; }

  // Called once per frame while the trace is shown.
  void update(const TaskContext& context);
  // The pixel stays selected in the new document.
  void reset(const TaskContext&) override;
  bool has_update() const override { return task_.has_result() || export_.has_result(); }
  bool is_saving() const override { return export_.running(); }
  // Whether the trace belongs to the pixel, the sample and the current document.
  bool is_current(const TaskContext& context) const;

  // Null if there is none yet.
  const ShownTrace* result() const { return result_.get(); }

  // Writes the paths over the current image as .svg, or the trace as .json, in the background.
  void save(const TaskContext& context, const std::string& file);

 private:
  struct Input {
    uint64_t version = 0;  // of the document
    Vec2i pixel{0};
    int sample = 0;

    friend bool operator==(const Input&, const Input&) = default;
  };
  std::optional<Input> input(const TaskContext& context) const;

  std::optional<Vec2i> pixel_;
  std::optional<Input> requested_;
  std::shared_ptr<const ShownTrace> result_;
  BackgroundTask<std::shared_ptr<const ShownTrace>> task_;
  BackgroundTask<Result<std::string>> export_;
};

}  // namespace etendue::viewer
