#include "advisor/reference_integrator.h"

#include <algorithm>
#include <cmath>

#include "render/incompatibility.h"
#include "scene/light_kinds.h"

namespace etendue::advisor {
namespace {

render::Document scaled(const render::Document& document, double scale) {
  render::Document d = document;
  const auto side = [&](int pixels) { return std::max(1, static_cast<int>(std::lround(pixels * scale))); };
  d.width = side(document.width);
  d.height = side(document.height);
  return d;
}

}  // namespace

render::Document with_reference_integrator(const render::Document& document) {
  render::Document d = document;
  d.method = {};
  d.method.paths = document.method.paths;
  d.method.color = document.method.color;
  d.limits = {};
  return d;
}

render::Document with_reference_integrator(const render::Document& document, const scene::CompiledScene& scene) {
  render::Document usual = with_reference_integrator(document);
  if (!has_point_lights(*document.scene) || !has_specular_surfaces(scene)) return usual;
  render::Document bidirectional = usual;
  bidirectional.method.integrator = "bdpt";
  return render::incompatibility(bidirectional, scene).empty() ? bidirectional : usual;
}

render::Document reduced_by(const render::Document& document, int divisor, int min_side) {
  const double short_side = std::min(document.width, document.height);
  return scaled(document, std::min(1.0, std::max(1.0 / divisor, min_side / short_side)));
}

render::Document limited_to(const render::Document& document, int max_pixels) {
  const double pixels = static_cast<double>(document.width) * document.height;
  return pixels <= max_pixels ? document : scaled(document, std::sqrt(max_pixels / pixels));
}

}  // namespace etendue::advisor
