// FLIP: the difference of two images as perceived when flipping between them on a screen.      [Andersson et al. 2020]
//
// The variant for low dynamic range images. Colours are filtered with the contrast sensitivity of the eye in the
// opponent space YCxCz, clipped to the display gamut, converted to L*a*b* with the Hunt effect and compared with the
// HyAB distance raised to 0.7. Differences of edges and points, detected by derivatives of Gaussians, raise the result.
//
// Values per pixel are in [0, 1]: 0 for no visible difference, 1 for uniform green against uniform blue. Black against
// white yields 0.95 + 0.05 (100^0.7 - 0.4 c) / (0.6 c) = 0.967 with c = HyAB(green, blue)^0.7 = 41.3, because colours
// differ more than greys.
#pragma once
#include <array>
#include <span>
#include <vector>

#include "base/result.h"
#include "image/display.h"
#include "image/image.h"
#include "metrics/separable.h"

namespace etendue::metrics {

// A viewing distance of 0.7 m from a screen of 3840 pixels on 0.7 m.
inline constexpr double kPixelsPerDegree = 3840 * 3.14159265358979323846 / 180;

// Display transform of the images, and angular resolution of the screen as seen by the observer.
struct ViewingConditions {
  float exposure = 0;  // EV
  image::ToneCurve curve = image::ToneCurve::none;
  double pixels_per_degree = kPixelsPerDegree;
};

// FLIP per pixel, row by row, of two displayed images: linear Rec. 709 in [0, 1], three numbers per pixel.
std::vector<float> flip_map(int width, int height, std::span<const float> shown, std::span<const float> reference,
                            double pixels_per_degree = kPixelsPerDegree);

// FLIP of two beauty layers after the display transform. Images without RGB or of different sizes are an input error.
Result<std::vector<float>> flip_map(const image::LayeredImage& image, const image::LayeredImage& reference,
                                    const ViewingConditions& conditions);

double mean_of(std::span<const float> map);

// A sum of isotropic Gaussians, each given as the one-dimensional kernel of its separable form. The weights of the
// two-dimensional filter sum to 1.
struct ContrastFilter {
  std::vector<Kernel> gaussians;
};
// The filters of Y, Cx and Cz.
std::array<ContrastFilter, 3> contrast_filters(double pixels_per_degree);

// The Gaussian of sigma = 0.041 degrees and its first (edges) and second (points) derivative. The positive weights of
// each derivative sum to 1, the negative ones to -1.
struct FeatureKernels {
  Kernel gaussian, edge, point;
};
FeatureKernels feature_kernels(double pixels_per_degree);

}  // namespace etendue::metrics
