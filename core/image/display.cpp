#include "image/display.h"

namespace etendue::image {
namespace {

using Matrix = std::array<float, 9>;  // row-major

Rgb multiply(const Matrix& m, const Rgb& c) {
  return {m[0] * c.r + m[1] * c.g + m[2] * c.b, m[3] * c.r + m[4] * c.g + m[5] * c.b,
          m[6] * c.r + m[7] * c.g + m[8] * c.b};
}

// Applies f to each component.
template <class F>
Rgb each(const Rgb& c, F&& f) {
  return {f(c.r), f(c.g), f(c.b)};
}

float clamp_to_unit(float x) { return std::clamp(x, 0.0f, 1.0f); }

// Replaces NaN and negative values by zero, and limits large values so that their squares are finite; all curves reach
// white far below the limit.
float sanitized(float x) { return x > 0 ? std::min(x, 1e12f) : 0.0f; }

Rgb neutral_curve(Rgb c) {
  constexpr float kStart = 0.8f - 0.04f, kDesaturation = 0.15f;
  const float least = std::min(c.r, std::min(c.g, c.b));
  const float toe = least < 0.08f ? least - 6.25f * least * least : 0.04f;
  c -= Rgb(toe);
  const float peak = max_component(c);
  if (peak < kStart) return c;
  constexpr float kRange = 1 - kStart;
  const float compressed = 1 - kRange * kRange / (peak + kRange - kStart);
  c *= compressed / peak;
  return mix(c, Rgb(compressed), 1 - 1 / (kDesaturation * (peak - compressed) + 1));
}

Rgb aces_curve(const Rgb& c) {
  constexpr Matrix kIn{0.59719f, 0.35458f, 0.04823f, 0.07600f, 0.90834f, 0.01566f, 0.02840f, 0.13383f, 0.83777f};
  constexpr Matrix kOut{1.60475f, -0.53108f, -0.07367f, -0.10208f, 1.10813f, -0.00605f, -0.00327f, -0.07276f, 1.07602f};
  const Rgb fitted = each(multiply(kIn, c * (1 / 0.6f)), [](float v) {
    return (v * (v + 0.0245786f) - 0.000090537f) / (v * (0.983729f * v + 0.4329510f) + 0.238081f);
  });
  return multiply(kOut, fitted);
}

Rgb agx_curve(const Rgb& c) {
  constexpr Matrix kIn{0.842479062253094f,  0.0784335999999992f, 0.0792237451477643f,
                       0.0423282422610123f, 0.878468636469772f,  0.0791661274605434f,
                       0.0423756549057051f, 0.0784336f,          0.879142973793104f};
  constexpr Matrix kOut{1.19687900512017f,    -0.0980208811401368f, -0.0990297440797205f,
                        -0.0528968517574562f, 1.15190312990417f,    -0.0989611768448433f,
                        -0.0529716355144438f, -0.0980434501171241f, 1.15107367264116f};
  constexpr float kMinEv = -12.47393f, kMaxEv = 4.026069f;
  const Rgb logarithmic = each(multiply(kIn, c), [](float v) {
    return clamp_to_unit((std::log2(std::max(v, 1e-10f)) - kMinEv) / (kMaxEv - kMinEv));
  });
  const Rgb curved = each(logarithmic, [](float x) {
    const float x2 = x * x, x4 = x2 * x2;
    return 15.5f * x4 * x2 - 40.14f * x4 * x + 31.96f * x4 - 6.868f * x2 * x + 0.4298f * x2 + 0.1191f * x - 0.00232f;
  });
  // The fit gives display values encoded with gamma 2.2.
  return each(multiply(kOut, curved), [](float v) { return std::pow(std::max(v, 0.0f), 2.2f); });
}

}  // namespace

Rgb tone_mapped(const Rgb& radiance, ToneCurve curve) {
  Rgb c = each(radiance, sanitized);
  switch (curve) {
    case ToneCurve::none:
      break;
    case ToneCurve::neutral:
      c = neutral_curve(c);
      break;
    case ToneCurve::aces:
      c = aces_curve(c);
      break;
    case ToneCurve::agx:
      c = agx_curve(c);
      break;
  }
  return each(c, clamp_to_unit);
}

Rgb displayed(const Rgb& radiance, float exposure, ToneCurve curve) {
  return each(tone_mapped(radiance * std::exp2(exposure), curve), [](float c) { return linear_to_srgb(c); });
}

std::vector<uint8_t> display_pixels(std::span<const float> rgb, float exposure, ToneCurve curve) {
  std::vector<uint8_t> bytes(rgb.size());
  const float scale = std::exp2(exposure);
  for (size_t i = 0; i + 2 < rgb.size(); i += 3) {
    const Rgb mapped = tone_mapped(Rgb(rgb[i], rgb[i + 1], rgb[i + 2]) * scale, curve);
    for (size_t c = 0; c < 3; ++c)
      bytes[i + c] = static_cast<uint8_t>(linear_to_srgb(mapped[static_cast<int>(c)]) * 255 + 0.5f);
  }
  return bytes;
}

}  // namespace etendue::image
