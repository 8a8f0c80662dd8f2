// Figures of chapter 7: point sets and sequences.
#include <cmath>
#include <numbers>

#include "equations/random_numbers.h"
#include "figures/tools.h"
#include "metrics/log_axis.h"
#include "patterns/discrepancy.h"
#include "patterns/known_sets.h"
#include "patterns/net_quality.h"
#include "patterns/pattern_drawing.h"
#include "patterns/periodogram.h"
#include "patterns/sampler_points.h"
#include "sampling/halton.h"
#include "sampling/point_sets/poisson_disk.h"

namespace etendue::figures {

using patterns::extreme_discrepancy;
using patterns::halton_points;
using patterns::hammersley_points;
using patterns::hexagonal_grid_points;
using patterns::mean_periodogram;
using patterns::net_quality;
using patterns::PlanePoint;
using patterns::point_set;
using patterns::PointRequest;
using patterns::points_of;
using patterns::PointSet;
using patterns::regular_grid_points;
using patterns::star_discrepancy;
using patterns::zaremba_points;

namespace {

PointSet faure_scrambled_set(uint32_t count, uint32_t base_x, uint32_t base_y) {
  const auto x = HaltonSampler::faure_permutation(base_x), y = HaltonSampler::faure_permutation(base_y);
  return point_set(count, [&](uint32_t i) {
    return PlanePoint{HaltonSampler::radical_inverse(i, x), HaltonSampler::radical_inverse(i, y)};
  });
}
// Of a registered sampler, with its settings as "NAME=VALUE".
PointSet sampler_set(const char* sampler, uint32_t count, uint64_t seed,
                     std::initializer_list<const char*> settings = {}) {
  PointRequest request{.sampler = sampler, .count = count, .seed = seed};
  for (const std::string_view text : settings) {
    const size_t sign = text.find('=');
    const ParameterInfo* info = find_parameter(find_sampler(sampler)->parameters, text.substr(0, sign));
    request.settings.push_back({info->name, *parse_value(*info, std::string(text.substr(sign + 1)))});
  }
  return *points_of(request);
}

uint32_t poisson_disk_size() {
  return static_cast<uint32_t>(PoissonDiskSampler::points(PoissonDiskSize::medium).points.size());
}

std::string with_discrepancy(const std::string& text, const PointSet& set) {
  return text + ", D* = " + metrics::short_number(star_discrepancy(set));
}

Result<Parts> first_points(const char* name, PointSet (*make)(uint32_t)) {
  Parts parts;
  for (const uint32_t n : {64U, 256U, 512U}) {
    const PointSet set = make(n);
    parts.push_back(points_part(with_discrepancy(std::string(name) + ", " + std::to_string(n) + " points", set), set));
  }
  return parts;
}

double correlation(const PointSet& set) {
  double x = 0, y = 0, xx = 0, yy = 0, xy = 0;
  const auto n = static_cast<double>(set.size());
  for (const auto& p : set) {
    x += p[0] / n;
    y += p[1] / n;
  }
  for (const auto& p : set) {
    xx += (p[0] - x) * (p[0] - x);
    yy += (p[1] - y) * (p[1] - y);
    xy += (p[0] - x) * (p[1] - y);
  }
  return xy / std::sqrt(xx * yy);
}

// Two coordinates of the Halton sequence with the bases as printed.
Part pair_part(const PointSet& set, const std::string& name) {
  return points_part(with_discrepancy(name + ": correlation " + metrics::short_number(correlation(set)), set), set);
}
std::string bases(uint32_t x, uint32_t y) { return "bases " + std::to_string(x) + " and " + std::to_string(y); }

// Points on borders of cells are moved into them.
constexpr double kShift = 1.0 / 32;
PointSet moved(PointSet set, double by) {
  for (auto& p : set)
    for (double& x : p) x += by;
  return set;
}

// The set over all grids of 16 cells whose numbers of columns and rows are powers of two. Cells without points are grey.
Parts interval_parts(const PointSet& set, int least_columns, int most_columns, int cells) {
  Parts parts;
  for (int columns = least_columns; columns <= most_columns; columns *= 2) {
    const int rows = cells / columns;
    PlaneDrawing plane({.width = 190, .height = 190});
    std::vector<int> counts(static_cast<size_t>(cells));
    for (const auto& p : set)
      ++counts[static_cast<size_t>(static_cast<int>(p[1] * rows) * columns + static_cast<int>(p[0] * columns))];
    for (int i = 0; i < cells; ++i)
      if (counts[static_cast<size_t>(i)] == 0) {
        const double x = i % columns, y = i / columns;  // NOLINT(bugprone-integer-division)
        plane.rectangle({x / columns, (x + 1) / columns}, {y / rows, (y + 1) / rows}, kLightGrey);
      }
    plane.grid(columns, rows, kGrey);
    plane.dots(to_points(moved(set, kShift)), ink(0), 3);
    parts.push_back(plane_part(std::to_string(columns) + " x " + std::to_string(rows) + " intervals", plane));
  }
  return parts;
}

Part spectrum_part(const std::string& name, const std::vector<PointSet>& sets) {
  constexpr int kExtent = 32, kSize = 195;
  return {.caption = name + ": spectrum",
          .content = patterns::spectrum_drawing(mean_periodogram(sets, kExtent), kSize)};
}

// Point sets in the first row, their spectra in the second. Random sets have the mean spectrum of several.
struct PatternKind {
  const char* name;
  std::vector<PointSet> sets;
};
Parts patterns_with_spectra(const std::vector<PatternKind>& kinds) {
  Parts parts;
  for (const auto& kind : kinds) {
    PlaneDrawing plane({.width = 195, .height = 195});
    plane.dots(to_points(kind.sets.front()), ink(0), 2.4);
    parts.push_back(plane_part(kind.name, plane));
  }
  for (const auto& kind : kinds) parts.push_back(spectrum_part(kind.name, kind.sets));
  return parts;
}

std::vector<PointSet> sampler_sets(const char* sampler, uint64_t seed, std::initializer_list<const char*> settings) {
  constexpr uint64_t kSets = 100;
  std::vector<PointSet> sets;
  const uint32_t count = sampler == std::string_view("poisson-disk") ? poisson_disk_size() : 64;
  for (uint64_t i = 0; i < kSets; ++i) sets.push_back(sampler_set(sampler, count, seed * kSets + i, settings));
  return sets;
}

// The visible half of the unit sphere, seen from above the pole by 35 degrees.
Part sphere_part(const std::string& caption, const std::vector<std::array<double, 3>>& directions) {
  constexpr double kElevation = 50 * std::numbers::pi / 180;
  PlaneDrawing plane({.x = {-1.08, 1.08}, .y = {-1.08, 1.08}, .width = 250, .height = 250, .frame = false});
  plane.circle({0, 0}, 1, kGrey);
  for (const auto& [x, y, z] : directions) {
    const double depth = std::cos(kElevation) * -y + std::sin(kElevation) * z;
    const double height = std::cos(kElevation) * z + std::sin(kElevation) * y;
    if (depth > 0) plane.dot({x, height}, ink(0), 1.6);
  }
  plane.dot({0, std::cos(kElevation)}, ink(1), 4);
  return plane_part(caption, plane);
}
std::array<double, 3> direction_of(double u, double v) {
  const double z = 1 - 2 * u, r = std::sqrt(std::max(0.0, 1 - z * z)), angle = 2 * std::numbers::pi * v;
  return {r * std::cos(angle), r * std::sin(angle), z};
}

// A box with its area and share of points.
void add_box(PlaneDrawing& plane, const PointSet& set, double x0, double x1, double y0, double y1) {
  plane.rectangle({x0, x1}, {y0, y1}, transparent(ink(1), 0.25));
  plane.dots(to_points(set), ink(0), 2.4);
}

// The digital net with these generating matrices; rows of bits, the most significant digit first.
PointSet digital_net(std::span<const uint32_t> second_matrix) {
  const auto digits = static_cast<uint32_t>(second_matrix.size());
  return point_set(1U << digits, [&](uint32_t i) {
    uint32_t y = 0;
    for (const uint32_t row : second_matrix) y = y << 1 | static_cast<uint32_t>(std::popcount(row & i) & 1);
    return PlanePoint{HaltonSampler::radical_inverse(i, 2), static_cast<double>(y) / (1U << digits)};
  });
}
// The rows for digits of i, the least significant one first. The antidiagonal matrix gives y = i / N.
constexpr std::array<uint32_t, 3> kAntidiagonal3{0b100, 0b010, 0b001};
constexpr std::array<uint32_t, 4> kSwapped4{0b0100, 0b1000, 0b0010, 0b0001};

}  // namespace

Figure figure_7_1() {
  return {.title = "Regular grid, hexagonal grid and Poisson pattern of 64 points",
          .note = "The hexagonal grid has 80 points: 8 per row in an even number of rows.",
          .make = [](const MakeContext& context) -> Result<Parts> {
            return Parts{points_part("Regular grid", regular_grid_points(8)),
                         points_part("Hexagonal grid", hexagonal_grid_points(8)),
                         points_part("Poisson disk", sampler_set("poisson-disk", poisson_disk_size(), context.seed))};
          }};
}

Figure figure_7_2() {
  return {.title = "Boxes of the star discrepancy and of the extreme discrepancy",
          .note =
              "Shows 64 Hammersley points. The captions give the discrepancies, i.e. the largest difference over all "
              "boxes.",
          .make = [](const MakeContext&) -> Result<Parts> {
            const PointSet set = hammersley_points(64);
            PlaneDrawing star, extreme, triangle;
            add_box(star, set, 0, 0.55, 0, 0.7);
            add_box(extreme, set, 0.3, 0.8, 0.2, 0.65);
            triangle.area({{0.2, 0.15}, {0.85, 0.15}, {0.85, 0.8}}, transparent(ink(1), 0.25));
            triangle.dots(to_points(set), ink(0), 2.4);
            return Parts{plane_part("Star: D* = " + metrics::short_number(star_discrepancy(set)), star),
                         plane_part("Extreme: D = " + metrics::short_number(extreme_discrepancy(set)), extreme),
                         plane_part("Axis-parallel triangle", triangle)};
          }};
}

Figure figure_7_3() {
  return {.title = "Star discrepancy of point sets on the unit interval",
          .note = "Five equidistant points, at the ends and in the middles of intervals, after example 7.2.",
          .columns = 1,
          .make = [](const MakeContext&) -> Result<Parts> {
            Parts parts;
            for (const auto& [name, offset] : {std::pair("i / N: D* = 1 / N = 0.2", 1.0),
                                               std::pair("(i - 1/2) / N: D* = 1 / (2 N) = 0.1, the minimum", 0.5)}) {
              PlaneDrawing plane({.x = {-0.02, 1.02}, .y = {-1, 1}, .width = 520, .height = 60, .frame = false});
              plane.line({{0, 0}, {1, 0}}, kBlack);
              for (int i = 0; i < 5; ++i) plane.dot({(i + offset) / 5, 0}, ink(0), 4);
              for (const double end : {0.0, 1.0}) plane.line({{end, -0.5}, {end, 0.5}}, kBlack);
              parts.push_back(plane_part(name, plane));
            }
            return parts;
          }};
}

Figure figure_7_4() {
  return {.title = "Halton sequence in bases 2 and 3", .make = [](const MakeContext&) -> Result<Parts> {
            return first_points("Halton", [](uint32_t n) { return halton_points(n); });
          }};
}

Figure figure_7_6() {
  return {.title = "Hammersley point set",
          .make = [](const MakeContext&) -> Result<Parts> { return first_points("Hammersley", hammersley_points); }};
}

Figure figure_7_7() {
  return {.title = "Hammersley point sets on the unit sphere, 1000 points",
          .note = "The dot marks the pole. As the base grows, points form lines around it.",
          .columns = 3,
          .make = [](const MakeContext& context) -> Result<Parts> {
            constexpr uint32_t kPoints = 1000;
            std::vector<std::array<double, 3>> directions;
            equations::RandomNumbers random(context.seed);
            for (uint32_t i = 0; i < kPoints; ++i) {
              const double u = random.uniform();
              directions.push_back(direction_of(u, random.uniform()));
            }
            Parts parts{sphere_part("Random", directions)};
            for (const uint32_t base : {2U, 3U, 5U, 7U, 11U}) {
              directions.clear();
              for (uint32_t i = 0; i < kPoints; ++i)
                directions.push_back(direction_of(HaltonSampler::radical_inverse(i, base), (i + 0.5) / kPoints));
              parts.push_back(sphere_part("Base " + std::to_string(base), directions));
            }
            return parts;
          }};
}

Figure figure_7_8() {
  return {.title = "Zaremba sequence in bases 2 and 3",
          .make = [](const MakeContext&) -> Result<Parts> { return first_points("Zaremba", zaremba_points); }};
}

Figure figure_7_9() {
  return {.title = "Hammersley and jittered Hammersley points",
          .note = "Each of the 16 rows and columns contains one point of each set.",
          .make = [](const MakeContext& context) -> Result<Parts> {
            equations::RandomNumbers random(context.seed);
            PointSet jittered = hammersley_points(16);
            for (auto& p : jittered)
              for (double& x : p) x += random.uniform() / 16;
            return Parts{points_part("16 Hammersley points", hammersley_points(16), 16, 16),
                         points_part("Jittered", jittered, 16, 16)};
          }};
}

Figure figure_7_10() {
  return {.title = "Pairs of coordinates of the Halton sequence, 256 points",
          .note =
              "The printed indices can be read as bases or as numbers of dimensions, whose bases are the primes 23, "
              "29; 67, 71; 109, 113. Both are shown.",
          .columns = 3,
          .make = [](const MakeContext&) -> Result<Parts> {
            Parts parts;
            for (const auto& [x, y] : {std::pair(9U, 10U), std::pair(19U, 20U), std::pair(29U, 30U),
                                       std::pair(23U, 29U), std::pair(67U, 71U), std::pair(109U, 113U)})
              parts.push_back(pair_part(halton_points(256, x, y), bases(x, y)));
            return parts;
          }};
}

Figure figure_7_11() {
  return {.title = "Halton sequence and its permutation by Faure, dimensions 7 and 8",
          .note = "The bases of dimensions 7 and 8 are 17 and 19.",
          .columns = 2,
          .make = [](const MakeContext&) -> Result<Parts> {
            return Parts{pair_part(halton_points(256, 7, 8), bases(7, 8)),
                         pair_part(faure_scrambled_set(256, 7, 8), bases(7, 8) + ", permuted"),
                         pair_part(halton_points(256, 17, 19), bases(17, 19)),
                         pair_part(faure_scrambled_set(256, 17, 19), bases(17, 19) + ", permuted")};
          }};
}

Figure figure_7_13() {
  return {
      .title = "Elementary intervals of a (0, 4, 2)-net in base 2",
      .note =
          "16 Hammersley points. They lie on the borders of intervals and are drawn moved by 1/32 to the upper right.",
      .make = [](const MakeContext&) -> Result<Parts> { return interval_parts(hammersley_points(16), 1, 16, 16); }};
}

Figure figure_7_15() {
  return {
      .title = "A (0, 3, 2)-net from generating matrices",
      .note =
          "The matrices are the identity and the antidiagonal matrix. The first points are (0, 0), (1/2, 1/8), "
          "(1/4, 1/4), as in table 7.2. Drawn moved by 1/32.",
      .make = [](const MakeContext&) -> Result<Parts> { return interval_parts(digital_net(kAntidiagonal3), 1, 8, 8); }};
}

Figure figure_7_16() {
  return {.title = "Elementary intervals of a (1, 4, 2)-net in base 2",
          .note =
              "Each of the intervals of area 1/8 contains two points. Intervals of area 1/16 can be empty (grey), so "
              "it is not a (0, 4, 2)-net. The matrices are the identity, and the antidiagonal matrix with two rows "
              "exchanged. Drawn moved by 1/32.",
          .columns = 4,
          .make = [](const MakeContext&) -> Result<Parts> {
            const PointSet set = digital_net(kSwapped4);
            Parts parts = interval_parts(set, 1, 8, 8);
            for (Part& part : interval_parts(set, 2, 16, 16)) parts.push_back(std::move(part));
            return parts;
          }};
}

Figure figure_7_17() {
  return {.title = "Randomised nets",
          .note = "64 Hammersley points. Nested scrambling and digital shifts keep t = 0; rotations need not.",
          .make = [](const MakeContext& context) -> Result<Parts> {
            Parts parts;
            const auto add = [&](const std::string& name, const PointSet& set) {
              parts.push_back(points_part(name + ": t = " + std::to_string(*net_quality(set, 2)), set, 8, 8));
            };
            add("Hammersley", hammersley_points(64));
            for (const auto& [name, setting] : {std::pair("Rotation (Cranley-Patterson)", "scrambling=rotation"),
                                                std::pair("Digital shift", "scrambling=digital-shift"),
                                                std::pair("Nested scrambling (Owen)", "scrambling=owen")})
              add(name, sampler_set("hammersley", 64, context.seed, {setting}));
            return parts;
          }};
}

Figure figure_7_18() {
  return {.title = "Regular point sets of 64 points with their spectra",
          .note =
              "The logarithmic grey scale reaches from 0.01 to 100; random points have the power 1. The hexagonal grid "
              "has 80 points.",
          .columns = 4,
          .make = [](const MakeContext&) -> Result<Parts> {
            return patterns_with_spectra({{"Regular grid", {regular_grid_points(8)}},
                                          {"Hexagonal grid", {hexagonal_grid_points(8)}},
                                          {"Halton", {halton_points(64)}},
                                          {"Hammersley", {hammersley_points(64)}}});
          }};
}

Figure figure_7_19() {
  return {.title = "Random point sets of 64 points with their spectra",
          .note = "Spectra are means over 100 sets, in the grey scale of figure 7.18.",
          .columns = 4,
          .make = [](const MakeContext& context) -> Result<Parts> {
            return patterns_with_spectra(
                {{"Jittered", sampler_sets("stratified", context.seed, {"side=8"})},
                 {"N rooks", sampler_sets("latin-hypercube", context.seed, {"samples=64"})},
                 {"Jittered Hammersley", sampler_sets("hammersley", context.seed, {"scrambling=jitter"})},
                 {"Poisson disk", sampler_sets("poisson-disk", context.seed, {})}});
          }};
}

Figure figure_7_12() {
  return {.title = "A (0, 3, 2)-net and a point set that is none",
          .note =
              "The caption of the thesis is lost. The elementary intervals of area 1/8 in base 2. Each of them has one "
              "of the eight "
              "points of Hammersley's set; of Halton's sequence, whose second coordinate has base 3, some are empty.",
          .columns = 4,
          .make = [](const MakeContext&) -> Result<Parts> {
            Parts parts;
            for (const auto& [name, points] :
                 {std::pair{"Hammersley", hammersley_points(8)}, std::pair{"Halton", halton_points(8)}})
              for (const int columns : {8, 4, 2, 1}) parts.push_back(points_part(name, points, columns, 8 / columns));
            return parts;
          }};
}

}  // namespace etendue::figures
