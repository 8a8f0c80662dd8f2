#include "film/denoise/candidate_choice.h"

#include <algorithm>

#include "film/denoise/box_filter.h"

namespace etendue::film {
namespace {

constexpr int kErrorRadius = 3;
constexpr int kChoiceRadius = 2;

float square_of(const Rgb& c) { return c.r * c.r + c.g * c.g + c.b * c.b; }

// Of each pixel, averaged over a window.
std::vector<float> errors_of(const HalfImages& candidate, const HalfImages& unfiltered, int width, int height) {
  std::vector<float> errors(unfiltered[0].size());
  for (size_t i = 0; i < errors.size(); ++i)
    errors[i] = (square_of(candidate[0][i] - unfiltered[1][i]) + square_of(candidate[1][i] - unfiltered[0][i])) / 2;
  return box_filtered(errors, width, height, kErrorRadius);
}

// The mean of both half-buffers has half the variance of each; with the variance of the other half-buffer, 3/4 of the
// squared difference.
std::vector<float> unfiltered_errors(const HalfImages& unfiltered, int width, int height) {
  std::vector<float> errors(unfiltered[0].size());
  for (size_t i = 0; i < errors.size(); ++i) errors[i] = 0.75f * square_of(unfiltered[0][i] - unfiltered[1][i]);
  return box_filtered(errors, width, height, kErrorRadius);
}

}  // namespace

std::vector<Rgb> best_of(std::span<const HalfImages> candidates, const HalfImages& unfiltered, int width, int height) {
  std::vector<std::vector<float>> errors;
  for (const HalfImages& candidate : candidates) errors.push_back(errors_of(candidate, unfiltered, width, height));
  errors.push_back(unfiltered_errors(unfiltered, width, height));
  const size_t pixels = unfiltered[0].size();
  std::vector<std::vector<float>> chosen(errors.size(), std::vector<float>(pixels));
  for (size_t i = 0; i < pixels; ++i) {
    const auto best = std::ranges::min_element(errors, {}, [i](const std::vector<float>& error) { return error[i]; });
    chosen[static_cast<size_t>(best - errors.begin())][i] = 1;
  }
  std::vector<Rgb> result(pixels, Rgb(0));
  for (size_t k = 0; k < chosen.size(); ++k) {
    const HalfImages& images = k < candidates.size() ? candidates[k] : unfiltered;
    const auto weights = box_filtered(chosen[k], width, height, kChoiceRadius);
    for (size_t i = 0; i < pixels; ++i)
      result[i] += (images[0][i] + images[1][i]) * (weights[i] / static_cast<float>(kHalfBuffers));
  }
  return result;
}

}  // namespace etendue::film
