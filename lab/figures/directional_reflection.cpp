// Figures of the directional distributions of BRDFs, and of the microfacets behind them.
#include <cmath>
#include <numbers>

#include "bsdf/lobes/cosine_power.h"
#include "bsdf/lobes/ward.h"
#include "equations/random_numbers.h"
#include "figures/tools.h"

namespace etendue::figures {
namespace {

constexpr double kIncidence = 45 * std::numbers::pi / 180;

Vec3 in_plane(double angle) { return {static_cast<float>(std::sin(angle)), 0, static_cast<float>(std::cos(angle))}; }

CosinePower<Rgb> glossy_lobe(float exponent, float reflectance) {
  CosinePower<Rgb> lobe;
  lobe.scale = Rgb(reflectance * (exponent + 2) / (2 * kPi));
  lobe.exponent = exponent;
  lobe.albedo = reflectance;
  return lobe;
}

// f(angle from the normal) in the plane of incidence, with the incident light and, in bold, an ideal reflection.
Part reflection_part(const std::string& caption, const std::function<double(double)>& f, double specular,
                     double scale) {
  PlaneDrawing plane({.x = {-1.1, 1.1}, .y = {-0.08, 1.1}, .width = 260, .height = 140, .frame = false});
  plane.line({{-1.1, 0}, {1.1, 0}}, kGrey, 2);
  const auto at = [](double angle, double r) { return Point{r * std::sin(angle), r * std::cos(angle)}; };
  plane.line({at(-kIncidence, 1.05), {0, 0}}, kBlack, 1.5);
  std::vector<Point> curve{{0, 0}};
  for (int i = -89; i <= 89; ++i) {
    const double angle = i * std::numbers::pi / 180;
    curve.push_back(at(angle, scale * f(angle)));
  }
  plane.area(curve, transparent(ink(0), 0.25));
  plane.line(curve, ink(0), 1.5);
  if (specular > 0) plane.line({{0, 0}, at(kIncidence, specular)}, ink(1), 3);
  return plane_part(caption, plane);
}

double in_plane_value(const CosinePower<Rgb>& lobe, double angle) {
  return double{lobe.f(in_plane(-kIncidence), in_plane(angle)).g};
}

// Sampled directions of a lobe, seen from the side.
Part sampled_directions_part(const std::string& caption, float exponent) {
  PlaneDrawing plane({.x = {-1.1, 1.1}, .y = {-0.08, 1.1}, .width = 300, .height = 162, .frame = false});
  plane.line({{-1.1, 0}, {1.1, 0}}, kGrey, 2);
  plane.line({{-1.05 * std::sin(kIncidence), 1.05 * std::cos(kIncidence)}, {0, 0}}, kBlack, 2);
  const auto lobe = glossy_lobe(exponent, 1);
  equations::RandomNumbers random(3);
  constexpr int kDirections = 150;
  for (int i = 0; i < kDirections; ++i) {
    const auto u = static_cast<float>(random.uniform()), v = static_cast<float>(random.uniform());
    Vec3 direction;
    if (!lobe.sample_direction(in_plane(-kIncidence), {0, {u, v}}, direction) || direction.z <= 0) continue;
    plane.line({{0, 0}, {double{direction.x}, double{direction.z}}}, transparent(ink(0), 0.45), 1);
  }
  return plane_part(caption, plane);
}

// The BRDF of brushed metal over all directions of the upper hemisphere, in orthogonal projection, relative to its
// largest value; light arrives from the left.
Part anisotropic_part(double turn, int size) {
  WardReflection<Rgb> lobe;
  lobe.alpha_x = 0.08f;
  lobe.alpha_y = 0.35f;
  lobe.along = {static_cast<float>(std::cos(turn)), static_cast<float>(std::sin(turn))};
  const Vec3 incident = in_plane(-kIncidence);
  const auto value = [&](double u, double v) {
    const double x = 2 * u - 1, y = 2 * v - 1, squared = x * x + y * y;
    if (squared >= 0.999) return -1.0;
    const Vec3 out(static_cast<float>(x), static_cast<float>(y), static_cast<float>(std::sqrt(1 - squared)));
    return double{lobe.f(incident, out).g} * double{out.z};
  };
  double most = 0;
  for (int i = 0; i < size; ++i)
    for (int j = 0; j < size; ++j) most = std::max(most, value((i + 0.5) / size, (j + 0.5) / size));
  const int degrees = static_cast<int>(std::lround(turn * 180 / std::numbers::pi));
  return {.caption = "turned by " + std::to_string(degrees) + "\u00b0",
          .content = grey_picture(size, [&](double u, double v) {
            const double f = value(u, v);
            return f < 0 ? 1.0 : std::sqrt(f / most);
          })};
}

// The cross section of a surface whose slopes have a normal distribution with this standard deviation.
Part microfacets_part(const std::string& caption, double deviation) {
  constexpr int kFacets = 60;
  equations::RandomNumbers random(11);
  std::vector<Point> profile{{0, 0}};
  double height = 0, lowest = 0;
  for (int i = 1; i <= kFacets; ++i) {
    const double radius = std::sqrt(-2 * std::log(1 - random.uniform()));
    double slope = deviation * radius * std::cos(2 * std::numbers::pi * random.uniform());
    // Grooves: the profile returns to its mean level.
    slope -= height * 0.8;
    height += slope;
    lowest = std::min(lowest, height);
    profile.push_back({static_cast<double>(i), height});
  }
  PlaneDrawing plane({.x = {0, kFacets}, .y = {-5, 5}, .width = 460, .height = 110, .frame = false});
  std::vector<Point> solid = profile;
  solid.push_back({kFacets, -5});
  solid.push_back({0, -5});
  plane.area(solid, kLightGrey);
  plane.line(profile, kBlack, 1.5);
  for (size_t i = 1; i < profile.size(); i += 4) {
    const Point a = profile[i - 1], b = profile[i];
    const double length = std::hypot(b.x - a.x, b.y - a.y), nx = -(b.y - a.y) / length, ny = (b.x - a.x) / length;
    const Point middle = metrics::interpolate(a, b, 0.5);
    plane.line({middle, {middle.x + 2.2 * nx, middle.y + 2.2 * ny}}, ink(0), 1.2);
  }
  return plane_part(caption, plane);
}

}  // namespace

Figure figure_2_66() {
  return {.title = "Sampled directions at glossy surfaces",
          .note = "150 directions of a Phong lobe: the glossier the surface, the closer to the mirrored direction.",
          .make = [](const MakeContext&) -> Result<Parts> {
            return Parts{sampled_directions_part("exponent 8", 8), sampled_directions_part("exponent 200", 200)};
          }};
}

Figure figure_4_33() {
  return {.title = "An anisotropic BRDF",
          .note =
              "Ward's BRDF with roughness 0.08 and 0.35 over all directions of reflection, for light from the left at "
              "45\u00b0. The "
              "surface is turned about its normal.",
          .columns = 4,
          .make = [](const MakeContext& context) -> Result<Parts> {
            Parts parts;
            for (const double degrees : {0.0, 30.0, 60.0, 90.0})
              parts.push_back(anisotropic_part(degrees * std::numbers::pi / 180, context.width / 2));
            return parts;
          }};
}

Figure figure_4_35() {
  return {.title = "Glossy reflection",
          .note = "The caption of the thesis is lost. A Phong lobe in the plane of incidence.",
          .make = [](const MakeContext&) -> Result<Parts> {
            const auto lobe = glossy_lobe(30, 0.5f);
            return Parts{reflection_part(
                "glossy", [&](double a) { return in_plane_value(lobe, a); }, 0, 0.4)};
          }};
}
Figure figure_4_36() {
  return {
      .title = "The components of a BRDF",
      .note =
          "The caption of the thesis is lost. Diffuse, specular and glossy reflection and their sum in the plane of "
          "incidence. The line of ideal reflection has no length in 1/sr.",
      .columns = 2,
      .make = [](const MakeContext&) -> Result<Parts> {
        const auto lobe = glossy_lobe(30, 0.3f);
        const double diffuse = double{Lambert<Rgb>{Rgb(0.9f)}.eval({0, 0, 1}, {0, 0, 1}, TransportMode::radiance).g};
        const auto glossy = [lobe](double a) { return in_plane_value(lobe, a); };
        const auto nothing = [](double) { return 0.0; };
        constexpr double kScale = 0.5;
        return Parts{reflection_part(
                         "ideal diffuse", [&](double) { return diffuse; }, 0, kScale),
                     reflection_part("ideal specular", nothing, 1, kScale),
                     reflection_part("glossy", glossy, 0, kScale),
                     reflection_part(
                         "sum", [&](double a) { return diffuse + glossy(a); }, 1, kScale)};
      }};
}

Figure figure_4_45() {
  return {
      .title = "Microfacets",
      .note = "Cross sections of surfaces whose slopes have a normal distribution, with the normals of some facets.",
      .columns = 1,
      .make = [](const MakeContext&) -> Result<Parts> {
        return Parts{microfacets_part("rough", 1.2), microfacets_part("smoother", 0.35)};
      }};
}

}  // namespace etendue::figures
