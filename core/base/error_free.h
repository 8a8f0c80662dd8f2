// Error-free transformations: sums of doubles together with their rounding errors [Knuth 1997, sec. 4.2.2].
#pragma once
#include <span>
#include <vector>

namespace etendue {

// Two doubles in one register.
using Double2 [[gnu::vector_size(16)]] = double;

// Adds `x` to `sum` and returns the rounding error, which is positive zero if there is none. The rounded sum and the
// error together are exact. T is double or Double2.
template <class T>
T add_exactly(T& sum, T x) {
  const T rounded = sum + x;
  const T added = rounded - sum;
  const T error = (sum - (rounded - added)) + (x - added);
  sum = rounded;
  return error;
}

// The exact sum of finite terms, rounded to the nearest double, ties to even [Shewchuk 1997]. It does not depend on
// their order.
double rounded_sum(std::span<const double> terms);

// The exact sum of finite terms as an expansion: the first component is the rounded sum, each other one the rounded
// remainder of those before. Equal sums have equal expansions; that of zero is empty.
std::vector<double> expansion_of(std::vector<double> terms);

}  // namespace etendue
