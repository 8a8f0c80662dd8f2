#include "metrics/flip.h"

#include <algorithm>
#include <cmath>

namespace etendue::metrics {
namespace {

// Constants of [Andersson et al. 2020], with their symbols. Distances below p_c times the largest one are mapped to
// [0, p_t], the others to [p_t, 1].
constexpr float kColorPower = 0.7f;       // q_c
constexpr float kColorKnee = 0.4f;        // p_c
constexpr float kColorKneeValue = 0.95f;  // p_t
constexpr float kInverseRoot2 = 0.70710678f;

// A colour; the functions state the colour space.
struct Triple {
  float x, y, z;
};

// Rows of the matrix from Rec. 709 to XYZ with white point D65 (IEC 61966-2-1). White is defined as the sum of the
// columns, so that it is exactly achromatic.
constexpr Triple kX{0.4124564f, 0.3575761f, 0.1804375f}, kY{0.2126729f, 0.7151522f, 0.0721750f},
    kZ{0.0193339f, 0.1191920f, 0.9503041f};

constexpr float dot(const Triple& a, const Triple& b) { return a.x * b.x + a.y * b.y + a.z * b.z; }
constexpr float sum_of(const Triple& a) { return a.x + a.y + a.z; }

// X, Y, Z divided by those of white.
Triple relative_xyz(const Triple& rgb) {
  return {dot(kX, rgb) / sum_of(kX), dot(kY, rgb) / sum_of(kY), dot(kZ, rgb) / sum_of(kZ)};
}

Triple rgb_from_relative_xyz(const Triple& xyz) {
  const Triple v{xyz.x * sum_of(kX), xyz.y * sum_of(kY), xyz.z * sum_of(kZ)};
  // The inverse of the matrix above.
  return {3.2404542f * v.x - 1.5371385f * v.y - 0.4985314f * v.z,
          -0.9692660f * v.x + 1.8760108f * v.y + 0.0415560f * v.z,
          0.0556434f * v.x - 0.2040259f * v.y + 1.0572252f * v.z};
}

// YCxCz, the linear counterpart of L*a*b*. The affine scales of its definition are omitted: they cancel in filters
// whose weights sum to one. Luminance stays in [0, 1].
Triple opponent(const Triple& rgb) {
  const Triple v = relative_xyz(rgb);
  return {v.y, v.x - v.y, v.y - v.z};
}

Triple rgb_from_opponent(const Triple& c) { return rgb_from_relative_xyz({c.x + c.y, c.x, c.x - c.z}); }

float lab_curve(float t) {
  constexpr float kKnee = 6.0f / 29;
  return t > kKnee * kKnee * kKnee ? std::cbrt(t) : t / (3 * kKnee * kKnee) + 4.0f / 29;
}

// L*a*b* with the Hunt effect: chroma is scaled by lightness.
Triple hunt_lab(const Triple& rgb) {
  const Triple v = relative_xyz(rgb);
  const float fy = lab_curve(v.y), lightness = 116 * fy - 16;
  return {lightness, 0.01f * lightness * 500 * (lab_curve(v.x) - fy), 0.01f * lightness * 200 * (fy - lab_curve(v.z))};
}

// HyAB distance: city-block distance in lightness plus Euclidean distance in chroma.
float distance(const Triple& a, const Triple& b) {
  const float da = a.y - b.y, db = a.z - b.z;
  return std::abs(a.x - b.x) + std::sqrt(da * da + db * db);
}

float largest_distance() { return std::pow(distance(hunt_lab({0, 1, 0}), hunt_lab({0, 0, 1})), kColorPower); }

// The distance mapped to [0, 1], compressed for large distances.
float redistributed(float hyab, float largest) {
  const float d = std::pow(hyab, kColorPower), knee = kColorKnee * largest;
  if (d < knee) return kColorKneeValue / knee * d;
  return std::min(kColorKneeValue + (d - knee) / (largest - knee) * (1 - kColorKneeValue), 1.0f);
}

struct Opponent {
  Plane y, cx, cz;
};

Opponent opponent_planes(int width, int height, std::span<const float> rgb) {
  Opponent planes{Plane(width, height), Plane(width, height), Plane(width, height)};
  for (size_t i = 0; i < planes.y.values.size(); ++i) {
    const Triple c = opponent({rgb[3 * i], rgb[3 * i + 1], rgb[3 * i + 2]});
    planes.y.values[i] = c.x;
    planes.cx.values[i] = c.y;
    planes.cz.values[i] = c.z;
  }
  return planes;
}

Plane apply(const ContrastFilter& filter, const Plane& plane) {
  Plane sum = convolve(plane, filter.gaussians[0], filter.gaussians[0]);
  for (size_t k = 1; k < filter.gaussians.size(); ++k) {
    const Plane term = convolve(plane, filter.gaussians[k], filter.gaussians[k]);
    for (size_t i = 0; i < sum.values.size(); ++i) sum.values[i] += term.values[i];
  }
  return sum;
}

// L*a*b* with the Hunt effect of the contrast filtered image, clipped to the display gamut.
std::vector<Triple> filtered_colors(const Opponent& planes, const std::array<ContrastFilter, 3>& filters) {
  const Plane y = apply(filters[0], planes.y);
  const Plane cx = apply(filters[1], planes.cx);
  const Plane cz = apply(filters[2], planes.cz);
  std::vector<Triple> colors(y.values.size());
  const auto unit = [](float v) { return std::clamp(v, 0.0f, 1.0f); };
  for (size_t i = 0; i < colors.size(); ++i) {
    const Triple rgb = rgb_from_opponent({y.values[i], cx.values[i], cz.values[i]});
    colors[i] = hunt_lab({unit(rgb.x), unit(rgb.y), unit(rgb.z)});
  }
  return colors;
}

// The Euclidean length of the vectors (a, b), per pixel.
Plane length(Plane a, const Plane& b) {
  for (size_t i = 0; i < a.values.size(); ++i)
    a.values[i] = std::sqrt(a.values[i] * a.values[i] + b.values[i] * b.values[i]);
  return a;
}

struct Features {
  Plane edges, points;
};

Features features_of(const Plane& luminance, const FeatureKernels& k) {
  const Plane smooth = convolve_rows(luminance, k.gaussian);
  return {length(convolve(luminance, k.edge, k.gaussian), convolve_columns(smooth, k.edge)),
          length(convolve(luminance, k.point, k.gaussian), convolve_columns(smooth, k.point))};
}

// The exponent q_f = 0.5 is a square root.
float feature_difference(const Features& a, const Features& b, size_t i) {
  const float edge = std::abs(a.edges.values[i] - b.edges.values[i]);
  const float point = std::abs(a.points.values[i] - b.points.values[i]);
  return std::min(std::sqrt(kInverseRoot2 * std::max(edge, point)), 1.0f);
}

struct PerceivedImage {
  std::vector<Triple> colors;
  Features features;
};

PerceivedImage perceive(int width, int height, std::span<const float> rgb, double pixels_per_degree) {
  const Opponent planes = opponent_planes(width, height, rgb);
  return {filtered_colors(planes, contrast_filters(pixels_per_degree)),
          features_of(planes.y, feature_kernels(pixels_per_degree))};
}

// Applies exposure and tone curve: linear Rec. 709 in [0, 1].
Result<std::vector<float>> displayed(const image::LayeredImage& image, const ViewingConditions& conditions) {
  const image::Layer* beauty = image.find("");
  if (!beauty || beauty->channels.size() != 3) return input_error("compare: an image has no R, G and B channels");
  std::vector<float> shown(beauty->pixels.size());
  const float scale = std::exp2(conditions.exposure);
  for (size_t i = 0; i + 2 < shown.size(); i += 3) {
    const Rgb radiance(beauty->pixels[i], beauty->pixels[i + 1], beauty->pixels[i + 2]);
    const Rgb c = image::tone_mapped(radiance * scale, conditions.curve);
    shown[i] = c.r;
    shown[i + 1] = c.g;
    shown[i + 2] = c.b;
  }
  return shown;
}

}  // namespace

std::vector<float> flip_map(int width, int height, std::span<const float> shown, std::span<const float> reference,
                            double pixels_per_degree) {
  const PerceivedImage a = perceive(width, height, shown, pixels_per_degree);
  const PerceivedImage b = perceive(width, height, reference, pixels_per_degree);
  const float largest = largest_distance();
  std::vector<float> map(a.colors.size());
  for (size_t i = 0; i < map.size(); ++i) {
    const float color = redistributed(distance(a.colors[i], b.colors[i]), largest);
    map[i] = std::pow(color, 1 - feature_difference(a.features, b.features, i));
  }
  return map;
}

Result<std::vector<float>> flip_map(const image::LayeredImage& image, const image::LayeredImage& reference,
                                    const ViewingConditions& conditions) {
  const auto a = displayed(image, conditions);
  const auto b = displayed(reference, conditions);
  if (!a) return a.error();
  if (!b) return b.error();
  if (image.width != reference.width || image.height != reference.height)
    return input_error("compare: the images differ in size; give two images of the same size");
  return flip_map(image.width, image.height, *a, *b, conditions.pixels_per_degree);
}

double mean_of(std::span<const float> map) {
  double sum = 0;
  for (const float v : map) sum += v;
  return map.empty() ? 0 : sum / static_cast<double>(map.size());
}

}  // namespace etendue::metrics
