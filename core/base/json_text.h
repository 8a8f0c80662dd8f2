// The text of a JSON value.
#pragma once
#include <nlohmann/json.hpp>
#include <string>

namespace etendue {

// `indent` as in nlohmann::basic_json::dump; negative: on one line. Strings that are not UTF-8, such as some names of
// files, get replacement characters. `dump` itself would throw.
inline std::string json_text(const nlohmann::json& value, int indent = -1) {
  return value.dump(indent, ' ', false, nlohmann::json::error_handler_t::replace);
}

}  // namespace etendue
