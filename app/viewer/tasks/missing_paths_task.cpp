#include "viewer/tasks/missing_paths_task.h"

#include <algorithm>

#include "render/session.h"
#include "viewer/state/document_info.h"
#include "viewer/state/editor.h"

namespace etendue::viewer {
namespace {

// Seconds after an edit in which the main rendering has the processor to itself.
constexpr double kDelay = 0.8;
// Time limit of the measurement after its coarsest classes, seconds.
constexpr double kDetectionSeconds = 0.5;
constexpr uint32_t kSamples = 4;
constexpr size_t kMaxResults = 64;

bool same_question(const render::Document& a, const render::Document& b) {
  return same_view(a, b) && a.method == b.method;
}

}  // namespace

const advisor::MissingPaths* MissingPathsTask::result_for(const render::Document& document) const {
  const auto found =
      std::ranges::find_if(results_, [&](const Result& result) { return same_question(result.document, document); });
  return found == results_.end() ? nullptr : &found->missing_paths;
}

void MissingPathsTask::update(const TaskContext& context, bool allowed) {
  const Editor& editor = context.editor;
  if (editor.version() != edited_version_) {
    edited_version_ = editor.version();
    edit_time_ = Clock::now();
  }
  if (task_.update() && task_.result()->finished) {
    results_.push_front({document_, task_.result()->missing});
    if (results_.size() > kMaxResults) results_.pop_back();
  }
  if (task_.running() && !(allowed && same_question(editor.document(), document_))) task_.cancel();
  const double since_edit = std::chrono::duration<double>(Clock::now() - edit_time_).count();
  if (!allowed || task_.running() || result_for(editor.document()) || since_edit < kDelay) return;
  const auto scene = context.session.scene();
  if (!scene || context.session.status().version != editor.version()) return;  // would compile the scene a second time
  document_ = editor.document();
  const auto work = [document = document_, scene](const auto& publish, const bench::Progress& progress) {
    render::Session session({.threads = 1, .scene = scene});
    advisor::TableOptions options;
    options.samples = kSamples;
    options.seconds = kDetectionSeconds;
    publish(advisor::measure_missing_paths(session, document, options, progress));
  };
  task_.start(work, context.wake);
}

void MissingPathsTask::reset(const TaskContext&) {
  task_.reset();
  results_.clear();
}

}  // namespace etendue::viewer
