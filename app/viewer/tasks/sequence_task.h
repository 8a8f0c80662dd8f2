// Renders the images of a sequence to numbered files.
//
// The images are those of `etendue render --frames` and `--turntable`: each has the same number of samples, and the
// document as it was at the start. The main rendering is paused meanwhile.
#pragma once
#include <cstdint>
#include <string>

#include "base/result.h"
#include "render/image_sequence.h"
#include "viewer/tasks/progressive_task.h"
#include "viewer/tasks/task.h"

namespace etendue::viewer {

struct SequenceRequest {
  render::SequencePlan plan;
  int samples = 64;       // per pixel of each image
  std::string pattern;    // names of the files (render::frame_file)
  bool replaces = false;  // whether files that exist are replaced
};

struct SequenceProgress {
  uint32_t done = 0, count = 0;  // images
  double seconds = 0;            // since the start
  std::string file;              // that was written last; empty before the first one
  std::string error;             // why the sequence ended early; empty if it did not
};

class SequenceTask final : public Task {
 public:
  // An error if the name is not suitable. If a file exists and is not to be replaced, the sequence ends before its first
  // image.
  Result<void> start(const TaskContext& context, const SequenceRequest& request);
  // The image that is being rendered is discarded; those before stay.
  void stop(const TaskContext& context);
  // Called once per frame.
  void update(const TaskContext& context);

  bool running() const { return task_.running(); }
  // Share of the images that are complete, 0 to 1, with the part of the present one.
  double share() const { return task_.progress(); }
  // Of the last sequence; null before the first one.
  const SequenceProgress* progress() const { return task_.result().get(); }

  void reset(const TaskContext& context) override { stop(context); }
  bool has_update() const override { return task_.has_update(); }
  bool is_waiting() const override { return running(); }

 private:
  void finish(const TaskContext& context);

  ProgressiveTask<SequenceProgress> task_;
};

}  // namespace etendue::viewer
