// Integrands over [0, 1]^s with known integrals, for comparisons of methods of integration.
#pragma once
#include <array>
#include <cmath>
#include <functional>
#include <numbers>
#include <span>
#include <vector>

#include "base/parameter.h"
#include "equations/random_numbers.h"

namespace etendue::experiments {

enum class IntegrandKind {
  smooth,  // product of (pi/2) cos(pi x/2)
  kink,    // product of |x - c| over its integral, with random c
  box,     // 1 in the box from the origin to a random corner
  ball,    // 1 in the unit ball around the origin
  sinc,    // sin(x) / x of the first variable: not defined at 0
};

struct TestIntegrand {
  std::function<double(std::span<const double>)> value;
  double integral = 0;
};

// The volume of the unit ball in `dimension` dimensions [Lang, eq. 6.33].
inline double ball_volume(int dimension) {
  return std::pow(std::numbers::pi, dimension / 2.0) / std::tgamma(dimension / 2.0 + 1);
}

// Whether the integrand has a random position, over which errors are averaged.
inline bool is_random(IntegrandKind kind) { return kind == IntegrandKind::kink || kind == IntegrandKind::box; }

inline TestIntegrand smooth_integrand() {
  constexpr double kHalfPi = std::numbers::pi / 2;
  return {.value =
              [](std::span<const double> x) {
                double product = 1;
                for (const double c : x) product *= kHalfPi * std::cos(kHalfPi * c);
                return product;
              },
          .integral = 1};
}

inline TestIntegrand kink_integrand(std::vector<double> kinks) {
  const auto mean = [](double c) { return 0.5 * (c * c + (1 - c) * (1 - c)); };
  return {.value =
              [kinks, mean](std::span<const double> x) {
                double product = 1;
                for (size_t i = 0; i < x.size(); ++i) product *= std::abs(x[i] - kinks[i]) / mean(kinks[i]);
                return product;
              },
          .integral = 1};
}

inline TestIntegrand box_integrand(std::vector<double> corner) {
  double volume = 1;
  for (const double c : corner) volume *= c;
  return {.value =
              [corner](std::span<const double> x) {
                for (size_t i = 0; i < x.size(); ++i)
                  if (x[i] >= corner[i]) return 0.0;
                return 1.0;
              },
          .integral = volume};
}

inline TestIntegrand ball_integrand(int dimension) {
  return {.value =
              [](std::span<const double> x) {
                double squares = 0;
                for (const double c : x) squares += c * c;
                return squares < 1 ? 1.0 : 0.0;
              },
          .integral = std::ldexp(ball_volume(dimension), -dimension)};
}

inline TestIntegrand sinc_integrand() {
  constexpr double kSineIntegralOfOne = 0.9460830703671830149;
  return {.value = [](std::span<const double> x) { return std::sin(x[0]) / x[0]; }, .integral = kSineIntegralOfOne};
}

// A random position lies between 0.2 and 0.8 on each axis, so that no rule has a node on all of them.
inline TestIntegrand make_integrand(IntegrandKind kind, int dimension, equations::RandomNumbers& random) {
  std::vector<double> position(static_cast<size_t>(dimension));
  for (double& c : position) c = 0.2 + 0.6 * random.uniform();
  switch (kind) {
    case IntegrandKind::smooth:
      return smooth_integrand();
    case IntegrandKind::kink:
      return kink_integrand(position);
    case IntegrandKind::box:
      return box_integrand(position);
    case IntegrandKind::ball:
      return ball_integrand(dimension);
    case IntegrandKind::sinc:
      return sinc_integrand();
  }
  return smooth_integrand();
}

}  // namespace etendue::experiments

template <>
struct etendue::Options<etendue::experiments::IntegrandKind> {
  static constexpr std::array<etendue::Option, 5> kOptions{{{"smooth", "Product of cosines"},
                                                            {"kink", "Product of |x - c|, c random"},
                                                            {"box", "Box with a random corner"},
                                                            {"ball", "Unit ball"},
                                                            {"sinc", "sin(x) / x, not defined at 0"}}};
};
