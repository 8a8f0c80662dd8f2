// A traced sample as JSON, with all digits.
#pragma once
#include <nlohmann/json_fwd.hpp>

#include "render/pixel_trace.h"

namespace etendue::trace {

nlohmann::json to_json(const render::PixelTrace& trace);

}  // namespace etendue::trace
