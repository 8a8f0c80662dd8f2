// The filters of FLIP: contrast sensitivity of the eye, and detectors of edges and points.   [Andersson et al. 2020]
#include <cmath>

#include "metrics/flip.h"

namespace etendue::metrics {
namespace {

constexpr double kPi = 3.14159265358979323846;

// One term of a contrast sensitivity function: a sqrt(pi / b) exp(-pi^2 x^2 / b), x in degrees (table 1).
struct Term {
  double a, b;
};
constexpr Term kLuminance[] = {{1, 0.0047}};
constexpr Term kRedGreen[] = {{1, 0.0053}};
constexpr Term kBlueYellow[] = {{34.1, 0.04}, {13.5, 0.025}};
constexpr double kLargestB = 0.04;

constexpr double kFeatureWidth = 0.082;  // degrees

// exp(-c i^2) for i = -radius .. radius.
std::vector<double> gaussian_values(double c, int radius) {
  std::vector<double> values;
  for (int i = -radius; i <= radius; ++i) values.push_back(std::exp(-c * i * i));
  return values;
}

double sum_of(const std::vector<double>& values) {
  double sum = 0;
  for (const double v : values) sum += v;
  return sum;
}

Kernel scaled(const std::vector<double>& values, double scale) {
  Kernel kernel;
  for (const double v : values) kernel.taps.push_back(static_cast<float>(v * scale));
  return kernel;
}

// Three standard deviations of the widest term, used for all filters.
int contrast_radius(double pixels_per_degree) {
  return static_cast<int>(std::ceil(3 * std::sqrt(kLargestB / (2 * kPi * kPi)) * pixels_per_degree));
}

ContrastFilter contrast_filter(std::span<const Term> terms, double pixels_per_degree) {
  const int radius = contrast_radius(pixels_per_degree);
  std::vector<std::vector<double>> gaussians;
  std::vector<double> heights;
  double total = 0;
  for (const Term& term : terms) {
    gaussians.push_back(gaussian_values(kPi * kPi / (term.b * pixels_per_degree * pixels_per_degree), radius));
    heights.push_back(term.a * std::sqrt(kPi / term.b));
    const double sum = sum_of(gaussians.back());
    total += heights.back() * sum * sum;
  }
  ContrastFilter filter;
  for (size_t i = 0; i < gaussians.size(); ++i)
    filter.gaussians.push_back(scaled(gaussians[i], std::sqrt(heights[i] / total)));
  return filter;
}

// Scales the positive weights to a sum of 1 and the negative ones to a sum of -1.
Kernel balanced(std::vector<double> values) {
  double positive = 0, negative = 0;
  for (const double v : values) (v > 0 ? positive : negative) += std::abs(v);
  for (double& v : values) v /= v > 0 ? positive : negative;
  return scaled(values, 1);
}

}  // namespace

std::array<ContrastFilter, 3> contrast_filters(double pixels_per_degree) {
  return {contrast_filter(kLuminance, pixels_per_degree), contrast_filter(kRedGreen, pixels_per_degree),
          contrast_filter(kBlueYellow, pixels_per_degree)};
}

FeatureKernels feature_kernels(double pixels_per_degree) {
  const double sigma = 0.5 * kFeatureWidth * pixels_per_degree;
  const int radius = static_cast<int>(std::ceil(3 * sigma));
  const auto gaussian = gaussian_values(1 / (2 * sigma * sigma), radius);
  auto edge = gaussian, point = gaussian;
  for (int i = -radius; i <= radius; ++i) {
    edge[static_cast<size_t>(i + radius)] *= -i;
    point[static_cast<size_t>(i + radius)] *= i * i / (sigma * sigma) - 1;
  }
  return {scaled(gaussian, 1 / sum_of(gaussian)), balanced(std::move(edge)), balanced(std::move(point))};
}

}  // namespace etendue::metrics
