// Choice between results of a filter by estimates of their errors
#pragma once
#include <array>
#include <span>
#include <vector>

#include "film/half_buffers.h"
#include "spectrum/rgb.h"

namespace etendue::film {

using HalfImages = std::array<std::vector<Rgb>, kHalfBuffers>;

// Blends the means of both half-buffers of the candidates and of the images without filter. The weight of each is the
// fraction of nearby pixels where its estimated error is the smallest one.
//
// For a candidate F and independent half-buffers A and B, (F(A) - B)^2 is the squared error of F(A) plus the variance of
// B, in expectation. This variance is the same for all candidates and does not influence the choice.
std::vector<Rgb> best_of(std::span<const HalfImages> candidates, const HalfImages& unfiltered, int width, int height);

}  // namespace etendue::film
