// FLIP: how different two pictures look to someone who flips between them on a screen.
//
// Source: P. Andersson, J. Nilsson, T. Akenine-Moeller, M. Oskarsson, K. Astroem, M. D. Fairchild, "FLIP: A Difference
// Evaluator for Alternating Images", Proc. ACM Comput. Graph. Interact. Tech. 3 (2), 2020; the version for low dynamic
// range. Colours pass a spatial filter for the eye's contrast sensitivity in the opponent space YCxCz, are clipped to
// what the screen shows, brought to L*a*b* with the Hunt effect, and compared by the HyAB distance raised to 0.7;
// differences of edges and points, found by derivatives of Gaussians, raise the result.
//
// Values are in [0, 1] a pixel: 0 where nothing can be seen, 1 for a plain green against a plain blue. Black against
// white gives 0.95 + 0.05 (100^0.7 - 0.4 c) / (0.6 c) = 0.967, c = HyAB(green, blue)^0.7 = 41.3: colours are further
// apart than greys.
#pragma once
#include <array>
#include <span>
#include <vector>

#include "base/result.h"
#include "image/display.h"
#include "image/image.h"
#include "metrics/separable.h"

namespace etendue::metrics {

// An eye 0.7 m from a screen that shows 3840 pixels on 0.7 m.
inline constexpr double kPixelsPerDegree = 3840 * 3.14159265358979323846 / 180;

// How pictures come to the screen, and the screen to the eye.
struct Look {
  float exposure = 0;  // EV
  image::ToneCurve curve = image::ToneCurve::none;
  double pixels_per_degree = kPixelsPerDegree;
};

// FLIP of every pixel, row by row, of two pictures as the screen shows them: linear Rec. 709 in [0, 1], three numbers
// a pixel.
std::vector<float> flip_map(int width, int height, std::span<const float> shown, std::span<const float> reference,
                            double pixels_per_degree = kPixelsPerDegree);

// The same of two beauty layers that are brought to the screen first. Images without RGB or of different sizes are an
// input error.
Result<std::vector<float>> flip_map(const image::LayeredImage& picture, const image::LayeredImage& reference,
                                    const Look& look);

double mean_of(std::span<const float> map);

// A sum of isotropic Gaussians, each the product of a kernel with itself; the weights of the whole filter add up to 1.
struct ContrastFilter {
  std::vector<Kernel> gaussians;
};
// For Y, Cx and Cz.
std::array<ContrastFilter, 3> contrast_filters(double pixels_per_degree);

// The Gaussian of sigma = 0.041 degrees and its first two derivatives; of each derivative the positive weights add up
// to 1 and the negative ones to -1.
struct FeatureKernels {
  Kernel gaussian, edge, point;
};
FeatureKernels feature_kernels(double pixels_per_degree);

}  // namespace etendue::metrics
