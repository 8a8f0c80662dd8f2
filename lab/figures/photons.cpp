// Figures of photon maps, and of the unshot radiosity of progressive refinement.
#include <algorithm>
#include <cmath>

#include "figures/tools.h"
#include "radiosity/solvers/shooting.h"
#include "render/prepared_document.h"
#include "scene/compiled_scene.h"

namespace etendue::figures {
namespace {

using integrator::StoredPoint;

// The photons of the Cornell box, in metres.
std::vector<StoredPoint> stored_photons(const char* count) {
  render::Document document = document_of("cornell", {"integrator=photonmap"});
  document = *render::with_text(document, "photonmap.photons", count);
  document.width = document.height = 16;
  render::PreparedDocument prepared(document, scene::compile(document.scene, document.camera, nullptr));
  prepared.prepare_sampler(0);
  const auto state = prepared.begin(prepared.context());
  const auto phases = state->phases(0);
  for (size_t phase = 0; phase < phases.size(); ++phase) {
    for (int task = 0; task < phases[phase].tasks; ++task) state->run(0, phase, task, {});
    state->finish(0, phase);
  }
  const auto points = state->points();
  return points ? *points : std::vector<StoredPoint>{};
}

// The bounds of points in a plane.
struct Box {
  double low[2] = {INFINITY, INFINITY}, high[2] = {-INFINITY, -INFINITY};

