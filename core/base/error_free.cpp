#include "base/error_free.h"

#include <cstddef>

namespace etendue {
namespace {

// Components that do not overlap, smallest first, with the same sum as the terms.
std::vector<double> components_of(std::span<const double> terms) {
  std::vector<double> components;
  for (double sum : terms) {
    size_t count = 0;
    for (const double component : components)
      if (const double error = add_exactly(sum, component); error != 0) components[count++] = error;
    components.resize(count);
    components.push_back(sum);
  }
  return components;
}

}  // namespace

double rounded_sum(std::span<const double> terms) {
  const std::vector<double> components = components_of(terms);
  double sum = 0, error = 0;
  size_t i = components.size();
  while (i > 0 && error == 0) {
    error = components[--i];
    error = add_exactly(sum, error);
  }
  // An error of half a unit in the last place was rounded to even. A further component of its sign lies beyond the tie.
  if (i > 0 && (error < 0) == (components[i - 1] < 0) && error != 0) {
    double corrected = sum;
    if (add_exactly(corrected, 2 * error) == 0) return corrected;
  }
  return sum;
}

std::vector<double> expansion_of(std::vector<double> terms) {
  std::vector<double> expansion;
  for (double sum = rounded_sum(terms); sum != 0; sum = rounded_sum(terms)) {
    expansion.push_back(sum);
    terms.push_back(-sum);
  }
  return expansion;
}

}  // namespace etendue
