#include "viewer/state/editor.h"

#include <utility>

namespace etendue::viewer {
namespace {

// Documents share what is heavy, but a day of edits should not grow without end.
constexpr size_t kMostSteps = 1000;

}  // namespace

void Editor::open(render::Document document) {
  document_ = std::move(document);
  done_.clear();
  undone_.clear();
  gesture_.clear();
  submit();
}

void Editor::apply(render::Document changed, const std::string& name, const std::string& gesture) {
  if (gesture.empty() || gesture != gesture_) {
    done_.push_back({document_, name, gesture});
    if (done_.size() > kMostSteps) done_.erase(done_.begin());
  }
  undone_.clear();
  gesture_ = gesture;
  document_ = std::move(changed);
  submit();
}

void Editor::forget(const std::string& gesture) {
  if (done_.empty() || done_.back().gesture != gesture) return;
  document_ = std::move(done_.back().document);
  done_.pop_back();
  gesture_.clear();
  submit();
}

bool Editor::undo() {
  if (done_.empty()) return false;
  Step step = std::move(done_.back());
  done_.pop_back();
  std::swap(step.document, document_);
  undone_.push_back(std::move(step));
  gesture_.clear();
  submit();
  return true;
}

bool Editor::redo() {
  if (undone_.empty()) return false;
  Step step = std::move(undone_.back());
  undone_.pop_back();
  std::swap(step.document, document_);
  done_.push_back(std::move(step));
  gesture_.clear();
  submit();
  return true;
}

uint64_t Editor::submit_limited(const render::Limits& limits) {
  render::Document limited = document_;
  limited.limits = limits;
  return version_ = session_.submit(limited);
}

void Editor::submit() { version_ = session_.submit(document_); }

}  // namespace etendue::viewer
