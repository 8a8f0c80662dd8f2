// Means over square windows, cut off at the borders of the image
#pragma once
#include <vector>

namespace etendue::film {

std::vector<float> box_filtered(const std::vector<float>& values, int width, int height, int radius);

}  // namespace etendue::film
