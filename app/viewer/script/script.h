// A user made of JSON: steps that move the pointer, press keys and set widgets, and steps that look.
//
// Everything that acts goes through the event queue or the widget of that name, as a hand would; nothing reaches into
// the document behind the interface's back. A step that cannot be done ends the script.
#pragma once
#include <chrono>
#include <memory>
#include <string>
#include <vector>

#include "viewer/state/app_state.h"

namespace etendue::viewer {

class Script {
 public:
  static Result<Script> read(const std::string& file);

  Script(Script&&) noexcept;
  Script& operator=(Script&&) noexcept;
  ~Script();

  // Called before every frame: goes on with the step that is due.
  void advance(Workbench& w, Picture& picture);
  bool ended() const;
  int exit_code() const;
  bool in_a_hurry() const;   // the next frame should come at once
  bool wants_frame() const;  // the next frame has to be drawn even if nothing changed

 private:
  struct Impl;
  explicit Script(std::unique_ptr<Impl> impl);
  std::unique_ptr<Impl> impl_;
};

// Everything that can be read off the viewer: every setting by name, steps, samples, latencies since the last look.
std::string state_report(Workbench& w);

}  // namespace etendue::viewer
