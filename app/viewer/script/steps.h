// The steps of a script, each a small machine that is asked once a frame whether it is done.
#pragma once
#include <memory>
#include <nlohmann/json_fwd.hpp>
#include <string>

#include "viewer/state/app_state.h"

namespace etendue::viewer {

struct Progress {
  bool done = false;
  std::string error;  // what makes the step impossible
};

class Step {
 public:
  virtual ~Step() = default;
  virtual Progress advance(Workbench& w, Picture& picture) = 0;
  // Whether it needs frames one after the other rather than now and then.
  virtual bool hurries() const { return true; }
  // Seconds that it means to take.
  virtual double patience() const { return 0; }
};

// A step as the script writes it; an unknown or incomplete one is an error that says what would be right.
Result<std::unique_ptr<Step>> make_step(const nlohmann::json& written);

}  // namespace etendue::viewer
