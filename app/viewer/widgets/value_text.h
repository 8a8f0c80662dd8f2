// Numbers and times as text.
#pragma once
#include <cstddef>
#include <cstdint>
#include <string>

#include "viewer/widgets/unicode.h"

namespace etendue::viewer {

// As printf; the result is cut off after 1000 characters.
[[gnu::format(printf, 1, 2)]] std::string formatted(const char* format, ...);

// A duration: "0:48", "1:02:03".
std::string clock_text(double seconds);
// A predicted time in seconds and its prediction interval, whose lower end may be negative: "0:42 to 0:54 left", or "0:48 left" if
// both ends have the same text. More than 100 hours are "days".
std::string remaining_time(double seconds, double low, double high);
// A date in local time: "2024-01-31 23:59"; empty for 0.
std::string date_text(int64_t seconds_since_1970);

// A name as a label: "shading-normal" as "Shading normal", "medium-in-scattering" as "Medium in-scattering".
std::string label_of_name(std::string name);

// A unit with typeset exponents: "W/m\u00b2" for "W/m^2".
std::string with_superscripts(std::string unit);

}  // namespace etendue::viewer
