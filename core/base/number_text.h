// Numbers as text for people: significant digits, percentages, durations, byte sizes and rates.
//
// Progress lines, reports, tooltips and messages use these functions, so that the same quantity looks the same
// everywhere. Files that programs read have formats of their own.
#pragma once
#include <cstdint>
#include <string>

namespace etendue {

// A string formatted as by printf, of any length.
[[gnu::format(printf, 1, 2)]] std::string format_text(const char* format, ...);

// `digits` significant digits without trailing zeros: "0.0123", "250", "1.2e+07".
std::string format_number(double value, int digits = 3);

// A fraction in per cent. Two significant digits below 10 %, integers above: "0.42 %", "3.1 %", "31 %".
std::string format_percent(double fraction);

// A duration in seconds with its units: "12 ms", "0.8 s", "12 s", "1 min 20 s", "2 h 5 min", "3 d 4 h".
// "unknown" for a duration that is not finite.
std::string format_duration(double seconds);

// A size in bytes with a binary prefix: "512 B", "1.5 KiB", "312 MiB", "1.4 GiB".
std::string format_bytes(uint64_t bytes);

// A number with its noun: "1 light", "3 lights".
std::string format_count(uint64_t count, const char* singular, const char* plural);

// A rate with a decimal prefix: format_rate(1.9e6, "samples") is "1.90 Msamples/s", format_rate(42, "rays") is
// "42.0 rays/s".
std::string format_rate(double per_second, const char* unit);

}  // namespace etendue
