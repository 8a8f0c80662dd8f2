// Comparison of an image of constant radiance with a closed form.
#pragma once
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <string>

#include "support/scenes.h"

namespace etendue::test {

// The mean of every colour channel within 4.5 standard errors of at most `largest_error` of it.
inline void expect_radiance(const render::Document& d, uint32_t samples, const Rgb& expected, double largest_error,
                            const std::string& what) {
  const film::Film film = test::rendered(d, samples);
  const double n = static_cast<double>(film.width()) * film.height();
  for (int c = 0; c < 3; ++c) {
    double sum = 0, squares = 0;
    for (int y = 0; y < film.height(); ++y)
      for (int x = 0; x < film.width(); ++x) {
        const auto value = static_cast<double>(film.mean(x, y)[c]);
        sum += value;
        squares += value * value;
      }
    const double mean = sum / n, error = std::sqrt(std::max(squares / n - mean * mean, 0.0) / (n - 1));
    const auto wanted = static_cast<double>(expected[c]);
    EXPECT_NEAR(mean, wanted, 4.5 * error + 3e-4 * wanted + 1e-12) << what << ", channel " << c;
    EXPECT_LE(error, largest_error * wanted + 1e-12) << what << ", channel " << c;
  }
}

}  // namespace etendue::test
