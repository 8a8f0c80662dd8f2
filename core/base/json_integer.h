// Integers of JSON documents that others may have written.
#pragma once
#include <concepts>
#include <nlohmann/json.hpp>
#include <utility>

namespace etendue {

// Throws json::exception if the value is no integer or not representable as T. `get<T>` would convert any number.
template <std::integral T>
T json_integer(const nlohmann::json& value) {
  if (value.is_number_unsigned()) {
    if (const auto number = value.get<uint64_t>(); std::in_range<T>(number)) return static_cast<T>(number);
  } else if (value.is_number_integer()) {
    if (const auto number = value.get<int64_t>(); std::in_range<T>(number)) return static_cast<T>(number);
  }
  throw nlohmann::json::other_error::create(501, "an integer in range is expected", &value);
}

}  // namespace etendue
