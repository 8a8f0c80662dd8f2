#include "spectrum/observer.h"

namespace etendue {
namespace {

// clang-format off
// The colour matching functions x, y and z [CIE 1931].
constexpr double kMatchingFunctions[kWavelengths][3] = {
    {0.001368, 3.9e-05, 0.00645}, {0.002236, 6.4e-05, 0.01055}, {0.004243, 0.00012, 0.02005},
    {0.00765, 0.000217, 0.03621}, {0.01431, 0.000396, 0.06785}, {0.02319, 0.00064, 0.1102}, {0.04351, 0.00121, 0.2074},
    {0.07763, 0.00218, 0.3713}, {0.13438, 0.004, 0.6456}, {0.21477, 0.0073, 1.03905}, {0.2839, 0.0116, 1.3856},
    {0.3285, 0.01684, 1.62296}, {0.34828, 0.023, 1.74706}, {0.34806, 0.0298, 1.7826}, {0.3362, 0.038, 1.77211},
    {0.3187, 0.048, 1.7441}, {0.2908, 0.06, 1.6692}, {0.2511, 0.0739, 1.5281}, {0.19536, 0.09098, 1.28764},
    {0.1421, 0.1126, 1.0419}, {0.09564, 0.13902, 0.81295}, {0.05795, 0.1693, 0.6162}, {0.03201, 0.20802, 0.46518},
    {0.0147, 0.2586, 0.3533}, {0.0049, 0.323, 0.272}, {0.0024, 0.4073, 0.2123}, {0.0093, 0.503, 0.1582},
    {0.0291, 0.6082, 0.1117}, {0.06327, 0.71, 0.07825}, {0.1096, 0.7932, 0.05725}, {0.1655, 0.862, 0.04216},
    {0.22575, 0.91485, 0.02984}, {0.2904, 0.954, 0.0203}, {0.3597, 0.9803, 0.0134}, {0.43345, 0.99495, 0.00875},
    {0.51205, 1.0, 0.00575}, {0.5945, 0.995, 0.0039}, {0.6784, 0.9786, 0.00275}, {0.7621, 0.952, 0.0021},
    {0.8425, 0.9154, 0.0018}, {0.9163, 0.87, 0.00165}, {0.9786, 0.8163, 0.0014}, {1.0263, 0.757, 0.0011},
    {1.0567, 0.6949, 0.001}, {1.0622, 0.631, 0.0008}, {1.0456, 0.5668, 0.0006}, {1.0026, 0.503, 0.00034},
    {0.9384, 0.4412, 0.00024}, {0.85445, 0.381, 0.00019}, {0.7514, 0.321, 0.0001}, {0.6424, 0.265, 5e-05},
    {0.5419, 0.217, 3e-05}, {0.4479, 0.175, 2e-05}, {0.3608, 0.1382, 1e-05}, {0.2835, 0.107, 0.0},
    {0.2187, 0.0816, 0.0}, {0.1649, 0.061, 0.0}, {0.1212, 0.04458, 0.0}, {0.0874, 0.032, 0.0}, {0.0636, 0.0232, 0.0},
    {0.04677, 0.017, 0.0}, {0.0329, 0.01192, 0.0}, {0.0227, 0.00821, 0.0}, {0.01584, 0.005723, 0.0},
    {0.0113592, 0.004102, 0.0}, {0.00811092, 0.002929, 0.0}, {0.00579035, 0.002091, 0.0}, {0.00410946, 0.001484, 0.0},
    {0.00289933, 0.001047, 0.0}, {0.00204919, 0.00074, 0.0}, {0.00143997, 0.00052, 0.0}, {0.000999949, 0.0003611, 0.0},
    {0.000690079, 0.0002492, 0.0}, {0.000476021, 0.0001719, 0.0}, {0.000332301, 0.00012, 0.0},
    {0.000234826, 8.48e-05, 0.0}, {0.000166151, 6e-05, 0.0}, {0.000117413, 4.24e-05, 0.0}, {8.30753e-05, 3e-05, 0.0},
    {5.87065e-05, 2.12e-05, 0.0}, {4.15099e-05, 1.499e-05, 0.0},
};

// Illuminant D65 [CIE 15:2004].
constexpr double kD65[kWavelengths] = {
    49.9755, 52.3118, 54.6482, 68.7015, 82.7549, 87.1204, 91.486, 92.4589, 93.4318, 90.057, 86.6823, 95.7736, 104.865,
    110.936, 117.008, 117.41, 117.812, 116.336, 114.861, 115.392, 115.923, 112.367, 108.811, 109.082, 109.354, 108.578,
    107.802, 106.296, 104.79, 106.239, 107.689, 106.047, 104.405, 104.225, 104.046, 102.023, 100.0, 98.1671, 96.3342,
    96.0611, 95.788, 92.2368, 88.6856, 89.3459, 90.0062, 89.8026, 89.5991, 88.6489, 87.6987, 85.4936, 83.2886, 83.4939,
    83.6992, 81.863, 80.0268, 80.1207, 80.2146, 81.2462, 82.2778, 80.281, 78.2842, 74.0027, 69.7213, 70.6652, 71.6091,
    72.979, 74.349, 67.9765, 61.604, 65.7448, 69.8856, 72.4863, 75.087, 69.3398, 63.5927, 55.0054, 46.4182, 56.6118,
    66.8054, 65.0941, 63.3828,
};
// clang-format on

using Triplet = std::array<double, 3>;
using Matrix = std::array<Triplet, 3>;

// The position of a wavelength in the tables: interval and fraction. False outside.
bool locate(double wavelength, size_t& first, double& fraction) {
  if (!(wavelength >= kFirstWavelength && wavelength <= kLastWavelength)) return false;
  const double at = (wavelength - kFirstWavelength) / kWavelengthStep;
  first = std::min(static_cast<size_t>(at), kWavelengths - 2);
  fraction = at - static_cast<double>(first);
  return true;
}

double determinant(const Matrix& m) {
  return m[0][0] * (m[1][1] * m[2][2] - m[1][2] * m[2][1]) - m[0][1] * (m[1][0] * m[2][2] - m[1][2] * m[2][0]) +
         m[0][2] * (m[1][0] * m[2][1] - m[1][1] * m[2][0]);
}

Triplet product(const Matrix& m, const Triplet& v) {
  Triplet result{};
  for (size_t row = 0; row < 3; ++row)
    for (size_t k = 0; k < 3; ++k) result[row] += m[row][k] * v[k];
  return result;
}

Matrix inverse(const Matrix& m) {
  const double d = determinant(m);
  Matrix inverted{};
  for (size_t i = 0; i < 3; ++i)
    for (size_t j = 0; j < 3; ++j) {
      const size_t a = (j + 1) % 3, b = (j + 2) % 3, c = (i + 1) % 3, e = (i + 2) % 3;
      inverted[i][j] = (m[a][c] * m[b][e] - m[a][e] * m[b][c]) / d;
    }
  return inverted;
}

// XYZ to linear Rec. 709 such that `white` maps to (1, 1, 1).
Matrix rec709_from_xyz(const Triplet& white) {
  constexpr double kPrimaries[3][2] = {{0.64, 0.33}, {0.30, 0.60}, {0.15, 0.06}};  // chromaticities x, y
  Matrix primaries{};
  for (size_t c = 0; c < 3; ++c) {
    const double x = kPrimaries[c][0], y = kPrimaries[c][1];
    primaries[0][c] = x / y;
    primaries[1][c] = 1;
    primaries[2][c] = (1 - x - y) / y;
  }
  const Triplet scale = product(inverse(primaries), white);
  for (Triplet& row : primaries)
    for (size_t c = 0; c < 3; ++c) row[c] *= scale[c];
  return inverse(primaries);
}

// By the trapezoidal rule over the tables' wavelengths.
double trapezoid_weight(size_t i) { return i == 0 || i + 1 == kWavelengths ? kWavelengthStep / 2 : kWavelengthStep; }

struct RgbWeights {
  std::array<Triplet, kWavelengths> values;
  Matrix from_xyz;  // Y of white is 1

