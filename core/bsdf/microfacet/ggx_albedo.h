// The directional albedo of GGX microfacets with Schlick's Fresnel term, from a table.
//
//   E(w) = f0 A(cos, alpha) + f90 B(cos, alpha)                                            [Karis 2013]
//
// A and B are the integrals of D G2 cos_i / (4 cos_o cos_i) times 1 - s and s, with s = (1 - <o, h>)^5. Light that
// microfacets scatter more than once is not included. The interpolated values are upper bounds, so that a surface of
// which 1 - E reaches the base reflects at most all light. They exceed A and B by at most 0.005 for a roughness of at
// least 0.25, 0.06 for at least 0.07, and 0.11 below. Anisotropic microfacets have the roughness along the direction.
#pragma once
#include "bsdf/microfacet/ggx.h"
#include "bsdf/microfacet/ggx_albedo_table.h"

namespace etendue {

// A and B.
struct GgxAlbedo {
  float a = 0, b = 0;

  // E with F = 1.
  float total() const { return a + b; }
  // The cosine at which Schlick's weight is b / (a + b): the Fresnel term there is the mean over the microfacets.
  float mean_cosine() const { return 1 - std::pow(b / (a + b), 0.2f); }
};

// The row of the table for a roughness, interpolated between the nodes.
class GgxAlbedoRow {
 public:
  explicit GgxAlbedoRow(float alpha) {
    const float x = std::sqrt(alpha) * (kGgxAlbedoRoughnesses - 1);
    row_ = std::min(static_cast<int>(x), kGgxAlbedoRoughnesses - 2);
    fraction_ = x - static_cast<float>(row_);
  }

  // For a direction with this cosine to the normal, in [0, 1].
  GgxAlbedo at(float cosine) const {
    const float x = std::sqrt(cosine) * (kGgxAlbedoCosines - 1);
    const int column = std::min(static_cast<int>(x), kGgxAlbedoCosines - 2);
    return mixed(in_row(row_, column, x - static_cast<float>(column)),
                 in_row(row_ + 1, column, x - static_cast<float>(column)), fraction_);
  }
  // The cosine-weighted mean of `at` over the hemisphere.
  GgxAlbedo mean() const {
    return mixed(kMeans[static_cast<size_t>(row_)], kMeans[static_cast<size_t>(row_ + 1)], fraction_);
  }

 private:
  using Row = std::array<GgxAlbedo, kGgxAlbedoCosines>;
  using Table = std::array<Row, kGgxAlbedoRoughnesses>;

  static constexpr GgxAlbedo mixed(const GgxAlbedo& p, const GgxAlbedo& q, float t) {
    return {p.a + (q.a - p.a) * t, p.b + (q.b - p.b) * t};
  }
  static GgxAlbedo in_row(int row, int column, float t) {
    const GgxAlbedo* node = &kTable[static_cast<size_t>(row)][static_cast<size_t>(column)];
    return mixed(node[0], node[1], t);
  }

  static constexpr Table make_table() {
    Table table{};
    for (size_t r = 0; r < table.size(); ++r)
      for (size_t c = 0; c < table[r].size(); ++c)
        table[r][c] = {static_cast<float>(kGgxAlbedoValues[r][c][0]) * 1e-4f,
                       static_cast<float>(kGgxAlbedoValues[r][c][1]) * 1e-4f};
    return table;
  }
  // The integral of the interpolated row times 2 cos dcos = 4 x^3 dx, x = sqrt(cos). Each interval contributes
  // p (w - m) + q m, with the weights w and m of a constant and of a ramp from 0 to 1.
  static constexpr GgxAlbedo mean_of(const Row& row) {
    double a = 0, b = 0;
    const auto power = [](double x, int n) {
      double p = 1;
      for (int k = 0; k < n; ++k) p *= x;
      return p;
    };
    constexpr double kStep = 1.0 / (kGgxAlbedoCosines - 1);
    for (size_t c = 0; c + 1 < row.size(); ++c) {
      const double from = static_cast<double>(c) * kStep, to = static_cast<double>(c + 1) * kStep;
      const double constant = power(to, 4) - power(from, 4);
      const double ramp = (0.8 * (power(to, 5) - power(from, 5)) - from * constant) / kStep;
      a += row[c].a * (constant - ramp) + row[c + 1].a * ramp;
      b += row[c].b * (constant - ramp) + row[c + 1].b * ramp;
    }
    return {static_cast<float>(a), static_cast<float>(b)};
  }
  static constexpr std::array<GgxAlbedo, kGgxAlbedoRoughnesses> make_means(const Table& table) {
    std::array<GgxAlbedo, kGgxAlbedoRoughnesses> means{};
    for (size_t r = 0; r < means.size(); ++r) means[r] = mean_of(table[r]);
    return means;
  }

  static const Table kTable;
  static const std::array<GgxAlbedo, kGgxAlbedoRoughnesses> kMeans;

  int row_ = 0;
  float fraction_ = 0;
};

inline constexpr GgxAlbedoRow::Table GgxAlbedoRow::kTable = GgxAlbedoRow::make_table();
inline constexpr std::array<GgxAlbedo, kGgxAlbedoRoughnesses> GgxAlbedoRow::kMeans =
    GgxAlbedoRow::make_means(GgxAlbedoRow::kTable);

// For a direction on either side of the surface.
inline GgxAlbedo ggx_albedo(const Ggx& facets, const Vec3& w) {
  return GgxAlbedoRow(facets.alpha_along(w)).at(std::abs(w.z));
}

}  // namespace etendue
