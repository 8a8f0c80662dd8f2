// Drawings of the measurements (metrics/drawing.h), for files and panels.
#pragma once
#include <span>
#include <string>

#include "bsdf_analysis/albedo.h"
#include "bsdf_analysis/lobe_shape.h"
#include "metrics/convergence_chart.h"

namespace etendue::bsdf_analysis {

// Drawings narrower than this, in pixels, have no legend.
inline constexpr int kMinWidthForLegend = 300;

// How values are drawn: proportional, or as their fourth root, which makes the surroundings of a peak visible.
enum class LengthScale { linear, root };

struct DrawingOptions {
  int width = 480, height = 360;
  metrics::ChartPalette palette = {};
  LengthScale length_scale = LengthScale::linear;
  double azimuth = 145, elevation = 25;  // of the viewpoint of lobe_drawing, degrees
  std::string title = {};                // of polar_drawing; empty: that of slices of f cos
};

// Polar plot of slices around the normal, one colour each, with the direction wo of the first slice.
metrics::Drawing polar_drawing(std::span<const Slice> slices, std::span<const std::string> names,
                               const DrawingOptions& options = {});

// Albedo as a function of the polar angle of the light, one colour each; the region above one is tinted.
metrics::Drawing albedo_drawing(std::span<const std::vector<Albedo>> curves, std::span<const std::string> names,
                                const DrawingOptions& options = {});

// A lobe as a surface in space over a disk in the tangent plane, coloured by its values; `degrees` is the angle of wo.
metrics::Drawing lobe_drawing(std::span<const LobeSurface> sides, double degrees, const DrawingOptions& options = {});

}  // namespace etendue::bsdf_analysis

template <>
struct etendue::Options<etendue::bsdf_analysis::LengthScale> {
  static constexpr std::array<etendue::Option, 2> kOptions{{{"linear", "Linear"}, {"root", "Fourth root"}}};
};
