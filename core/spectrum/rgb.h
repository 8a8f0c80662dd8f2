// RGB colour: scene-referred linear values for the Rec. 709 primaries and the white point D65
//
// Rgb is the colour type of the RGB transport model. The colour type of any transport model has the same interface:
// component-wise arithmetic, luminance, max_component, is_black and is_finite. Code outside of transport models does
// not depend on the number of components.
#pragma once
#include <algorithm>
#include <bit>
#include <cmath>
#include <cstdint>

namespace etendue {

struct Rgb {
  float r = 0, g = 0, b = 0;

  constexpr Rgb() = default;
  constexpr explicit Rgb(float grey) : r(grey), g(grey), b(grey) {}
  constexpr Rgb(float red, float green, float blue) : r(red), g(green), b(blue) {}

  float& operator[](int i) { return i == 0 ? r : i == 1 ? g : b; }
  float operator[](int i) const { return i == 0 ? r : i == 1 ? g : b; }

  constexpr Rgb& operator+=(const Rgb& o) {
    r += o.r;
    g += o.g;
    b += o.b;
    return *this;
  }
  constexpr Rgb& operator-=(const Rgb& o) {
    r -= o.r;
    g -= o.g;
    b -= o.b;
    return *this;
  }
  constexpr Rgb& operator*=(const Rgb& o) {
    r *= o.r;
    g *= o.g;
    b *= o.b;
    return *this;
  }
  constexpr Rgb& operator*=(float s) {
    r *= s;
    g *= s;
    b *= s;
    return *this;
  }
  constexpr Rgb& operator/=(float s) { return *this *= 1 / s; }

  friend constexpr Rgb operator+(Rgb a, const Rgb& b) { return a += b; }
  friend constexpr Rgb operator-(Rgb a, const Rgb& b) { return a -= b; }
  friend constexpr Rgb operator*(Rgb a, const Rgb& b) { return a *= b; }
  friend constexpr Rgb operator*(Rgb a, float s) { return a *= s; }
  friend constexpr Rgb operator*(float s, Rgb a) { return a *= s; }
  friend constexpr Rgb operator/(Rgb a, float s) { return a /= s; }
  friend constexpr bool operator==(const Rgb&, const Rgb&) = default;
};

// The relative luminance Y.
constexpr float luminance(const Rgb& c) { return 0.212671f * c.r + 0.715160f * c.g + 0.072169f * c.b; }
constexpr float max_component(const Rgb& c) { return std::max(c.r, std::max(c.g, c.b)); }
// a / b by component; 0 for components where b is 0.
constexpr Rgb ratio(const Rgb& a, const Rgb& b) {
  const auto part = [](float x, float y) { return y == 0 ? 0 : x / y; };
  return {part(a.r, b.r), part(a.g, b.g), part(a.b, b.b)};
}
constexpr float average(const Rgb& c) { return (c.r + c.g + c.b) * (1.0f / 3.0f); }
// True if all components are zero. One test on the combined bits, because three branches would be mispredicted.
constexpr bool is_black(const Rgb& c) {
  const auto bits = [](float x) { return std::bit_cast<uint32_t>(x); };
  return (bits(c.r) | bits(c.g) | bits(c.b)) << 1 == 0;
}
inline bool is_finite(const Rgb& c) { return std::isfinite(c.r) && std::isfinite(c.g) && std::isfinite(c.b); }
inline Rgb exp(const Rgb& c) { return {std::exp(c.r), std::exp(c.g), std::exp(c.b)}; }
// Linear interpolation from a (t = 0) to b (t = 1).
constexpr Rgb mix(const Rgb& a, const Rgb& b, float t) { return a * (1 - t) + b * t; }

// The sRGB transfer function of one component [IEC 61966-2-1] and its inverse.
inline float srgb_to_linear(float x) { return x <= 0.04045f ? x / 12.92f : std::pow((x + 0.055f) / 1.055f, 2.4f); }
inline float linear_to_srgb(float x) { return x <= 0.0031308f ? 12.92f * x : 1.055f * std::pow(x, 1 / 2.4f) - 0.055f; }

}  // namespace etendue
