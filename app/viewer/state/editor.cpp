#include "viewer/state/editor.h"

#include <utility>

#include "render/session.h"

namespace etendue::viewer {
namespace {

// Limits the memory of a long session. Documents share scenes, meshes and textures, so a step is small.
constexpr size_t kMaxSteps = 1000;

}  // namespace

void Editor::open(render::Document document, bool is_recovered, std::optional<render::ResumePoint> resume_point) {
  document_ = std::move(document);
  ++revision_;
  if (is_recovered)
    saved_scene_.reset();
  else
    mark_saved(document_, revision_);
  undo_steps_.clear();
  redo_steps_.clear();
  gesture_.clear();
  if (resume_point)
    version_ = session_.submit(document_, std::move(*resume_point));
  else
    submit();
}

void Editor::mark_saved(const render::Document& document, uint64_t revision) {
  saved_scene_ = document.scene;
  saved_revision_ = revision;
}

void Editor::apply(render::Document changed, const std::string& name, const std::string& gesture) {
  if (gesture.empty() || gesture != gesture_) {
    undo_steps_.push_back({document_, name, gesture});
    if (undo_steps_.size() > kMaxSteps) undo_steps_.erase(undo_steps_.begin());
  }
  redo_steps_.clear();
  gesture_ = gesture;
  document_ = std::move(changed);
  ++revision_;
  submit();
}

void Editor::amend(render::Document changed) {
  const bool is_saved = !has_unsaved_changes(), scene_is_saved = !has_unsaved_scene_edits();
  document_ = std::move(changed);
  ++revision_;
  if (is_saved) saved_revision_ = revision_;
  if (scene_is_saved) saved_scene_ = document_.scene;
  submit();
}

void Editor::discard_step(const std::string& gesture) {
  if (undo_steps_.empty() || undo_steps_.back().gesture != gesture) return;
  document_ = std::move(undo_steps_.back().document);
  undo_steps_.pop_back();
  gesture_.clear();
  ++revision_;
  submit();
}

bool Editor::undo() {
  if (undo_steps_.empty()) return false;
  Step step = std::move(undo_steps_.back());
  undo_steps_.pop_back();
  std::swap(step.document, document_);
  redo_steps_.push_back(std::move(step));
  gesture_.clear();
  ++revision_;
  submit();
  return true;
}

bool Editor::redo() {
  if (redo_steps_.empty()) return false;
  Step step = std::move(redo_steps_.back());
  redo_steps_.pop_back();
  std::swap(step.document, document_);
  undo_steps_.push_back(std::move(step));
  gesture_.clear();
  ++revision_;
  submit();
  return true;
}

uint64_t Editor::submit_with_limits(const render::Limits& limits) {
  render::Document limited = document_;
  limited.limits = limits;
  return version_ = session_.submit(limited);
}

void Editor::restart() { version_ = session_.restart(); }

void Editor::submit() { version_ = session_.submit(document_); }

}  // namespace etendue::viewer
