// Figures of chapter 6: sampling methods and stratification.
#include <algorithm>
#include <cmath>
#include <numbers>

#include "base/warp.h"
#include "equations/random_numbers.h"
#include "figures/tools.h"
#include "metrics/log_axis.h"
#include "patterns/distances.h"
#include "patterns/known_sets.h"

namespace etendue::figures {

using equations::RandomNumbers;
using patterns::PlanePoint;
using patterns::PointSet;

namespace {

constexpr double kTwoPi = 2 * std::numbers::pi;

// The inversion of a distribution function at equidistant values.
Part inversion_part(const std::string& name, const std::function<double(double)>& cdf,
                    const std::function<double(double)>& inverse, double end) {
  PlaneDrawing plane({.x = {0, end}, .y = {0, 1.05}, .width = 330, .height = 240});
  for (int i = 0; i < 12; ++i) {
    const double u = (i + 0.5) / 12, x = inverse(u);
    plane.line({{0, u}, {x, u}, {x, 0}}, transparent(ink(1), 0.6));
    plane.dot({x, 0}, ink(1), 3);
  }
  plane.line(sampled(cdf, 0, end, 400), ink(0), 2);
  return plane_part(name, plane);
}

// A hemisphere from above: directions are drawn at the projection of the unit vector onto the base.
Part hemisphere_part(const std::string& name, uint32_t count, uint64_t seed, double (*cosine)(double u)) {
  RandomNumbers random(seed);
  PlaneDrawing plane({.x = {-1.03, 1.03}, .y = {-0.25, 1.05}, .width = 300, .height = 200, .frame = false});
  constexpr double kSine = 0.28;  // of the elevation of the viewpoint
  for (uint32_t i = 0; i < count; ++i) {
    const double z = cosine(random.uniform()), r = std::sqrt(std::max(0.0, 1 - z * z)), a = kTwoPi * random.uniform();
    plane.dot({r * std::cos(a), z * std::sqrt(1 - kSine * kSine) + kSine * r * std::sin(a)}, ink(0), 1.1);
  }
  std::vector<Point> rim;
  for (int i = 0; i <= 64; ++i) rim.push_back({std::cos(kTwoPi * i / 64), kSine * std::sin(kTwoPi * i / 64)});
  plane.line(rim, kGrey);
  return plane_part(name + ", " + std::to_string(count) + " directions", plane);
}

template <class Cosine>
Parts hemisphere_parts(const char* name, const MakeContext& context, Cosine cosine) {
  Parts parts;
  for (const uint32_t n : {1000U, 2500U, 5000U}) parts.push_back(hemisphere_part(name, n, context.seed, cosine));
  return parts;
}

PlaneDrawing disk_plane() {
  return PlaneDrawing({.x = {-1.05, 1.05}, .y = {-1.05, 1.05}, .width = 240, .height = 240, .frame = false});
}

// Random darts that keep a distance from all earlier ones.
template <class Distance>
std::vector<std::array<double, 3>> thrown_darts(int darts, double distance, RandomNumbers& random,
                                                Distance&& dart_distance,
                                                std::array<double, 3> (*draw)(RandomNumbers&)) {
  std::vector<std::array<double, 3>> kept;
  for (int i = 0; i < darts; ++i) {
    const auto dart = draw(random);
    if (std::ranges::all_of(kept, [&](const auto& other) { return dart_distance(dart, other) >= distance; }))
      kept.push_back(dart);
  }
  return kept;
}
double euclidean(const std::array<double, 3>& a, const std::array<double, 3>& b) {
  return std::hypot(a[0] - b[0], a[1] - b[1], a[2] - b[2]);
}

// A point in every cell of a regular grid: `offset` gives its place within the cell.
template <class Offset>
PointSet cell_points(uint32_t side, Offset&& offset) {
  return patterns::point_set(side * side, [&](uint32_t i) {
    const double x = offset(), y = offset();
    return PlanePoint{(i % side + x) / side, (i / side + y) / side};
  });
}

PointSet latin_points(const std::vector<int>& first, const std::vector<int>& second, RandomNumbers& random) {
  PointSet set;
  const auto n = static_cast<double>(first.size());
  for (size_t i = 0; i < first.size(); ++i) {
    const double x = random.uniform(), y = random.uniform();
    set.push_back({(first[i] - 1 + x) / n, (second[i] - 1 + y) / n});
  }
  return set;
}

std::vector<int> shuffled(int n, RandomNumbers& random) {
  std::vector<int> order;
  for (int i = 1; i <= n; ++i) order.push_back(i);
  for (size_t i = order.size(); i > 1; --i)
    std::swap(order[i - 1], order[static_cast<size_t>(random.uniform() * static_cast<double>(i))]);
  return order;
}

Part voronoi_part(const std::string& name, const PointSet& set) {
  PlaneDrawing plane;
  for (const PointSet& cell : patterns::voronoi_cells(set)) {
    std::vector<Point> corners = to_points(cell);
    corners.push_back(corners.front());
    plane.line(corners, kGrey);
  }
  plane.dots(to_points(set), ink(0), 2.4);
  return plane_part(name, plane);
}

// A grid of the unit square under a map to the disk.
Part disk_map_part(const std::string& name, Point (*map)(double, double)) {
  PlaneDrawing plane = disk_plane();
  constexpr int kLines = 8;
  for (int i = 0; i <= kLines; ++i) {
    const double fixed = static_cast<double>(i) / kLines;
    std::vector<Point> along, across;
    for (int k = 0; k <= 100; ++k) {
      along.push_back(map(fixed, k / 100.0));
      across.push_back(map(k / 100.0, fixed));
    }
    plane.line(along, ink(0));
    plane.line(across, ink(1));
  }
  return plane_part(name, plane);
}
Point cartesian_to_disk(double u, double v) {
  // Rows of the disk: the height is uniform, points fill the width of the disk at that height.
  const double y = 2 * v - 1, half = std::sqrt(std::max(0.0, 1 - y * y));
  return {(2 * u - 1) * half, y};
}
Point polar_to_disk(double u, double v) {
  return {std::sqrt(u) * std::cos(kTwoPi * v), std::sqrt(u) * std::sin(kTwoPi * v)};
}
Point concentric_to_disk(double u, double v) {
  const Vec2 p = square_to_disk({static_cast<float>(u), static_cast<float>(v)});
  return {static_cast<double>(p.x), static_cast<double>(p.y)};
}

double interval_kept_away(double u) { return 0.25 + 0.5 * u; }

}  // namespace

Figure figure_6_8() {
  return {.title = "The inversion method",
          .note =
              "Equidistant values of u on the vertical axis, and the samples on the horizontal axis: they are dense "
              "where the distribution function is steep.",
          .make = [](const MakeContext&) -> Result<Parts> {
            const auto cdf = [](double x) { return 0.5 + 0.5 * std::tanh(4 * (x - 0.45)) / std::tanh(4 * 0.55); };
            const auto scaled = [cdf](double x) { return (cdf(x) - cdf(0)) / (cdf(1) - cdf(0)); };
            const auto inverse = [scaled](double u) {
              double low = 0, high = 1;
              for (int i = 0; i < 50; ++i) (scaled(0.5 * (low + high)) < u ? low : high) = 0.5 * (low + high);
              return low;
            };
            return Parts{inversion_part("A continuous distribution", scaled, inverse, 1)};
          }};
}

Figure figure_6_9() {
  return {.title = "Inversion of the discrete distribution p_i = 2^-i",
          .make = [](const MakeContext&) -> Result<Parts> {
            const auto cdf = [](double x) { return 1 - std::pow(2, -std::floor(x)); };
            const auto inverse = [](double u) { return std::ceil(-std::log2(1 - u)); };
            return Parts{inversion_part("Probabilities 1/2, 1/4, 1/8, ... of 1, 2, 3, ...", cdf, inverse, 6)};
          }};
}

Figure figure_6_10() {
  return {
      .title = "Inversion of power distributions", .make = [](const MakeContext&) -> Result<Parts> {
        Parts parts;
        for (const int n : {1, 2, 5})
          parts.push_back(inversion_part(
              "p = " + std::to_string(n + 1) + " x^" + std::to_string(n), [n](double x) { return std::pow(x, n + 1); },
              [n](double u) { return std::pow(u, 1.0 / (n + 1)); }, 1));
        return parts;
      }};
}

Figure figure_6_11() {
  return {.title = "Inversion of a uniform distribution on [a, b]",
          .note = "Here a = 0.2 and b = 0.8.",
          .make = [](const MakeContext&) -> Result<Parts> {
            return Parts{inversion_part(
                "x = a + u (b - a)", [](double x) { return std::clamp((x - 0.2) / 0.6, 0.0, 1.0); },
                [](double u) { return 0.2 + 0.6 * u; }, 1)};
          }};
}

Figure figure_6_12() {
  return {
      .title = "Inversion of an exponential distribution", .make = [](const MakeContext&) -> Result<Parts> {
        return Parts{inversion_part(
            "x = -ln(1 - u)", [](double x) { return 1 - std::exp(-x); }, [](double u) { return -std::log(1 - u); }, 4)};
      }};
}

Figure figure_6_14() {
  return {.title = "Cosine-weighted directions on the hemisphere",
          .make = [](const MakeContext& context) -> Result<Parts> {
            return hemisphere_parts("Cosine", context, [](double u) { return std::sqrt(u); });
          }};
}

Figure figure_6_15() {
  return {.title = "Directions with uniform density per solid angle",
          .make = [](const MakeContext& context) -> Result<Parts> {
            return hemisphere_parts("Uniform", context, [](double u) { return u; });
          }};
}

Figure figure_6_16() {
  return {.title = "Uniform points on the disk", .make = [](const MakeContext& context) -> Result<Parts> {
            Parts parts;
            for (const int n : {1000, 2500, 5000}) {
              RandomNumbers random(context.seed);
              PlaneDrawing plane = disk_plane();
              for (int i = 0; i < n; ++i) {
                const double u = random.uniform();
                plane.dot(polar_to_disk(u, random.uniform()), ink(0), 1.1);
              }
              plane.circle({0, 0}, 1, kGrey);
              parts.push_back(plane_part(std::to_string(n) + " points", plane));
            }
            return parts;
          }};
}

Figure figure_6_18() {
  return {.title = "Acceptance-rejection sampling", .make = [](const MakeContext& context) -> Result<Parts> {
            const auto p = [](double x) { return 3 * x * x; };
            RandomNumbers random(context.seed);
            PlaneDrawing plane({.x = {0, 1}, .y = {0, 3.05}, .width = 420, .height = 280});
            int accepted = 0;
            for (int i = 0; i < 400; ++i) {
              const double x = random.uniform(), y = 3 * random.uniform();
              accepted += y < p(x) ? 1 : 0;
              plane.dot({x, y}, y < p(x) ? ink(0) : transparent(ink(1), 0.6), 2.2);
            }
            plane.line(sampled(p, 0, 1), kBlack, 2);
            return Parts{plane_part("p = 3 x\u00b2 below the bound 3: " + std::to_string(accepted) +
                                        " of 400 points are accepted (expected: 133)",
                                    plane)};
          }};
}

Figure figure_6_19() {
  return {
      .title = "The area of the unit disk by hit or miss",
      .note = "The standard deviation is 1.642 / sqrt(N). The book prints pi divided by the estimate.",
      .make = [](const MakeContext& context) -> Result<Parts> {
        Parts parts;
        for (const int n : {100, 200, 2000}) {
          RandomNumbers random(context.seed);
          PlaneDrawing plane({.x = {-1, 1}, .y = {-1, 1}, .width = 240, .height = 240});
          int hits = 0;
          for (int i = 0; i < n; ++i) {
            const double x = 2 * random.uniform() - 1, y = 2 * random.uniform() - 1;
            const bool hit = x * x + y * y < 1;
            hits += hit ? 1 : 0;
            plane.dot({x, y}, hit ? ink(0) : ink(1), n > 1000 ? 1.2 : 2.2);
          }
          plane.circle({0, 0}, 1, kBlack);
          parts.push_back(plane_part(std::to_string(n) + " points: " + metrics::short_number(4.0 * hits / n), plane));
        }
        return parts;
      }};
}

Figure figure_6_20() {
  return {.title = "Cosine-weighted directions by lifting points of the disk",
          .note = "Points of the square outside the disk are rejected; the others are moved up to the hemisphere.",
          .make = [](const MakeContext& context) -> Result<Parts> {
            RandomNumbers random(context.seed);
            PlaneDrawing disk = disk_plane(),
                         side({.x = {-1.05, 1.05}, .y = {-0.1, 1.05}, .width = 380, .height = 220, .frame = false});
            for (int i = 0; i < 700; ++i) {
              const double x = 2 * random.uniform() - 1, y = 2 * random.uniform() - 1, r2 = x * x + y * y;
              disk.dot({x, y}, r2 < 1 ? ink(0) : transparent(ink(1), 0.5), 1.6);
              if (r2 >= 1 || std::abs(y) > 0.12) continue;
              side.line({{x, 0}, {x, std::sqrt(1 - r2)}}, kLightGrey);
              side.dot({x, 0}, ink(0), 2);
              side.dot({x, std::sqrt(1 - r2)}, ink(0), 2);
            }
            disk.circle({0, 0}, 1, kBlack);
            side.line(sampled([](double x) { return std::sqrt(std::max(0.0, 1 - x * x)); }, -1, 1, 400), kBlack);
            side.line({{-1, 0}, {1, 0}}, kBlack);
            return Parts{plane_part("Points of the square", disk),
                         plane_part("Lifted points with |y| < 0.12, from the side", side)};
          }};
}

Figure figure_6_21() {
  return {
      .title = "Poisson disk patterns by dart throwing",
      .note = "1000 darts. Circles have the radius of the distance. The book keeps 62, 211 and 473 darts.",
      .make = [](const MakeContext& context) -> Result<Parts> {
        Parts parts;
        for (const double distance : {0.1, 0.05, 0.025}) {
          RandomNumbers random(context.seed);
          const auto kept = thrown_darts(1000, distance, random, euclidean, [](RandomNumbers& numbers) {
            const double x = numbers.uniform();
            return std::array<double, 3>{x, numbers.uniform(), 0};
          });
          PlaneDrawing plane;
          for (size_t i = 0; i < kept.size(); i += 4) plane.circle({kept[i][0], kept[i][1]}, distance, kLightGrey);
          for (const auto& p : kept) plane.dot({p[0], p[1]}, ink(0), 2);
          parts.push_back(plane_part(
              "Distance " + metrics::short_number(distance) + ": " + std::to_string(kept.size()) + " points", plane));
        }
        return parts;
      }};
}

Figure figure_6_22() {
  return {.title = "Poisson disk patterns on the hemisphere",
          .note = "1000 darts with uniform density per solid angle, seen from above.",
          .make = [](const MakeContext& context) -> Result<Parts> {
            Parts parts;
            for (const double distance : {0.2, 0.1, 0.05}) {
              RandomNumbers random(context.seed);
              const auto kept = thrown_darts(1000, distance, random, euclidean, [](RandomNumbers& numbers) {
                const double z = numbers.uniform(), r = std::sqrt(1 - z * z), a = kTwoPi * numbers.uniform();
                return std::array<double, 3>{r * std::cos(a), r * std::sin(a), z};
              });
              PlaneDrawing plane = disk_plane();
              for (const auto& p : kept) plane.dot({p[0], p[1]}, ink(0), 2);
              plane.circle({0, 0}, 1, kGrey);
              parts.push_back(plane_part(
                  "Distance " + metrics::short_number(distance) + ": " + std::to_string(kept.size()) + " directions",
                  plane));
            }
            return parts;
          }};
}

Figure figure_6_28() {
  return {.title = "Supersampling of a pixel in 8 x 8 cells", .make = [](const MakeContext& context) -> Result<Parts> {
            RandomNumbers random(context.seed);
            return Parts{points_part("Midpoints", cell_points(8, [] { return 0.5; }), 8, 8),
                         points_part("Uniform in each cell", cell_points(8, [&] { return random.uniform(); }), 8, 8),
                         points_part("Kept away from the borders of cells",
                                     cell_points(8, [&] { return interval_kept_away(random.uniform()); }), 8, 8)};
          }};
}

Figure figure_6_29() {
  return {.title = "Voronoi cells of point sets",
          .note = "The hexagonal grid has 80 points.",
          .columns = 2,
          .make = [](const MakeContext&) -> Result<Parts> {
            const PointSet hammersley = patterns::hammersley_points(64), hexagonal = patterns::hexagonal_grid_points(8);
            return Parts{points_part("64 Hammersley points", hammersley),
                         voronoi_part("Their Voronoi cells", hammersley), points_part("Hexagonal grid", hexagonal),
                         voronoi_part("Its Voronoi cells", hexagonal)};
          }};
}

Figure figure_6_30() {
  return {.title = "Elementary intervals of area 1/32 in base 2",
          .columns = 3,
          .make = [](const MakeContext&) -> Result<Parts> {
            Parts parts;
            for (int columns = 32; columns >= 1; columns /= 2) {
              PlaneDrawing plane({.width = 180, .height = 180});
              plane.grid(columns, 32 / columns, ink(0));
              parts.push_back(plane_part(std::to_string(columns) + " x " + std::to_string(32 / columns), plane));
            }
            return parts;
          }};
}

Figure figure_6_31() {
  return {.title = "Maps of a grid of the unit square to the disk",
          .note =
              "The Cartesian map does not preserve ratios of areas, the other two do. The concentric map keeps cells "
              "compact.",
          .make = [](const MakeContext&) -> Result<Parts> {
            return Parts{disk_map_part("Cartesian", cartesian_to_disk), disk_map_part("Polar", polar_to_disk),
                         disk_map_part("Concentric", concentric_to_disk)};
          }};
}

Figure figure_6_32() {
  return {.title = "Latin hypercube samples",
          .note = "The left set has the permutations of example 6.37.",
          .make = [](const MakeContext& context) -> Result<Parts> {
            RandomNumbers random(context.seed);
            const auto first = shuffled(32, random), second = shuffled(32, random);
            return Parts{points_part("5 rooks", latin_points({1, 2, 3, 4, 5}, {3, 1, 5, 4, 2}, random), 5, 5),
                         points_part("32 rooks", latin_points(first, second, random), 32, 32)};
          }};
}

Figure figure_6_33() {
  return {
      .title = "Latin hypercube samples of pixel, lens and time",
      .note = "16 samples in five dimensions. Each row and column of the planes, and each interval of time, has one.",
      .make = [](const MakeContext& context) -> Result<Parts> {
        RandomNumbers random(context.seed);
        std::vector<std::vector<int>> orders;
        for (int d = 0; d < 5; ++d) orders.push_back(shuffled(16, random));
        PlaneDrawing time({.x = {0, 1}, .y = {0, 1}, .width = 260, .height = 260});
        time.grid(16, 1, kLightGrey);
        for (int i = 0; i < 16; ++i)
          time.dot({(orders[4][static_cast<size_t>(i)] - 1 + random.uniform()) / 16, (i + 0.5) / 16}, ink(0), 2.4);
        return Parts{points_part("Pixel", latin_points(orders[0], orders[1], random), 16, 16),
                     points_part("Lens", latin_points(orders[2], orders[3], random), 16, 16),
                     plane_part("Time, from left to right; one row per sample", time)};
      }};
}

Figure figure_6_34() {
  return {
      .title = "Jittered sampling", .make = [](const MakeContext& context) -> Result<Parts> {
        RandomNumbers random(context.seed);
        return Parts{
            points_part("Regular grid", cell_points(8, [] { return 0.5; }), 8, 8),
            points_part("Jittered by half a cell", cell_points(8, [&] { return 0.25 + 0.5 * random.uniform(); }), 8, 8),
            points_part("Jittered by a whole cell", cell_points(8, [&] { return random.uniform(); }), 8, 8)};
      }};
}

Figure figure_6_35() {
  return {.title = "The orthogonal array OA(8, 4, 2, 3)",
          .note = "Rows of even parity. Any three columns contain every row of three symbols once.",
          .make = [](const MakeContext&) -> Result<Parts> {
            PlaneDrawing plane({.x = {0, 4}, .y = {0, 8}, .width = 140, .height = 260});
            for (int row = 0; row < 8; ++row) {
              const int bits[] = {row >> 2 & 1, row >> 1 & 1, row & 1, (row >> 2 ^ row >> 1 ^ row) & 1};
              for (int column = 0; column < 4; ++column)
                if (bits[column] == 1)
                  plane.rectangle({static_cast<double>(column), column + 1.0}, {7.0 - row, 8.0 - row},
                                  transparent(ink(0), 0.6));
            }
            plane.grid(4, 8, kGrey);
            return Parts{plane_part("Filled cells are 1", plane)};
          }};
}

}  // namespace etendue::figures
