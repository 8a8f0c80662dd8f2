#include "viewer/script/step.h"

#include <nlohmann/json.hpp>

namespace etendue::viewer {

Result<std::unique_ptr<Step>> make_step(const nlohmann::json& description) {
  try {
    const std::string action = description.at("do").get<std::string>();
    for (const auto make : {make_wait_step, make_input_step, make_file_step, make_random_step}) {
      auto step = make(action, description);
      if (!step || *step) return step;
    }
    return usage_error(
        "'" + action +
        "' is not a step; use wait, set, click, drag, scroll, key, type, pick, random, open, screenshot, "
        "image, state or follow");
  } catch (const nlohmann::json::exception& error) {
    return usage_error(std::string("the step is incomplete (") + error.what() + "); see the script reference");
  }
}

}  // namespace etendue::viewer
