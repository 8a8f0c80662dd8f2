// The figures that are not made, and why.
#include <array>

#include "figures/figure.h"

namespace etendue::figures {
namespace {

constexpr NotMade kNotMade[] = {
    {"1.1", Reason::artwork},     {"1.4", Reason::diagram},     {"1.5", Reason::diagram},
    {"1.6", Reason::artwork},     {"1.7", Reason::artwork},     {"1.8", Reason::diagram},
    {"1.9", Reason::diagram},     {"2.5", Reason::diagram},     {"2.6", Reason::diagram},
    {"2.7", Reason::diagram},     {"2.8", Reason::diagram},     {"2.9", Reason::diagram},
    {"2.10", Reason::diagram},    {"2.12", Reason::diagram},    {"2.13", Reason::diagram},
    {"2.15", Reason::diagram},    {"2.16", Reason::diagram},    {"2.17", Reason::diagram},
    {"2.18", Reason::diagram},    {"2.19", Reason::diagram},    {"2.20", Reason::diagram},
    {"2.21", Reason::diagram},    {"2.22", Reason::diagram},    {"2.23", Reason::diagram},
    {"2.24", Reason::diagram},    {"2.25", Reason::diagram},    {"2.26", Reason::diagram},
    {"2.27", Reason::diagram},    {"2.28", Reason::diagram},    {"2.30", Reason::diagram},
    {"2.31", Reason::diagram},    {"2.32", Reason::diagram},    {"2.33", Reason::diagram},
    {"2.34", Reason::diagram},    {"2.35", Reason::diagram},    {"2.37", Reason::diagram},
    {"2.41", Reason::pseudocode}, {"2.42", Reason::pseudocode}, {"2.43", Reason::diagram},
    {"2.44", Reason::diagram},    {"2.61", Reason::diagram},    {"2.62", Reason::diagram},
    {"2.63", Reason::diagram},    {"2.64", Reason::diagram},    {"2.67", Reason::diagram},
    {"3.1", Reason::diagram},     {"3.2", Reason::diagram},     {"3.3", Reason::diagram},
    {"3.4", Reason::diagram},     {"3.5", Reason::diagram},     {"3.6", Reason::diagram},
    {"3.7", Reason::diagram},     {"3.10", Reason::diagram},    {"3.11", Reason::diagram},
    {"3.12", Reason::diagram},    {"3.13", Reason::diagram},    {"3.14", Reason::diagram},
    {"3.15", Reason::diagram},    {"4.1", Reason::diagram},     {"4.2", Reason::diagram},
    {"4.3", Reason::diagram},     {"4.4", Reason::diagram},     {"4.5", Reason::diagram},
    {"4.6", Reason::diagram},     {"4.7", Reason::diagram},     {"4.8", Reason::diagram},
    {"4.9", Reason::diagram},     {"4.10", Reason::diagram},    {"4.11", Reason::diagram},
    {"4.12", Reason::diagram},    {"4.13", Reason::diagram},    {"4.14", Reason::diagram},
    {"4.15", Reason::diagram},    {"4.16", Reason::diagram},    {"4.17", Reason::diagram},
    {"4.20", Reason::artwork},    {"4.21", Reason::diagram},    {"4.22", Reason::artwork},
    {"4.23", Reason::diagram},    {"4.24", Reason::artwork},    {"4.25", Reason::diagram},
    {"4.26", Reason::diagram},    {"4.27", Reason::diagram},    {"4.28", Reason::diagram},
    {"4.29", Reason::diagram},    {"4.30", Reason::diagram},    {"4.31", Reason::diagram},
    {"4.32", Reason::diagram},    {"4.37", Reason::artwork},    {"4.40", Reason::diagram},
    {"4.43", Reason::diagram},    {"4.46", Reason::diagram},    {"4.47", Reason::diagram},
    {"4.48", Reason::artwork},    {"4.49", Reason::diagram},    {"4.50", Reason::diagram},
    {"4.51", Reason::diagram},    {"4.60", Reason::diagram},    {"4.61", Reason::diagram},
    {"4.62", Reason::diagram},    {"4.63", Reason::diagram},    {"4.64", Reason::diagram},
    {"4.65", Reason::diagram},    {"4.66", Reason::diagram},    {"4.67", Reason::diagram},
    {"4.68", Reason::diagram},    {"4.69", Reason::diagram},    {"4.70", Reason::diagram},
    {"4.71", Reason::diagram},    {"4.73", Reason::diagram},    {"4.74", Reason::diagram},
    {"5.1", Reason::diagram},     {"5.2", Reason::diagram},     {"5.3", Reason::diagram},
    {"5.4", Reason::diagram},     {"5.5", Reason::diagram},     {"5.6", Reason::diagram},
    {"5.7", Reason::diagram},     {"5.8", Reason::diagram},     {"5.10", Reason::diagram},
    {"5.12", Reason::diagram},    {"5.13", Reason::diagram},    {"6.13", Reason::diagram},
    {"6.17", Reason::pseudocode}, {"6.23", Reason::pseudocode}, {"6.36", Reason::diagram},
    {"6.40", Reason::diagram},    {"7.5", Reason::pseudocode},  {"7.14", Reason::pseudocode},
    {"8.1", Reason::diagram},     {"8.2", Reason::diagram},     {"8.3", Reason::diagram},
    {"8.4", Reason::diagram},     {"8.5", Reason::pseudocode},  {"8.7", Reason::pseudocode},
    {"8.8", Reason::artwork},     {"8.11", Reason::pseudocode}, {"8.17", Reason::diagram},
    {"8.18", Reason::pseudocode}, {"9.1", Reason::diagram},     {"9.3", Reason::pseudocode},
    {"9.4", Reason::diagram},     {"9.5", Reason::diagram},     {"9.6", Reason::diagram},
    {"9.9", Reason::diagram},     {"9.10", Reason::diagram},    {"9.11", Reason::pseudocode},
    {"9.12", Reason::diagram},    {"9.15", Reason::diagram},    {"9.18", Reason::diagram},
    {"9.19", Reason::diagram},    {"9.20", Reason::diagram},    {"9.21", Reason::diagram},
    {"9.22", Reason::diagram},    {"9.23", Reason::diagram},    {"9.27", Reason::pseudocode},
    {"9.29", Reason::diagram},    {"9.30", Reason::diagram},    {"9.31", Reason::diagram},
    {"9.32", Reason::pseudocode}, {"9.33", Reason::diagram},    {"9.37", Reason::diagram},
    {"9.39", Reason::diagram},    {"9.46", Reason::diagram},    {"9.48", Reason::diagram},
    {"9.49", Reason::diagram},    {"10.1", Reason::artwork},    {"10.2", Reason::diagram},
    {"10.3", Reason::diagram},    {"10.4", Reason::diagram},    {"10.5", Reason::diagram},
    {"10.6", Reason::diagram},    {"10.7", Reason::diagram},    {"10.8", Reason::diagram},
    {"10.9", Reason::diagram},    {"10.10", Reason::diagram},   {"10.12", Reason::pseudocode},
    {"10.14", Reason::diagram},
};

}  // namespace

std::span<const NotMade> not_made() { return kNotMade; }

const NotMade* find_not_made(std::string_view number) {
  for (const NotMade& figure : kNotMade)
    if (figure.number == number) return &figure;
  return nullptr;
}

const char* explanation(Reason reason) {
  switch (reason) {
    case Reason::diagram:
      return "A diagram of a definition or a geometry, which shows nothing that is computed.";
    case Reason::pseudocode:
      return "A listing.";
    case Reason::artwork:
      return "A photograph, or an image of models that are not available.";
  }
  return "";
}

}  // namespace etendue::figures
