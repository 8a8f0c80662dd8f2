#include "bsdf/lobes/sheen.h"

#include <array>
#include <cmath>

namespace etendue {
namespace {

// The fit of L, interpolated between its coefficients for a = 1 and a = 0.
struct Fit {
  float a, b, c, d, e;

  explicit Fit(float alpha) {
    const float t = sqr(1 - alpha);
    const auto between = [t](float rough, float smooth) { return rough + (smooth - rough) * t; };
    a = between(21.5473f, 25.3245f);
    b = between(3.82987f, 3.32435f);
    c = between(0.19823f, 0.16801f);
    d = between(-1.97760f, -1.27393f);
    e = between(-4.32054f, -4.85967f);
  }
  float exponent(float x) const { return a / (1 + b * std::pow(x, c)) + d * x + e; }
  float lambda(float cosine) const {
    return std::exp(cosine < 0.5f ? exponent(cosine) : 2 * exponent(0.5f) - exponent(1 - cosine));
  }
};

float alpha_of(float roughness) { return sqr(std::clamp(roughness, kMinSheenRoughness, 1.0f)); }

float distribution(const Vec3& o, const Vec3& i, float alpha) {
  const Vec3 h = o + i;
  const float sin2 = (sqr(h.x) + sqr(h.y)) / length_squared(h);
  return (2 + 1 / alpha) * std::pow(sin2, 0.5f / alpha) * (0.5f * kInvPi);
}

Vec3 direction_at(float cosine, float phi) {
  const float sine = safe_sqrt(1 - sqr(cosine));
  return {sine * std::cos(phi), sine * std::sin(phi), cosine};
}

// E by the midpoint rule. Nodes are the squares of equidistant numbers, because E varies most at grazing angles.
class AlbedoTable {
 public:
  AlbedoTable() {
    for (size_t r = 0; r < kRoughnesses; ++r) fill(r);
  }

  float at(float cosine, float roughness) const {
    const float x = std::sqrt(std::clamp(cosine, 0.0f, 1.0f)) * (kCosines - 1);
    const float y =
        std::clamp((roughness - kMinSheenRoughness) / (1 - kMinSheenRoughness), 0.0f, 1.0f) * (kRoughnesses - 1);
    const auto x0 = std::min(static_cast<size_t>(x), kCosines - 2);
    const auto y0 = std::min(static_cast<size_t>(y), kRoughnesses - 2);
    const float u = x - static_cast<float>(x0), v = y - static_cast<float>(y0);
    return (values_[y0][x0] * (1 - u) + values_[y0][x0 + 1] * u) * (1 - v) +
           (values_[y0 + 1][x0] * (1 - u) + values_[y0 + 1][x0 + 1] * u) * v;
  }

 private:
  static constexpr size_t kCosines = 32, kRoughnesses = 24;
  static constexpr int kSteps = 64, kAngles = 48;

  void fill(size_t r) {
    const float roughness = kMinSheenRoughness + (1 - kMinSheenRoughness) * static_cast<float>(r) / (kRoughnesses - 1);
    const float alpha = alpha_of(roughness);
    const Fit fit(alpha);
    std::array<float, kSteps> lambda;
    for (int k = 0; k < kSteps; ++k) lambda[static_cast<size_t>(k)] = fit.lambda(cosine_of(k));
    for (size_t c = 0; c < kCosines; ++c) {
      const float cosine = sqr(std::max(static_cast<float>(c) / (kCosines - 1), 1e-2f));
      const float lambda_o = fit.lambda(cosine);
      double sum = 0;
      for (int k = 0; k < kSteps; ++k) {
        double ring = 0;
        for (int a = 0; a < kAngles; ++a)
          ring += distribution(direction_at(cosine, 0),
                               direction_at(cosine_of(k), kPi * (static_cast<float>(a) + 0.5f) / kAngles), alpha);
        sum += ring * std::sqrt(cosine_of(k)) / (1 + lambda_o + lambda[static_cast<size_t>(k)]);
      }
      values_[r][c] = static_cast<float>(sum * kPi / (cosine * kSteps * kAngles));
    }
  }
  static float cosine_of(int k) { return sqr((static_cast<float>(k) + 0.5f) / kSteps); }

  std::array<std::array<float, kCosines>, kRoughnesses> values_;
};

}  // namespace

float sheen_albedo(float cosine, float roughness) {
  static const AlbedoTable table;
  return table.at(cosine, roughness);
}

float sheen_shape(const Vec3& o, const Vec3& i, float roughness) {
  const float alpha = alpha_of(roughness);
  const Fit fit(alpha);
  return distribution(o, i, alpha) / (4 * o.z * i.z * (1 + fit.lambda(o.z) + fit.lambda(i.z)));
}

}  // namespace etendue
