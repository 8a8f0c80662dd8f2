// Colour as three bands: linear Rec. 709 primaries, D65, scene-referred. The colour type of the RGB transport model.
//
// A transport model's colour type must offer what this one does: arithmetic by component, luminance, max_component,
// is_black and is_finite. Nothing outside a transport model relies on there being three components.
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

  constexpr Rgb& operator+=(const Rgb& o) { return r += o.r, g += o.g, b += o.b, *this; }
  constexpr Rgb& operator-=(const Rgb& o) { return r -= o.r, g -= o.g, b -= o.b, *this; }
  constexpr Rgb& operator*=(const Rgb& o) { return r *= o.r, g *= o.g, b *= o.b, *this; }
  constexpr Rgb& operator*=(float s) { return r *= s, g *= s, b *= s, *this; }
  constexpr Rgb& operator/=(float s) { return *this *= 1 / s; }

  friend constexpr Rgb operator+(Rgb a, const Rgb& b) { return a += b; }
  friend constexpr Rgb operator-(Rgb a, const Rgb& b) { return a -= b; }
  friend constexpr Rgb operator*(Rgb a, const Rgb& b) { return a *= b; }
  friend constexpr Rgb operator*(Rgb a, float s) { return a *= s; }
  friend constexpr Rgb operator*(float s, Rgb a) { return a *= s; }
  friend constexpr Rgb operator/(Rgb a, float s) { return a /= s; }
  friend constexpr bool operator==(const Rgb&, const Rgb&) = default;
};

// Relative luminance Y of Rec. 709.
constexpr float luminance(const Rgb& c) { return 0.212671f * c.r + 0.715160f * c.g + 0.072169f * c.b; }
constexpr float max_component(const Rgb& c) { return std::max(c.r, std::max(c.g, c.b)); }
// a / b by component, zero where b is.
constexpr Rgb ratio(const Rgb& a, const Rgb& b) {
  const auto part = [](float x, float y) { return y == 0 ? 0 : x / y; };
  return {part(a.r, b.r), part(a.g, b.g), part(a.b, b.b)};
}
constexpr float average(const Rgb& c) { return (c.r + c.g + c.b) * (1.0f / 3.0f); }
// One test on the bits of all: three comparisons in a row cannot be foreseen.
constexpr bool is_black(const Rgb& c) {
  const auto bits = [](float x) { return std::bit_cast<uint32_t>(x); };
  return (bits(c.r) | bits(c.g) | bits(c.b)) << 1 == 0;
}
inline bool is_finite(const Rgb& c) { return std::isfinite(c.r) && std::isfinite(c.g) && std::isfinite(c.b); }
inline Rgb exp(const Rgb& c) { return {std::exp(c.r), std::exp(c.g), std::exp(c.b)}; }
constexpr Rgb mix(const Rgb& a, const Rgb& b, float t) { return a * (1 - t) + b * t; }

// The sRGB transfer curve (IEC 61966-2-1) on one component.
inline float srgb_to_linear(float x) { return x <= 0.04045f ? x / 12.92f : std::pow((x + 0.055f) / 1.055f, 2.4f); }
inline float linear_to_srgb(float x) { return x <= 0.0031308f ? 12.92f * x : 1.055f * std::pow(x, 1 / 2.4f) - 0.055f; }

}  // namespace etendue
