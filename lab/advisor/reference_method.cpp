#include "advisor/reference_method.h"

#include <algorithm>
#include <cmath>

namespace etendue::advisor {

render::Document trusted(const render::Document& document) {
  render::Document d = document;
  d.method = {};
  d.method.paths = document.method.paths;
  d.limits = {};
  return d;
}

render::Document smaller(const render::Document& document, int divisor, int least) {
  const double short_side = std::min(document.width, document.height);
  const double scale = std::min(1.0, std::max(1.0 / divisor, least / short_side));
  render::Document d = document;
  const auto scaled = [&](int pixels) { return std::max(1, static_cast<int>(std::lround(pixels * scale))); };
  d.width = scaled(document.width), d.height = scaled(document.height);
  return d;
}

}  // namespace etendue::advisor