  RgbWeights() {
    Triplet white{};
    for (size_t i = 0; i < kWavelengths; ++i)
      for (size_t c = 0; c < 3; ++c) white[c] += kMatchingFunctions[i][c] * kD65[i] * trapezoid_weight(i);
    const double luminance = white[1];
    const Matrix from_xyz_of_d65 = rec709_from_xyz(white);
    for (size_t i = 0; i < kWavelengths; ++i) {
      const auto& m = kMatchingFunctions[i];
      values[i] = product(from_xyz_of_d65, {m[0] * kD65[i], m[1] * kD65[i], m[2] * kD65[i]});
    }
    for (double& v : white) v /= luminance;
    from_xyz = rec709_from_xyz(white);
  }
};

const RgbWeights& rgb_weights() {
  static const RgbWeights weights;
  return weights;
}

}  // namespace

Xyz observer_at(double wavelength) {
  size_t i;
  double t;
  if (!locate(wavelength, i, t)) return {};
  const auto at = [&](int c) { return kMatchingFunctions[i][c] * (1 - t) + kMatchingFunctions[i + 1][c] * t; };
  return {at(0), at(1), at(2)};
}

double d65_at(double wavelength) {
  size_t i;
  double t;
  if (!locate(wavelength, i, t)) return 0;
  return kD65[i] * (1 - t) + kD65[i + 1] * t;
}

Xyz xyz_of(const std::function<double(double)>& spectrum) {
  Xyz sum;
  for (size_t i = 0; i < kWavelengths; ++i) {
    const double value = spectrum(table_wavelength(i)) * trapezoid_weight(i);
    sum.x += value * kMatchingFunctions[i][0];
    sum.y += value * kMatchingFunctions[i][1];
    sum.z += value * kMatchingFunctions[i][2];
  }
  return sum;
}

std::array<double, 3> relative_rgb_weights(double wavelength) {
  size_t i;
  double t;
  if (!locate(wavelength, i, t)) return {};
  const auto& table = rgb_weights().values;
  Triplet weights;
  for (size_t c = 0; c < 3; ++c) weights[c] = table[i][c] * (1 - t) + table[i + 1][c] * t;
  return weights;
}

std::array<double, 3> relative_rgb_of(const std::function<double(double)>& spectrum) {
  const auto& table = rgb_weights().values;
  Triplet rgb{};
  for (size_t i = 0; i < kWavelengths; ++i) {
    const double value = spectrum(table_wavelength(i)) * trapezoid_weight(i);
    for (size_t c = 0; c < 3; ++c) rgb[c] += value * table[i][c];
  }
  return rgb;
}

std::array<double, 3> rgb_of(const Xyz& color) { return product(rgb_weights().from_xyz, {color.x, color.y, color.z}); }

}  // namespace etendue
