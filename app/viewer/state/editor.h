// The document on the desk, and every step that led to it.
//
// A step is an old document: undo puts it back. All edits of one gesture (a slider drag, an orbit) make one step.
#pragma once
#include <string>
#include <vector>

#include "render/session.h"

namespace etendue::viewer {

class Editor {
 public:
  explicit Editor(render::Session& session) : session_(session) {}

  bool empty() const { return !document_.scene; }
  const render::Document& document() const { return document_; }
  uint64_t version() const { return version_; }  // of the document, as frames state it

  // A new document; forgets all steps.
  void open(render::Document document);

  // Makes `changed` the document. `name` is what the menu calls the step. Edits with the same gesture, one after the
  // other, are one step until `end_gesture`.
  void apply(render::Document changed, const std::string& name, const std::string& gesture = "");
  void end_gesture() { gesture_.clear(); }
  const std::string& gesture() const { return gesture_; }
  // Takes the last step back without a trace, if it was made by this gesture.
  void forget(const std::string& gesture);

  bool undo();
  bool redo();
  size_t undo_depth() const { return done_.size(); }
  size_t redo_depth() const { return undone_.size(); }
  std::string undo_name() const { return done_.empty() ? "" : done_.back().name; }
  std::string redo_name() const { return undone_.empty() ? "" : undone_.back().name; }

  // Hands the document to the session with other limits, without a step; `submit` with the own ones ends that.
  uint64_t submit_limited(const render::Limits& limits);
  void submit();

 private:
  struct Step {
    render::Document document;
    std::string name, gesture;
  };

  render::Session& session_;
  render::Document document_;
  uint64_t version_ = 0;
  std::vector<Step> done_, undone_;
  std::string gesture_;
};

}  // namespace etendue::viewer
