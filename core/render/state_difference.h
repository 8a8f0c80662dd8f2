// Comparison of the states of documents (state_json) without opening their scenes.
#pragma once
#include <string>
#include <vector>

#include "base/result.h"

namespace etendue::render {

// A setting that differs between two states.
struct SettingDifference {
  std::string name;  // qualified name of a parameter, or "scene", "camera", "environment", "structure"
  // The values as text; empty where the state has none because the value is that of the scene's file, or the default.
  std::string a, b;
};

// The differences of two states in the order of their names, first those that are not parameters. The number of samples
// is not compared. An input error if one is not a state.
Result<std::vector<SettingDifference>> differences_of_states(const std::string& a, const std::string& b);

// Whether two states differ at most in their numbers of samples.
bool same_settings(const std::string& a, const std::string& b);

// The number of samples per pixel of a state; 0 if it has none.
uint32_t samples_of_state(const std::string& state);

}  // namespace etendue::render
