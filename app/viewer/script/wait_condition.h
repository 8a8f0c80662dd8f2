// Conditions that scripts can wait for.
#pragma once
#include <cstdint>
#include <functional>
#include <optional>
#include <string>

namespace etendue::viewer {

struct AppState;

// The result of a step or a condition: done, impossible (with an error message), or neither.
struct StepStatus {
  bool done = false;
  std::string error{};
};

// {"do": "wait", "for": NAME}
struct WaitCondition {
  std::string name;
  // Called repeatedly until the condition is done or impossible. `samples` is N in {"do": "wait", "compared": N}.
  std::function<StepStatus(AppState&, std::optional<uint32_t> samples)> check;
  bool needs_frames = false;  // results are taken up while drawing, so frames are drawn continuously
};

}  // namespace etendue::viewer
