#include "patterns/pattern_drawing.h"

#include <algorithm>
#include <cmath>

#include "metrics/drawing_layout.h"
#include "metrics/function_chart.h"
#include "metrics/plane_drawing.h"

namespace etendue::patterns {
namespace {

using metrics::Drawing;

constexpr metrics::Color kGridColor{215, 215, 215};

Drawing points_drawing(const PointSet& set, const PatternDrawingOptions& options) {
  metrics::PlaneDrawing plane({.width = options.size, .height = options.size});
  plane.grid(options.cells[0], options.cells[1], kGridColor);
  for (const PlanePoint& p : set) plane.dot({p[0], p[1]}, metrics::method_color(0), set.size() > 1000 ? 1.2 : 2.4);
  return plane.finished("Points");
}

double spectrum_grey(double power) { return std::clamp((std::log10(power + 1e-9) + 2) / 4, 0.0, 1.0); }

Drawing radial_drawing(const Periodogram& spectrum, int size) {
  const RadialSpectrum radial = radial_spectrum(spectrum);
  metrics::FunctionCurve mean{.name = "mean power", .points = {}}, anisotropy{.name = "anisotropy", .points = {}};
  for (size_t i = 0; i < radial.mean.size(); ++i) {
    mean.points.push_back({static_cast<double>(i + 1), radial.mean[i]});
    anisotropy.points.push_back({static_cast<double>(i + 1), radial.anisotropy[i]});
  }
  metrics::ChartOptions options;
  options.width = size;
  options.height = size - 60;  // the legend is below
  return metrics::function_drawing({.title = "Radial mean of the spectrum",
                                    .x_label = "frequency",
                                    .y_label = "1 for random points",
                                    .curves = {mean, anisotropy}},
                                   options);
}

}  // namespace

Drawing spectrum_drawing(const Periodogram& spectrum, int size) {
  const double end = spectrum.extent + 0.5;
  metrics::PlaneDrawing plane({.x = {-end, end}, .y = {-end, end}, .width = size, .height = size});
  for (int ky = -spectrum.extent; ky <= spectrum.extent; ++ky)
    for (int kx = -spectrum.extent; kx <= spectrum.extent; ++kx) {
      const double grey = kx == 0 && ky == 0 ? 0 : spectrum_grey(spectrum.at(kx, ky));
      const auto level = static_cast<uint8_t>(std::lround(255 * grey));
      plane.rectangle({kx - 0.5, kx + 0.5}, {ky - 0.5, ky + 0.5}, {level, level, level});
    }
  return plane.finished("Spectrum");
}

Drawing pattern_drawing(const std::vector<PointSet>& sets, const PatternDrawingOptions& options) {
  const Periodogram spectrum = mean_periodogram(sets, options.extent);
  Drawing all;
  for (const Drawing& part : {points_drawing(sets.front(), options), spectrum_drawing(spectrum, options.size),
                              radial_drawing(spectrum, options.size)})
    metrics::place(all, part, {static_cast<double>(all.width), 0});
  return all;
}

}  // namespace etendue::patterns
