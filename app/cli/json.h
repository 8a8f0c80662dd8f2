// Values as JSON.
#pragma once
#include <cmath>
#include <nlohmann/json.hpp>
#include <optional>

#include "base/parameter.h"
#include "spectrum/rgb.h"

namespace etendue::cli {

using nlohmann::json;

// JSON has no infinity and no NaN; both become null.
inline json number_json(double value) { return std::isfinite(value) ? json(value) : json(); }
inline json number_json(const std::optional<double>& value) { return value ? number_json(*value) : json(); }

inline json color_json(const Rgb& color) { return {color.r, color.g, color.b}; }

}  // namespace etendue::cli
