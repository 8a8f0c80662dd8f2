// Integral equations with known solutions, for experiments.
#pragma once
#include <array>
#include <cmath>
#include <numbers>

#include "base/parameter.h"
#include "equations/fredholm.h"

namespace etendue::experiments {

enum class EquationKind {
  cosine,       // f = 1 + (1/4) integral over [0, pi/2] of cos(x) f(y); f = 1 + (pi/6) cos x  [Lang, Example 2.53]
  separable,    // f = 1 + integral over [0, 1] of x y f(y);           f = 1 + 3x/4
  constant,     // f = 1 + lambda integral over [0, 1] of f(y);        f = 1 / (1 - lambda)
  small_light,  // the same kernel; g = 100 in an interval of width 1/100
  logarithmic,  // f = 1 + integral over [0, 1] of ln(xy) f(y);        f = 1 + ln(x)/2  [Lang, Example 2.52]
};

// Half of the width of the interval where the source of `small_light` is not zero, around 1/2.
inline constexpr double kSmallLight = 0.005;

// `lambda` is the factor of the constant kernels, which reflect this share of the light.
inline equations::FredholmEquation make_equation(EquationKind kind, double lambda) {
  const auto one = [](double) { return 1.0; };
  switch (kind) {
    case EquationKind::cosine:
      return {.a = 0,
              .b = std::numbers::pi / 2,
              .kernel = [](double x, double) { return std::cos(x) / 4; },
              .source = one,
              .solution = [](double x) { return 1 + std::numbers::pi / 6 * std::cos(x); }};
    case EquationKind::separable:
      return {.a = 0,
              .b = 1,
              .kernel = [](double x, double y) { return x * y; },
              .source = one,
              .solution = [](double x) { return 1 + 0.75 * x; }};
    case EquationKind::constant:
      return {.a = 0,
              .b = 1,
              .kernel = [lambda](double, double) { return lambda; },
              .source = one,
              .solution = [lambda](double) { return 1 / (1 - lambda); }};
    case EquationKind::small_light: {
      const auto light = [](double x) { return std::abs(x - 0.5) < kSmallLight ? 0.5 / kSmallLight : 0; };
      return {.a = 0,
              .b = 1,
              .kernel = [lambda](double, double) { return lambda; },
              .source = light,
              .solution = [lambda, light](double x) { return light(x) + lambda / (1 - lambda); }};
    }
    case EquationKind::logarithmic:
      break;
  }
  return {.a = 0,
          .b = 1,
          .kernel = [](double x, double y) { return std::log(x * y); },
          .source = one,
          .solution = [](double x) { return 1 + std::log(x) / 2; }};
}

inline Choice<EquationKind> equation_parameter(EquationKind value) {
  return {"equation", "Equation", value, "An equation of Fredholm's second kind with a known solution"};
}
inline Number<float> lambda_parameter() {
  return {"lambda",
          "Lambda",
          0.5f,
          {0, 2},
          "The constant kernel of `constant` and `small-light`: the share of light that is reflected. From 1 on the "
          "Neumann series diverges"};
}

}  // namespace etendue::experiments

template <>
struct etendue::Options<etendue::experiments::EquationKind> {
  static constexpr std::array<etendue::Option, 5> kOptions{{{"cosine", "Kernel cos(x)/4"},
                                                            {"separable", "Kernel x y"},
                                                            {"constant", "Constant kernel"},
                                                            {"small-light", "Constant kernel, small source"},
                                                            {"logarithmic", "Kernel ln(x y), divergent series"}}};
};
