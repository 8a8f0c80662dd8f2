// The steps of a script. A step is advanced once per iteration of the main loop until it is done or impossible.
#pragma once
#include <memory>
#include <nlohmann/json_fwd.hpp>
#include <string>

#include "base/result.h"
#include "viewer/script/wait_condition.h"

namespace etendue::viewer {

class Step {
 public:
  virtual ~Step() = default;
  virtual StepStatus advance(AppState& state) = 0;
  // Whether frames are drawn one after the other, rather than when something changes.
  virtual bool needs_frames() const { return true; }
  // Seconds that the step may take in addition to the usual time limit.
  virtual double extra_seconds() const { return 0; }
};

// Makes a step from its JSON description. An unknown or incomplete description is a usage error.
Result<std::unique_ptr<Step>> make_step(const nlohmann::json& description);

// Each of these makes the steps of one kind ("click", "wait", ...). Returns null for an action of another kind. A
// missing member of the description throws json::exception.
Result<std::unique_ptr<Step>> make_input_step(const std::string& action, const nlohmann::json& description);
Result<std::unique_ptr<Step>> make_wait_step(const std::string& action, const nlohmann::json& description);
Result<std::unique_ptr<Step>> make_file_step(const std::string& action, const nlohmann::json& description);

Result<std::unique_ptr<Step>> make_random_step(const std::string& action, const nlohmann::json& description);

// Counts down a number of frames, so that the interface can react to input.
class FrameDelay {
 public:
  explicit FrameDelay(int frames) : frames_left_(frames) {}
  // Returns true when all frames have passed.
  bool advance() { return frames_left_-- <= 0; }

 private:
  int frames_left_;
};

inline StepStatus impossible(std::string error) { return {.done = false, .error = std::move(error)}; }

}  // namespace etendue::viewer
