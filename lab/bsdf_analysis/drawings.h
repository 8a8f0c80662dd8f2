// The instruments' readings as drawings (measure/drawing.h), for files and panels alike.
#pragma once
#include <span>
#include <string>

#include "bsdf_analysis/albedo.h"
#include "bsdf_analysis/lobe_shape.h"
#include "metrics/svg_chart.h"

namespace etendue::bsdf_analysis {

// Where there is less room than this, names are left to what stands beside the drawing.
inline constexpr int kRoomForNames = 300;

// The length that values are drawn with: as they are, or their fourth root, which shows what lies beneath a peak.
enum class Length { linear, root };

struct Look {
  int width = 480, height = 360;
  metrics::ChartPalette palette = {};
  Length length = Length::linear;
  double turn = 145, tilt = 25;  // degrees: the eye on a lobe
};

// Slices of several specimens about the normal, one colour each, with the direction to the eye.
metrics::Drawing polar_drawing(std::span<const Slice> slices, std::span<const std::string> names,
                               const Look& look = {});

// Albedo over the angle of the light, one colour each; what is above one is hatched.
metrics::Drawing albedo_drawing(std::span<const std::vector<Albedo>> curves, std::span<const std::string> names,
                                const Look& look = {});

// A lobe as a surface in space over a disk of the plane, painted by its height.
metrics::Drawing lobe_drawing(std::span<const LobeSurface> sides, double degrees, const Look& look = {});

}  // namespace etendue::bsdf_analysis

template <>
struct etendue::Options<etendue::bsdf_analysis::Length> {
  static constexpr std::array<etendue::Option, 2> kOptions{{{"linear", "As it is"}, {"root", "Fourth root"}}};
};
