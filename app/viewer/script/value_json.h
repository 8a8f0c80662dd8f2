// The values of parameters as JSON.
#pragma once
#include <nlohmann/json.hpp>

#include "base/parameter.h"

namespace etendue::viewer {

inline nlohmann::json to_json(const Value& value) {
  return std::visit([](const auto& v) { return nlohmann::json(v); }, value);
}

}  // namespace etendue::viewer
