// What the document's method misses of the view on the desk: measured beside the rendering once an edit has come to
// rest, and kept for as long as the scene is open, so that going back and forth between methods asks once.
//
// A method that declares to find all that counts costs nothing.
#pragma once
#include <chrono>
#include <deque>

#include "advisor/missing_paths.h"
#include "viewer/state/editor.h"
#include "viewer/tasks/progressive_task.h"

namespace etendue::viewer {

class BlindSpotsHand {
 public:
  BlindSpotsHand(const render::Session& session, const Editor& editor, const std::function<void()>& wake)
      : session_(session), editor_(editor), study_(wake) {}

  // Null until it is known.
  const advisor::MissingPaths* shown() const;
  bool running() const { return study_.running(); }
  bool has_news() const { return study_.has_news(); }
  void forget() { study_.clear(), known_.clear(); }
  // Called once a frame; somebody may be looking. An edit ends the work.
  void advance(bool looked_at);

 private:
  using Clock = std::chrono::steady_clock;
  struct Known {
    render::Document document;
    advisor::MissingPaths spots;
  };

  const render::Session& session_;
  const Editor& editor_;
  std::deque<Known> known_;    // the newest first
  render::Document document_;  // that is being measured
  uint64_t version_ = 0;       // of the last edit
  Clock::time_point edited_;
  Study<advisor::MeasuredMissingPaths> study_;
};

}  // namespace etendue::viewer
