// Numbers formatted for messages.
#pragma once
#include <span>
#include <string>
#include <vector>

#include "film/error_measure.h"

namespace etendue::advisor {

std::string number(double value);  // three significant digits: "0.0123"
// An error with three digits: "0.0123", or "1.23 %" for a fraction.
std::string error_number(film::ErrorMeasure measure, double error);
// The parts of a whole, rounded so that they do not add up to more than the whole: "54 %", "24 %", "22 %".
std::vector<std::string> percents(std::span<const double> shares);
std::string times(double ratio);        // a factor: "2.3", "40"
std::string seconds_text(double time);  // "0.8 s", "12 s", "3:20", "2:03:20"

}  // namespace etendue::advisor
