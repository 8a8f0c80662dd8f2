#include "support/ggx_albedo_quadrature.h"

#include <algorithm>
#include <cmath>

#include "bsdf/fresnel/fresnel.h"

namespace etendue::test {
namespace {

constexpr int kInnerPoints = 5, kInnerPointsOfSmoothRow = 9;
constexpr float kMargin = 4e-4f;  // for errors of the quadrature and maxima between the points

// The albedo at a point of the table, in units of nodes.
GgxAlbedo albedo_at(double cosine_node, double roughness_node) {
  const double cosine = std::pow(cosine_node / (kGgxAlbedoCosines - 1), 2);
  const double alpha = std::pow(roughness_node / (kGgxAlbedoRoughnesses - 1), 2);
  return ggx_albedo_by_quadrature(std::max(cosine, 1e-4), std::max(alpha, static_cast<double>(kSmoothAlpha)));
}

// By how much the interpolation in a cell falls below the albedo.
GgxAlbedo deficit(const GgxAlbedoTable& t, size_t r, size_t c) {
  GgxAlbedo largest;
  const int points = r == 0 ? kInnerPointsOfSmoothRow : kInnerPoints;
  for (int i = 0; i < points; ++i)
    for (int j = 0; j < points; ++j) {
      const float u = static_cast<float>(i) / static_cast<float>(points - 1),
                  v = static_cast<float>(j) / static_cast<float>(points - 1);
      const GgxAlbedo exact =
          albedo_at(static_cast<double>(c) + static_cast<double>(u), static_cast<double>(r) + static_cast<double>(v));
      const auto between = [&](float GgxAlbedo::*part) {
        return (t[r][c].*part * (1 - u) + t[r][c + 1].*part * u) * (1 - v) +
               (t[r + 1][c].*part * (1 - u) + t[r + 1][c + 1].*part * u) * v;
      };
      largest.a = std::max(largest.a, exact.a - between(&GgxAlbedo::a));
      largest.b = std::max(largest.b, exact.b - between(&GgxAlbedo::b));
    }
  return {largest.a + kMargin, largest.b + kMargin};
}

}  // namespace

// The radius of a sample is the square root of u.x. Nodes are dense near u.x = 1, the normals at grazing angles.
GgxAlbedo ggx_albedo_by_quadrature(double cosine, double alpha) {
  constexpr int kRadii = 96, kAngles = 64;
  Ggx facets;
  facets.alpha_x = facets.alpha_y = static_cast<float>(alpha);
  const Vec3 o(static_cast<float>(std::sqrt(std::max(0.0, 1 - cosine * cosine))), 0, static_cast<float>(cosine));
  const auto lambda_o = static_cast<double>(facets.lambda(o));
  double a = 0, b = 0, total = 0;
  for (int r = 0; r < kRadii; ++r) {
    const double t = 1 - (r + 0.5) / kRadii, weight = 3 * t * t;
    for (int k = 0; k < kAngles; ++k) {
      total += weight;
      const Vec2 u(static_cast<float>(1 - t * t * t), 0.25f + 0.5f * (static_cast<float>(k) + 0.5f) / kAngles);
      const Vec3 h = facets.sample_visible(o, u), i = reflect(o, h);
      if (!(i.z > 0)) continue;
      const double g = weight * (1 + lambda_o) / (1 + lambda_o + static_cast<double>(facets.lambda(i)));
      const auto grazing = static_cast<double>(schlick_weight(glm::dot(o, h)));
      a += g * (1 - grazing);
      b += g * grazing;
    }
  }
  return {static_cast<float>(a / total), static_cast<float>(b / total)};
}

GgxAlbedoTable computed_ggx_albedo_table() {
  GgxAlbedoTable nodes;
  for (size_t r = 0; r < kGgxAlbedoRoughnesses; ++r)
    for (size_t c = 0; c < kGgxAlbedoCosines; ++c)
      nodes[r][c] = albedo_at(static_cast<double>(c), static_cast<double>(r));
  GgxAlbedoTable raised = nodes;
  for (size_t r = 0; r + 1 < kGgxAlbedoRoughnesses; ++r)
    for (size_t c = 0; c + 1 < kGgxAlbedoCosines; ++c) {
      const GgxAlbedo d = deficit(nodes, r, c);
      for (const size_t y : {r, r + 1})
        for (const size_t x : {c, c + 1}) {
          raised[y][x].a = std::max(raised[y][x].a, nodes[y][x].a + d.a);
          raised[y][x].b = std::max(raised[y][x].b, nodes[y][x].b + d.b);
        }
    }
  return raised;
}

}  // namespace etendue::test
