// Scripts: JSON arrays of steps that move the pointer, press keys, set widgets, wait, and save files.
//
// All input goes through the event queue or through widgets, like that of a user. A step that is impossible ends the
// script with an error.
#pragma once
#include <memory>
#include <string>

#include "base/result.h"

namespace etendue::viewer {

struct AppState;

class Script {
 public:
  // Reads and checks all steps.
  static Result<Script> read(const std::string& file);

  Script(Script&&) noexcept;
  Script& operator=(Script&&) noexcept;
  ~Script();

  // Called before every frame: advances the current step.
  void advance(AppState& state);
  bool ended() const;
  int exit_code() const;
  // Whether the main loop should continue without waiting.
  bool is_in_progress() const;
  // Whether the next frame is drawn even if nothing has changed.
  bool needs_frame() const;

 private:
  struct Impl;
  explicit Script(std::unique_ptr<Impl> impl);
  std::unique_ptr<Impl> impl_;
};

}  // namespace etendue::viewer
