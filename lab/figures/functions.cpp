// Figures of chapters 2 and 3: functions, integrals and spectra.
#include <cmath>
#include <memory>
#include <numbers>

#include "base/spherical_harmonics.h"
#include "figures/tools.h"
#include "geometry/mesh.h"
#include "metrics/log_axis.h"
#include "scene/builtin/shapes.h"
#include "spectrum/blackbody.h"
#include "spectrum/illuminant_fl2.h"
#include "spectrum/observer.h"

namespace etendue::figures {
namespace {

// ---- Spherical harmonics

constexpr int kHighestDegree = 6;

// The surface at the distance |Y| from the origin, where Y has this sign; its top points upwards (+y).
std::shared_ptr<const Mesh> harmonic_mesh(int l, int m, bool positive) {
  constexpr int kRings = 96, kSectors = 192;
  Mesh mesh;
  const auto vertex = [&](int ring, int sector) {
    const float theta = kPi * static_cast<float>(ring) / kRings, phi = 2 * kPi * static_cast<float>(sector) / kSectors;
    const Vec3 direction(std::sin(theta) * std::cos(phi), std::sin(theta) * std::sin(phi), std::cos(theta));
    const double y = real_harmonic(l, m, HarmonicDirection(direction));
    const auto radius = static_cast<float>(positive ? std::max(y, 0.0) : std::max(-y, 0.0));
    return radius * Vec3(direction.x, direction.z, direction.y);
  };
  for (int ring = 0; ring < kRings; ++ring)
    for (int sector = 0; sector < kSectors; ++sector) {
      const auto first = static_cast<uint32_t>(mesh.positions.size());
      for (const auto& [dr, ds] : {std::pair(0, 0), std::pair(1, 0), std::pair(1, 1), std::pair(0, 1)})
        mesh.positions.push_back(vertex(ring + dr, sector + ds));
      mesh.triangles.push_back({first, first + 1, first + 2});
      mesh.triangles.push_back({first, first + 2, first + 3});
    }
  mesh.positions.reserve(mesh.positions.size() + 1);
  return std::make_shared<const Mesh>(std::move(mesh));
}

render::Document harmonics_document() {
  scene::Scene scene;
  scene.environment.tint = Rgb(0.9f);
  for (int l = 0; l <= kHighestDegree; ++l)
    for (int m = 0; m <= l; ++m)
      for (const bool positive : {true, false}) {
        Mat4 place(1);
        place[3] = Vec4(1.3f * static_cast<float>(m), -1.35f * static_cast<float>(l), 0, 1);
        scene::add(scene, harmonic_mesh(l, m, positive),
                   scene::diffuse(positive ? Rgb(0.75f, 0.35f, 0.1f) : Rgb(0.1f, 0.3f, 0.7f)), place);
      }
  Light sun = make_light("directional", {{"intensity", 1.5}});
  scene::Transform transform;
  transform.matrix = look_at({2, 4, 6}, {0, 0, 0}, {0, 1, 0}, 1).to_world;
  scene::add(scene, sun, transform);
  render::Document document;
  document.scene = std::make_shared<const scene::Scene>(std::move(scene));
  document.camera = look_at({3.9f, -4.05f, 20}, {3.9f, -4.05f, 0}, {0, 1, 0}, 0.5f);
  document.camera.projection = Projection::orthographic;
  document.camera.ymag = 4.9f;
  return document;
}

// ---- Sums

// A function with values in [0, 1] that rises and falls.
double hill(double x) { return 0.15 + 0.75 * std::sin(std::numbers::pi * x) * (0.6 + 0.4 * x); }

// The union of intervals of the Cantor set after `steps` steps.
std::vector<metrics::Interval> cantor_intervals(int steps) {
  std::vector<metrics::Interval> intervals{{0, 1}};
  for (int step = 0; step < steps; ++step) {
    std::vector<metrics::Interval> next;
    for (const auto& [low, high] : intervals) {
      const double third = (high - low) / 3;
      next.push_back({low, low + third});
      next.push_back({high - third, high});
    }
    intervals = std::move(next);
  }
  return intervals;
}

FunctionCurve power_curve(int n) {
  return {.name = n == 0   ? "1"
                  : n == 1 ? "x"
                           : "x^" + std::to_string(n),
          .points = sampled([n](double x) { return std::pow(x, n); }, 0, 1)};
}

std::vector<Point> spectrum_points(const std::function<double(double)>& at) {
  std::vector<Point> points;
  double most = 0;
  for (size_t i = 0; i < kWavelengths; ++i) {
    points.push_back({table_wavelength(i), at(table_wavelength(i))});
    most = std::max(most, points.back().y);
  }
  for (Point& p : points) p.y /= most;
  return points;
}

// Corners of a square that is divided into triangles.
constexpr int kMeshCells = 4;

}  // namespace

Figure figure_2_1() {
  return {.title = "Linearly independent functions of C[0, 1]", .make = [](const MakeContext&) -> Result<Parts> {
            return Parts{curves_part("Monomials", "x", "",
                                     {power_curve(0), power_curve(1), power_curve(2), power_curve(3)}, 480, 320)};
          }};
}

Figure figure_2_2() {
  return {
      .title = "Smooth and spiky spectral power distributions",
      .note = "Left, a black body of 2856 K. Right, the CIE illuminant FL2 of a fluorescent tube, in steps of 5 nm.",
      .make = [](const MakeContext&) -> Result<Parts> {
        const auto fluorescent = [](double wavelength) {
          return kIlluminantFl2[static_cast<size_t>((wavelength - kFirstWavelength) / kWavelengthStep)];
        };
        return Parts{curves_part("Incandescent light", "wavelength (nm)", "relative power",
                                 {{.name = "black body, 2856 K",
                                   .points = spectrum_points([](double w) { return blackbody_at(w, 2856); })}}),
                     curves_part("Fluorescent light", "wavelength (nm)", "relative power",
                                 {{.name = "FL2", .style = CurveStyle::bars, .points = spectrum_points(fluorescent)}})};
      }};
}

Figure figure_2_4() {
  return {.title = "Pointwise and uniform convergence",
          .note =
              "x^n converges to 0 at each x < 1, but not uniformly: for every n some of its values leave the band. "
              "sin(n x) / n stays in a band around 0 from some n on.",
          .make = [](const MakeContext&) -> Result<Parts> {
            std::vector<FunctionCurve> powers, waves;
            for (const int n : {1, 2, 4, 8, 16}) powers.push_back(power_curve(n));
            for (const int n : {1, 2, 4, 8, 16})
              waves.push_back({.name = "sin(" + std::to_string(n) + " x) / " + std::to_string(n),
                               .points = sampled([n](double x) { return std::sin(n * x) / n; }, 0, 6.3, 300)});
            const auto band = [](double end) {
              FunctionCurve limit{.name = "limit 0 and band of 0.2", .style = CurveStyle::dashed, .points = {}};
              for (const double x : {0.0, end}) {
                limit.points.push_back({x, 0});
                limit.band.push_back({-0.2, 0.2});
              }
              return limit;
            };
            powers.push_back(band(1));
            waves.push_back(band(6.3));
            return Parts{curves_part("Pointwise: x^n", "x", "", std::move(powers)),
                         curves_part("Uniform: sin(n x) / n", "x", "", std::move(waves))};
          }};
}

Figure figure_2_11() {
  return {.title = "Orthogonal projection onto the even functions",
          .note = "The projection of f is (f(x) + f(-x)) / 2; the rest is odd and orthogonal to it in L\u00b2[-1, 1].",
          .make = [](const MakeContext&) -> Result<Parts> {
            const auto f = [](double x) { return 1 + x + 2 * x * x; };
            return Parts{curves_part("A quadratic polynomial and its even part", "x", "",
                                     {{.name = "f = 1 + x + 2 x\u00b2", .points = sampled(f, -1, 1)},
                                      {.name = "even part 1 + 2 x\u00b2",
                                       .points = sampled([&](double x) { return 0.5 * (f(x) + f(-x)); }, -1, 1)},
                                      {.name = "odd part x",
                                       .style = CurveStyle::dashed,
                                       .points = sampled([&](double x) { return 0.5 * (f(x) - f(-x)); }, -1, 1)}},
                                     520, 320)};
          }};
}

Figure figure_2_14() {
  return {.title = "The Cantor set",
          .note = "The first six steps. What remains has the length (2/3)^n.",
          .make = [](const MakeContext&) -> Result<Parts> {
            PlaneDrawing plane({.x = {0, 1}, .y = {-6.5, 0.6}, .width = 620, .height = 240, .frame = false});
            for (int step = 0; step <= 6; ++step)
              for (const auto& interval : cantor_intervals(step))
                plane.rectangle(interval, {-step - 0.25, -step + 0.25}, ink(0));
            return Parts{plane_part("", plane)};
          }};
}

Figure figure_2_29() {
  return {.title = "Riemann and Lebesgue sums",
          .note =
              "Left, the domain is divided into ten intervals, and boxes have the supremum of the function. Right, the "
              "values are divided into ten levels; each box of the height of a level lies over the set where the "
              "function exceeds it.",
          .make = [](const MakeContext&) -> Result<Parts> {
            constexpr int kPieces = 10;
            const PlaneDrawingSettings settings{.x = {0, 1}, .y = {0, 1}, .width = 380, .height = 260};
            PlaneDrawing riemann(settings), lebesgue(settings);
            for (int i = 0; i < kPieces; ++i) {
              const double a = static_cast<double>(i) / kPieces, b = a + 1.0 / kPieces;
              double most = 0;
              for (const Point& p : sampled(hill, a, b, 50)) most = std::max(most, p.y);
              riemann.rectangle({a, b}, {0, most}, transparent(ink(1), i % 2 == 0 ? 0.2 : 0.35));
              // The set where the function exceeds the level is an interval.
              double left = 2, right = -1;
              for (const Point& p : sampled(hill, 0, 1, 2001))
                if (p.y >= a) {
                  left = std::min(left, p.x);
                  right = std::max(right, p.x);
                }
              if (right > left) lebesgue.rectangle({left, right}, {a, b}, transparent(ink(2), i % 2 == 0 ? 0.2 : 0.35));
            }
            for (PlaneDrawing* plane : {&riemann, &lebesgue}) plane->line(sampled(hill, 0, 1), ink(0), 2);
            return Parts{plane_part("Riemann: intervals of the domain", riemann),
                         plane_part("Lebesgue: intervals of the values", lebesgue)};
          }};
}

Figure figure_2_36() {
  return {
      .title = "Spherical harmonics for l = 0, ..., 6 and m = 0, ..., l",
      .note =
          "The distance from the centre is |Y|; values are positive where the surface is orange and negative where "
          "it is blue. Rows are l, columns are m.",
      .make = [](const MakeContext& context) -> Result<Parts> {
        MakeContext wide = context;
        wide.width = 2 * context.width;
        return Parts{rendering_part("", harmonics_document(), wide, {.samples = 16, .curve = image::ToneCurve::none})};
      }};
}

Figure figure_2_38() {
  return {.title = "Finite element meshes of a square", .make = [](const MakeContext&) -> Result<Parts> {
            PlaneDrawing squares, diagonal, crossed;
            for (PlaneDrawing* plane : {&squares, &diagonal, &crossed}) plane->grid(kMeshCells, kMeshCells, ink(0));
            for (int i = 0; i < kMeshCells; ++i)
              for (int j = 0; j < kMeshCells; ++j) {
                const double x = static_cast<double>(i) / kMeshCells, y = static_cast<double>(j) / kMeshCells,
                             h = 1.0 / kMeshCells;
                diagonal.line({{x, y}, {x + h, y + h}}, ink(0));
                crossed.line({{x, y}, {x + h, y + h}}, ink(0));
                crossed.line({{x, y + h}, {x + h, y}}, ink(0));
              }
            return Parts{plane_part("Squares", squares), plane_part("Two triangles per square", diagonal),
                         plane_part("Four triangles per square", crossed)};
          }};
}

Figure figure_2_39() {
  return {.title = "Nodal points of finite elements", .make = [](const MakeContext&) -> Result<Parts> {
            PlaneDrawing vertices, middles;
            for (PlaneDrawing* plane : {&vertices, &middles}) plane->grid(kMeshCells, kMeshCells, kGrey);
            for (int i = 0; i <= kMeshCells; ++i)
              for (int j = 0; j <= kMeshCells; ++j) {
                vertices.dot({static_cast<double>(i) / kMeshCells, static_cast<double>(j) / kMeshCells}, ink(1), 4);
                if (i < kMeshCells && j < kMeshCells)
                  middles.dot({(i + 0.5) / kMeshCells, (j + 0.5) / kMeshCells}, ink(1), 4);
              }
            return Parts{plane_part("At the vertices: linear elements", vertices),
                         plane_part("In the middle of elements: constant elements", middles)};
          }};
}

Figure figure_2_40() {
  return {
      .title = "Local linear basis functions on [0, 4]", .make = [](const MakeContext&) -> Result<Parts> {
        std::vector<FunctionCurve> hats;
        for (int i = 0; i < 5; ++i)
          hats.push_back({.name = "N_" + std::to_string(i + 1),
                          .points = sampled([i](double x) { return std::max(0.0, 1 - std::abs(x - i)); }, 0, 4, 401)});
        return Parts{curves_part("Basis functions of the nodes 0, 1, 2, 3, 4", "x", "", std::move(hats), 560, 280)};
      }};
}

Figure figure_3_16() {
  return {.title = "The inverse square law", .make = [](const MakeContext&) -> Result<Parts> {
            const auto irradiance = [](double d) { return 1 / (d * d); };
            return Parts{curves_part("Irradiance at the distance d from a point light of 1 W/sr", "d (m)", "W/m\u00b2",
                                     {{.name = "1 / d\u00b2", .points = sampled(irradiance, 0.5, 4)}}, 520, 300)};
          }};
}

Figure figure_3_17() {
  return {
      .title = "Luminous efficiency V of photopic vision",
      .note =
          "The CIE 1931 observer (y), whose values are those of V(lambda) of 1924; the book shows the function with "
          "the corrections of 1988 below 460 nm.",
      .make = [](const MakeContext&) -> Result<Parts> {
        return Parts{curves_part(
            "V over the wavelength", "wavelength (nm)", "V",
            {{.name = "V", .points = sampled([](double w) { return observer_at(w).y; }, 380, 780, 401)}}, 560, 320)};
      }};
}

Figure figure_2_3() {
  return {
      .title = "Sequences of functions",
      .note =
          "The caption of the thesis is lost. The first sequence converges pointwise to a function that is not "
          "continuous, "
          "the second one uniformly to zero.",
      .make = [](const MakeContext&) -> Result<Parts> {
        std::vector<FunctionCurve> powers, quotients;
        for (const int n : {1, 2, 4, 8, 16, 64}) {
          const std::string name = "n = " + std::to_string(n);
          powers.push_back({.name = name, .points = sampled([n](double x) { return std::pow(x, n); }, 0, 1)});
          quotients.push_back({.name = name, .points = sampled([n](double x) { return std::pow(x, n) / n; }, 0, 1)});
        }
        return Parts{curves_part("x to the power of n", "x", "", std::move(powers)),
                     curves_part("x to the power of n, divided by n", "x", "", std::move(quotients))};
      }};
}

}  // namespace etendue::figures
