// The document that is edited, with undo and redo.
//
// Each step stores the document before the edit. All edits of one gesture (a slider drag, an orbit) make one step.
#pragma once
#include <optional>
#include <string>
#include <vector>

#include "render/document.h"
#include "render/resume_point.h"

namespace etendue::render {
class Session;
}

namespace etendue::viewer {

class Editor {
 public:
  explicit Editor(render::Session& session) : session_(session) {}

  bool empty() const { return !document_.scene; }
  const render::Document& document() const { return document_; }
  // The version of the document that the session returned; frames carry the version that they show.
  uint64_t version() const { return version_; }

  // Replaces the document and clears the undo history. The document counts as saved unless it was recovered.
  // The rendering continues from the resume point if there is one.
  void open(render::Document document, bool is_recovered = false,
            std::optional<render::ResumePoint> resume_point = std::nullopt);

  // Counts all changes of the document, including undo and redo.
  uint64_t revision() const { return revision_; }
  // Records that the scene, or everything up to a revision, is stored in a file.
  void mark_scene_saved(std::shared_ptr<const scene::Scene> scene) { saved_scene_ = std::move(scene); }
  void mark_saved(const render::Document& document, uint64_t revision);
  // Whether the scene (objects, materials, lights, environment) differs from the one that was opened or saved last.
  bool has_unsaved_scene_edits() const { return document_.scene != saved_scene_; }
  // Whether anything has changed since then, including the camera and the rendering method.
  bool has_unsaved_changes() const { return revision_ != saved_revision_; }

  // Replaces the document by an edited one. `name` is the name of the step in the menu. Consecutive edits with the same
  // gesture make one step, until `end_gesture`; an empty gesture always makes a step of its own.
  void apply(render::Document changed, const std::string& name, const std::string& gesture = "");
  void end_gesture() { gesture_.clear(); }
  // Replaces the document without a step. Whether there are unsaved changes does not depend on it.
  void amend(render::Document changed);
  // Reverts the last step if it was made by this gesture. The step cannot be redone.
  void discard_step(const std::string& gesture);

  bool undo();
  bool redo();
  size_t undo_depth() const { return undo_steps_.size(); }
  size_t redo_depth() const { return redo_steps_.size(); }
  std::string undo_name() const { return undo_steps_.empty() ? "" : undo_steps_.back().name; }
  std::string redo_name() const { return redo_steps_.empty() ? "" : redo_steps_.back().name; }

  // Submits the document to the session with other limits, without a step. `submit` restores its own limits.
  uint64_t submit_with_limits(const render::Limits& limits);
  void submit();
  // Discards all samples.
  void restart();

 private:
  struct Step {
    render::Document document;
    std::string name;
    std::string gesture;
  };

  render::Session& session_;
  render::Document document_;
  uint64_t version_ = 0;
  uint64_t revision_ = 0;
  uint64_t saved_revision_ = 0;
  std::shared_ptr<const scene::Scene> saved_scene_;
  std::vector<Step> undo_steps_;
  std::vector<Step> redo_steps_;
  std::string gesture_;
};

}  // namespace etendue::viewer