  void add(const Point& p) {
    low[0] = std::min(low[0], p.x), high[0] = std::max(high[0], p.x);
    low[1] = std::min(low[1], p.y), high[1] = std::max(high[1], p.y);
  }
};
Box box_of(const std::vector<Point>& points) {
  Box box;
  for (const Point& p : points) box.add(p);
  return box;
}
PlaneDrawing plane_of(const Box& box) {
  return PlaneDrawing({.x = {box.low[0], box.high[0]}, .y = {box.low[1], box.high[1]}, .width = 300, .height = 300});
}

std::vector<Point> floor_points(const std::vector<StoredPoint>& photons) {
  float lowest = kInfinity;
  for (const StoredPoint& photon : photons) lowest = std::min(lowest, photon.position.y);
  std::vector<Point> points;
  for (const StoredPoint& photon : photons)
    if (photon.position.y < lowest + 1e-3f) points.push_back({double{photon.position.x}, double{photon.position.z}});
  return points;
}

// Draws the planes of a balanced kd-tree [Lang, sec. 9.5.2]: through the median along the longest side, inside the box of
// the node. `levels` planes below each other.
void draw_kd_tree(std::vector<Point> points, Box cell, int levels, PlaneDrawing& plane) {
  if (levels == 0 || points.size() < 3) return;
  const Box bounds = box_of(points);
  const int axis = bounds.high[0] - bounds.low[0] >= bounds.high[1] - bounds.low[1] ? 0 : 1;
  const auto coordinate = [axis](const Point& p) { return axis == 0 ? p.x : p.y; };
  const auto middle = points.begin() + static_cast<std::ptrdiff_t>(points.size() / 2);
  std::ranges::nth_element(points, middle, {}, coordinate);
  const double at = coordinate(*middle);
  Box left = cell, right = cell;
  left.high[axis] = right.low[axis] = at;
  const double width = 0.7 + 0.6 * levels;
  if (axis == 0)
    plane.line({{at, cell.low[1]}, {at, cell.high[1]}}, ink(1), width);
  else
    plane.line({{cell.low[0], at}, {cell.high[0], at}}, ink(2), width);
  plane.dot(*middle, kBlack, 2 + levels);
  draw_kd_tree({points.begin(), middle}, left, levels - 1, plane);
  draw_kd_tree({middle + 1, points.end()}, right, levels - 1, plane);
}

Part kd_tree_part(const std::vector<Point>& points, int levels) {
  const Box box = box_of(points);
  PlaneDrawing plane = plane_of(box);
  plane.dots(points, ink(0), 2.2);
  draw_kd_tree(points, box, levels, plane);
  return plane_part(std::to_string(levels) + (levels == 1 ? " level" : " levels"), plane);
}

// ---- Progressive refinement

// The faces of a closed cube: each sees the five others, with a factor of a fifth.
radiosity::FormFactors cube_factors() {
  std::vector<radiosity::FormFactorRow> rows(6);
  for (uint32_t i = 0; i < 6; ++i)
    for (uint32_t j = 0; j < 6; ++j)
      if (i != j) rows[i].push_back({j, 0.2f});
  return {std::move(rows), std::vector<double>(6, 1.0)};
}

Part shots_part(const radiosity::Shooting& shooting) {
  FunctionCurve total{.name = "shot and unshot", .style = CurveStyle::bars, .points = {}};
  FunctionCurve shot{.name = "shot", .style = CurveStyle::bars, .points = {}};
  for (size_t i = 0; i < 6; ++i) {
    const auto x = static_cast<double>(i);
    total.points.push_back({x, shooting.radiosity()[i] + shooting.unshot()[i]});
    shot.points.push_back({x, shooting.radiosity()[i]});
  }
  total.points.push_back({6, 0});
  shot.points.push_back({6, 0});
  const std::string shots = std::to_string(shooting.shots()) + (shooting.shots() == 1 ? " shot" : " shots");
  return chart_part({.title = shots, .x_label = "patch", .y_label = "radiosity", .curves = {total, shot}}, 240, 200);
}

}  // namespace

Figure figure_9_34() {
  return {.title = "The nearest photons of a point",
          .note =
              "The caption of the thesis is lost. Photons on the floor of the Cornell box; the circle contains the 50 "
              "nearest "
              "photons of its centre.",
          .make = [](const MakeContext&) -> Result<Parts> {
            const auto points = floor_points(stored_photons("4000"));
            const Box box = box_of(points);
            const Point center{0.5 * (box.low[0] + box.high[0]), 0.35 * box.low[1] + 0.65 * box.high[1]};
            std::vector<double> distances;
            for (const Point& p : points) distances.push_back(std::hypot(p.x - center.x, p.y - center.y));
            std::ranges::sort(distances);
            constexpr size_t kNearest = 50;
            if (distances.size() <= kNearest) return input_error("too few photons on the floor");
            const double radius = 0.5 * (distances[kNearest - 1] + distances[kNearest]);
            PlaneDrawing plane = plane_of(box);
            for (const Point& p : points)
              plane.dot(p, std::hypot(p.x - center.x, p.y - center.y) < radius ? ink(1) : ink(0), 2);
            plane.circle(center, radius, kBlack, 1.5);
            plane.dot(center, kBlack, 4);
            return Parts{plane_part("50 of " + std::to_string(points.size()) + " photons", plane)};
          }};
}

Figure figure_9_35() {
  return {.title = "Building a kd-tree of photons in two dimensions",
          .note =
              "The caption of the thesis is lost. Photons on the floor of the Cornell box. Each plane goes through the "
              "median "
              "along the longest side of the bounding box.",
          .columns = 2,
          .make = [](const MakeContext&) -> Result<Parts> {
            const auto points = floor_points(stored_photons("700"));
            Parts parts;
            for (const int levels : {1, 2, 3, 5}) parts.push_back(kd_tree_part(points, levels));
            return parts;
          }};
}

Figure figure_9_36() {
  return {.title = "The photons of a Cornell box in a kd-tree",
          .note =
              "The caption of the thesis is lost. The colours are the eight subtrees below the third level, seen from "
              "the front.",
          .make = [](const MakeContext&) -> Result<Parts> {
            auto photons = stored_photons("6000");
            std::vector<Point> all;
            for (const StoredPoint& p : photons) all.push_back({double{p.position.x}, double{p.position.y}});
            PlaneDrawing plane = plane_of(box_of(all));
            const std::function<void(std::span<StoredPoint>, int, size_t)> divide = [&](std::span<StoredPoint> part,
                                                                                        int level, size_t color) {
              if (level == 3) {
                for (const StoredPoint& p : part)
                  plane.dot({double{p.position.x}, double{p.position.y}}, ink(color), 1.5);
                return;
              }
              Vec3 low(kInfinity), high(-kInfinity);
              for (const StoredPoint& p : part) low = glm::min(low, p.position), high = glm::max(high, p.position);
              const Vec3 size = high - low;
              const int axis = size.x >= size.y && size.x >= size.z ? 0 : size.y >= size.z ? 1 : 2;
              const size_t middle = part.size() / 2;
              std::ranges::nth_element(part, part.begin() + static_cast<std::ptrdiff_t>(middle), {},
                                       [axis](const StoredPoint& p) { return p.position[axis]; });
              divide(part.first(middle), level + 1, 2 * color);
              divide(part.subspan(middle), level + 1, 2 * color + 1);
            };
            divide(photons, 0, 0);
            return Parts{plane_part(std::to_string(photons.size()) + " photons", plane)};
          }};
}

Figure figure_10_13() {
  return {.title = "Shot and unshot radiosity",
          .note =
              "The caption of the thesis is lost. Southwell relaxation in a cube with reflectance 0.6 whose first face "
              "emits: what "
              "each face has shot, and what it has received and not yet shot.",
          .columns = 3,
          .make = [](const MakeContext&) -> Result<Parts> {
            const auto factors = cube_factors();
            const radiosity::RadiositySystem system{
                .factors = &factors, .reflectance = std::vector<double>(6, 0.6), .source = {1, 0, 0, 0, 0, 0}};
            radiosity::Shooting shooting(system);
            Parts parts{shots_part(shooting)};
            for (const size_t shots : {1, 2, 4, 8, 40}) {
              while (shooting.shots() < shots && !shooting.is_done()) shooting.shoot();
              parts.push_back(shots_part(shooting));
            }
            return parts;
          }};
}

}  // namespace etendue::figures
