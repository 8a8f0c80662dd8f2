// Figures of chapter 4: surfaces, phase functions and lights.
#include <cmath>
#include <memory>
#include <numbers>

#include "bsdf/fresnel/fresnel.h"
#include "figures/tools.h"
#include "light/environments/builtin_environment.h"
#include "medium/phase_function.h"
#include "metrics/log_axis.h"
#include "scene/builtin/lathe.h"
#include "scene/builtin/scene_builder.h"

namespace etendue::figures {
namespace {

using scene::Scene;
using Settings = std::initializer_list<std::pair<std::string_view, Value>>;

Material of_model(const char* model, const Rgb& base, Settings settings = {}) {
  Material material;
  material.base_color = base;
  auto made = make_bsdf_model(model);
  for (const auto& [name, value] : settings) made = made->with(name, value);
  material.model.model = std::move(made);
  return material;
}
Material phong_surface(const Rgb& base, double exponent, const char* model = "phong") {
  return of_model(
      model, base,
      {{"diffuse", 0.6}, {"specular.r", 0.5}, {"specular.g", 0.5}, {"specular.b", 0.5}, {"exponent", exponent}});
}

void add_ball(Scene& scene, const Vec3& center, float radius, const Material& material) {
  scene::add(scene, scene::ball(radius, 64), material, scene::translated(center).to_matrix());
}
void add_floor(Scene& scene, const Rgb& albedo, float half_size = 20) {
  scene::add(scene, scene::quad(half_size), scene::diffuse(albedo));
}
void add_light(Scene& scene, const char* type, Settings settings, const Vec3& position,
               const Vec3& target = {0, 0, 0}) {
  scene::Transform transform;
  transform.matrix = look_at(position, target, {0.01f, 0, -1}, 1).to_world;
  scene::add(scene, make_light(type, settings), transform);
}
void add_builtin_environment(Scene& scene, std::string_view name) {
  for (const auto& environment : builtin_environments())
    if (environment.name == name) scene.environment = make_environment(environment);
}

render::Document view_of(Scene scene, const Vec3& eye, const Vec3& target, float yfov) {
  render::Document document;
  document.scene = std::make_shared<const Scene>(std::move(scene));
  document.camera = look_at(eye, target, {0, 1, 0}, yfov);
  return document;
}

// One ball in front of the camera.
render::Document ball_view(const Material& material, const std::function<void(Scene&)>& light) {
  Scene scene;
  add_ball(scene, {0, 0, 0}, 1, material);
  light(scene);
  return view_of(std::move(scene), {0, 0, 5}, {0, 0, 0}, 0.46f);
}

void light_from_upper_left(Scene& scene) { add_light(scene, "directional", {{"intensity", 3.0}}, {-3, 4, 5}); }

// Two balls, a cylinder, a box and a plane.
Scene still_life() {
  Scene scene;
  add_floor(scene, {0.55f, 0.5f, 0.4f});
  add_ball(scene, {-1.3f, 0.8f, 0.2f}, 0.8f, scene::diffuse({0.75f, 0.3f, 0.2f}));
  add_ball(scene, {0.35f, 0.5f, 1.3f}, 0.5f, scene::diffuse({0.25f, 0.5f, 0.7f}));
  const scene::OutlinePoint outline[] = {{{0, 0}, {0, -1}},       {{0.45f, 0}, {0, -1}},   {{0.45f, 0}, {1, 0}},
                                         {{0.45f, 1.7f}, {1, 0}}, {{0.45f, 1.7f}, {0, 1}}, {{0, 1.7f}, {0, 1}}};
  scene::add(scene, scene::lathe(outline, 64), scene::diffuse({0.4f, 0.65f, 0.3f}),
             scene::translated({0.6f, 0, -1}).to_matrix());
  scene::add(scene, scene::box({0.5f, 0.4f, 0.5f}), scene::diffuse({0.7f, 0.6f, 0.25f}),
             scene::rotated_y({1.9f, 0.4f, 0.6f}, 0.5f).to_matrix());
  return scene;
}
render::Document still_life_view(Scene scene) {
  return view_of(std::move(scene), {0.5f, 3, 7}, {0.25f, 0.6f, 0}, 0.5f);
}

Part still_life_part(const char* caption, const char* light, Settings settings, const MakeContext& context) {
  Scene scene = still_life();
  add_light(scene, light, settings, {-2.5f, 4, 2.5f});
  render::Document document = still_life_view(std::move(scene));
  set(document, {"integrator=appel"});
  return rendering_part(caption, document, context,
                        {.samples = 256, .curve = image::ToneCurve::none, .aspect = 4.0 / 3});
}

// ---- Plots

// f(angle) around a direction that points to the right, relative to its largest value; angles in radians.
Part polar_part(const std::string& caption, const std::function<double(double)>& f) {
  std::vector<Point> curve;
  double most = 0;
  for (int i = 0; i <= 720; ++i) most = std::max(most, f(2 * std::numbers::pi * i / 720));
  for (int i = 0; i <= 720; ++i) {
    const double a = 2 * std::numbers::pi * i / 720, r = f(a) / most;
    curve.push_back({r * std::cos(a), r * std::sin(a)});
  }
  PlaneDrawing plane({.x = {-1.1, 1.1}, .y = {-1.1, 1.1}, .width = 190, .height = 190, .frame = false});
  for (const double r : {0.5, 1.0}) plane.circle({0, 0}, r, kLightGrey);
  plane.line({{-1.1, 0}, {1.1, 0}}, kLightGrey);
  plane.area(curve, transparent(ink(0), 0.2));
  plane.line(curve, ink(0), 2);
  plane.line({{-1.1, 0}, {-0.85, 0}}, kBlack, 2);  // the incident light
  plane.dot({0, 0}, kBlack, 3);
  return plane_part(caption, plane);
}

Part phase_part(const std::string& caption, const char* name, std::vector<Setting> settings = {}) {
  const auto phase = *make_phase_function(name, settings);
  return polar_part(caption, [&](double angle) { return phase->eval(std::cos(angle)); });
}

Parts parts_over_g(const char* phase_function, const char* parameter) {
  Parts parts;
  for (const double sign : {-1.0, 1.0})
    for (const double g : {0.2, 0.4, 0.6, 0.8})
      parts.push_back(phase_part(std::string(parameter) + " = " + metrics::short_number(sign * g), phase_function,
                                 {{parameter, Value(sign * g)}}));
  return parts;
}

FunctionCurve fresnel_curve(const char* name, float eta, bool transmitted, bool schlick) {
  const auto reflectance = [=](double degrees) {
    const float cosine = std::max(1e-6f, std::cos(static_cast<float>(degrees) * kPi / 180));
    float refracted = 0;
    const float f0 = f0_from_ior(eta);
    const auto r = static_cast<double>(schlick ? f0 + (1 - f0) * schlick_weight(cosine)
                                               : fresnel_dielectric(cosine, eta, refracted));
    return transmitted ? 1 - r : r;
  };
  return {.name = name,
          .style = schlick ? CurveStyle::dashed : CurveStyle::line,
          .points = sampled(reflectance, 0, 90, 181)};
}

// A power of the cosine to the mirror direction, in the plane of incidence; the part below the surface is grey.
Part lobe_part(const std::string& caption, double exponent, double degrees) {
  const double mirror = (90 - degrees) * std::numbers::pi / 180;  // from the surface
  std::vector<Point> above, below;
  for (int i = 0; i <= 360; ++i) {
    const double a = mirror - std::numbers::pi / 2 + std::numbers::pi * i / 360;
    const double r = std::pow(std::max(0.0, std::cos(a - mirror)), exponent);
    (std::sin(a) >= 0 ? above : below).push_back({r * std::cos(a), r * std::sin(a)});
  }
  PlaneDrawing plane({.x = {-1.1, 1.1}, .y = {-0.5, 1.1}, .width = 300, .height = 218, .frame = false});
  below.push_back({0, 0});
  plane.area(below, transparent(kBlack, 0.3));
  plane.area(above, transparent(ink(0), 0.3));
  plane.line(above, ink(0), 2);
  plane.line({{-1.1, 0}, {1.1, 0}}, kBlack, 2);
  plane.line({{0, 0}, {-std::cos(mirror), std::sin(mirror)}}, ink(1), 1.5);
  plane.line({{0, 0}, {std::cos(mirror), std::sin(mirror)}}, ink(1), 1.5, true);
  return plane_part(caption, plane);
}

}  // namespace

Figure figure_4_18() {
  return {.title = "Fresnel reflectance of dielectrics",
          .note =
              "Two black balls. The left one has the Fresnel reflectance of glass, 0.04 at normal incidence, and "
              "reflects strongly at its edge; the right one reflects 0.04 at all angles.",
          .make = [](const MakeContext& context) -> Result<Parts> {
            const auto light = [](Scene& scene) { add_builtin_environment(scene, "studio"); };
            const Material fresnel =
                of_model("fresnel-mirror", Rgb(1),
                         {{"fresnel", std::string("dielectric")}, {"eta.r", 1.5}, {"eta.g", 1.5}, {"eta.b", 1.5}});
            return Parts{rendering_part("Fresnel", ball_view(fresnel, light), context, {.samples = 64, .exposure = 2}),
                         rendering_part("Constant reflectance", ball_view(of_model("mirror", Rgb(0.04f)), light),
                                        context, {.samples = 64, .exposure = 2})};
          }};
}

Figure figure_4_19() {
  return {
      .title = "Schlick's approximation of the Fresnel functions",
      .note = "From vacuum to glass (1.5) and to diamond (2.42).",
      .make = [](const MakeContext&) -> Result<Parts> {
        Parts parts;
        for (const bool transmitted : {false, true})
          parts.push_back(curves_part(transmitted ? "Transmittance" : "Reflectance", "angle of incidence (degrees)", "",
                                      {fresnel_curve("glass", 1.5f, transmitted, false),
                                       fresnel_curve("glass, Schlick", 1.5f, transmitted, true),
                                       fresnel_curve("diamond", 2.42f, transmitted, false),
                                       fresnel_curve("diamond, Schlick", 2.42f, transmitted, true)}));
        return parts;
      }};
}

Figure figure_4_34() {
  return {.title = "Isotropic and anisotropic brushed aluminium",
          .note = "Ward's model with roughness 0.2 in both directions, and with 0.08 and 0.35.",
          .make = [](const MakeContext& context) -> Result<Parts> {
            Parts parts;
            for (const auto& [name, x, y] : {std::tuple("Isotropic", 0.2, 0.2), std::tuple("Anisotropic", 0.08, 0.35)})
              parts.push_back(rendering_part(name,
                                             ball_view(of_model("ward", Rgb(0.9f),
                                                                {{"diffuse", 0.05},
                                                                 {"specular.r", 0.6},
                                                                 {"specular.g", 0.6},
                                                                 {"specular.b", 0.62},
                                                                 {"alpha-x", x},
                                                                 {"alpha-y", y}}),
                                                       light_from_upper_left),
                                             context, {.samples = 64, .curve = image::ToneCurve::none}));
            return parts;
          }};
}

Figure figure_4_38() {
  return {.title = "Lambertian spheres",
          .note =
              "Right, two suns of equal irradiance: the reflected radiance falls with the cosine of the angle of "
              "incidence.",
          .make = [](const MakeContext& context) -> Result<Parts> {
            const Material lambert = of_model("lambert", {0.8f, 0.45f, 0.25f});
            const auto from_side = [](Scene& scene) {
              add_light(scene, "directional", {{"intensity", 3.0}}, {-5, 0.5f, 0.5f});
              add_light(scene, "directional", {{"intensity", 3.0}}, {5, 0.5f, 0.5f});
            };
            return Parts{rendering_part("One sun, upper left", ball_view(lambert, light_from_upper_left), context,
                                        {.samples = 32, .curve = image::ToneCurve::none}),
                         rendering_part("Suns from both sides", ball_view(lambert, from_side), context,
                                        {.samples = 32, .curve = image::ToneCurve::none})};
          }};
}

Figure figure_4_39() {
  return {.title = "Cylinders with Phong's model, exponents 5, 20, 100 and 1000",
          .make = [](const MakeContext& context) -> Result<Parts> {
            Scene scene;
            const scene::OutlinePoint outline[] = {{{0.45f, -1}, {1, 0}}, {{0.45f, 1}, {1, 0}}};
            const auto cylinder = scene::lathe(outline, 96);
            float x = -1.8f;
            for (const double exponent : {5.0, 20.0, 100.0, 1000.0}) {
              scene::add(scene, cylinder, phong_surface({0.3f, 0.45f, 0.7f}, exponent),
                         scene::translated({x, 0, 0}).to_matrix());
              x += 1.2f;
            }
            add_light(scene, "directional", {{"intensity", 2.5}}, {-1.5f, 1, 4});
            MakeContext wide = context;
            wide.width = 2 * context.width;
            return Parts{rendering_part("", view_of(std::move(scene), {0, 0.3f, 7}, {0, 0, 0}, 0.36f), wide,
                                        {.samples = 64, .curve = image::ToneCurve::none, .aspect = 2.2})};
          }};
}

Figure figure_4_41() {
  return {.title = "Cosine power lobes",
          .note = "The part of a wide lobe that lies below the surface is grey.",
          .make = [](const MakeContext&) -> Result<Parts> {
            return Parts{lobe_part("Exponent 3 at 60 degrees", 3, 60), lobe_part("Exponent 40 at 60 degrees", 40, 60),
                         lobe_part("Exponent 3 at 88 degrees", 3, 88)};
          }};
}

Figure figure_4_42() {
  return {.title = "The exponent of Phong's model", .make = [](const MakeContext&) -> Result<Parts> {
            std::vector<FunctionCurve> powers;
            PlaneDrawing polar({.x = {-1.05, 1.05}, .y = {-0.05, 1.05}, .width = 420, .height = 236, .frame = false});
            for (int n = 1; n <= 7; ++n) {
              powers.push_back(
                  {.name = "n = " + std::to_string(n),
                   .points = sampled([n](double a) { return std::pow(std::cos(a * std::numbers::pi / 180), n); }, 0, 90,
                                     181)});
              std::vector<Point> lobe;
              for (int a = -90; a <= 90; ++a) {
                const double angle = a * std::numbers::pi / 180, r = std::pow(std::cos(angle), n);
                lobe.push_back({r * std::sin(angle), r * std::cos(angle)});
              }
              polar.line(lobe, ink(static_cast<size_t>(n - 1)), 1.5);
            }
            polar.line({{-1.05, 0}, {1.05, 0}}, kBlack);
            return Parts{curves_part("Powers of the cosine", "angle (degrees)", "", std::move(powers)),
                         plane_part("The same around the mirror direction", polar)};
          }};
}

Figure figure_4_44() {
  return {.title = "Phong and Blinn-Phong",
          .note =
              "Left of each pair Phong's model, right Blinn's with four times the exponent, which gives highlights of "
              "similar width. Exponents from 1 to 200.",
          .columns = 6,
          .make = [](const MakeContext& context) -> Result<Parts> {
            Parts parts;
            for (const double exponent : {1.0, 5.0, 10.0, 30.0, 80.0, 200.0})
              for (const bool blinn : {false, true}) {
                const Material material =
                    phong_surface({0.7f, 0.3f, 0.2f}, blinn ? 4 * exponent : exponent, blinn ? "blinn-phong" : "phong");
                parts.push_back(rendering_part(
                    std::string(blinn ? "Blinn, " : "Phong, ") + metrics::short_number(blinn ? 4 * exponent : exponent),
                    ball_view(material, light_from_upper_left), context,
                    {.samples = 32, .curve = image::ToneCurve::none, .columns = 2}));
              }
            return parts;
          }};
}

Figure figure_4_52() {
  return {.title = "The isotropic phase function", .make = [](const MakeContext&) -> Result<Parts> {
            return Parts{phase_part("Light arrives from the left", "isotropic")};
          }};
}
Figure figure_4_53() {
  return {.title = "Henyey-Greenstein phase functions",
          .note = "Relative to the largest value. Light arrives from the left; g > 0 scatters forward.",
          .columns = 4,
          .make = [](const MakeContext&) -> Result<Parts> { return parts_over_g("henyey-greenstein", "g"); }};
}
Figure figure_4_54() {
  return {.title = "Schlick's phase functions",
          .note = "Relative to the largest value. Light arrives from the left.",
          .columns = 4,
          .make = [](const MakeContext&) -> Result<Parts> { return parts_over_g("schlick", "k"); }};
}
Figure figure_4_55() {
  return {.title = "The phase function of Rayleigh", .make = [](const MakeContext&) -> Result<Parts> {
            return Parts{phase_part("Light arrives from the left", "rayleigh")};
          }};
}
Figure figure_4_56() {
  return {.title = "Lorenz-Mie phase functions",
          .note = "Relative to the largest value.",
          .make = [](const MakeContext&) -> Result<Parts> {
            return Parts{phase_part("Hazy atmosphere", "mie-hazy"), phase_part("Murky atmosphere", "mie-murky")};
          }};
}

Figure figure_4_57() {
  return {.title = "Point light and area light", .make = [](const MakeContext& context) -> Result<Parts> {
            return Parts{
                still_life_part("Point light: hard shadows", "point", {{"intensity", 60.0}}, context),
                still_life_part("Area light: soft shadows", "disk", {{"intensity", 15.0}, {"radius", 1.1}}, context)};
          }};
}
Figure figure_4_58() {
  return {.title = "Directional light and point light",
          .note = "The plane has one colour in directional light. Shadows are included.",
          .make = [](const MakeContext& context) -> Result<Parts> {
            return Parts{still_life_part("Directional light", "directional", {{"intensity", 3.0}}, context),
                         still_life_part("Point light", "point", {{"intensity", 60.0}}, context)};
          }};
}
Figure figure_4_59() {
  return {.title = "Ambient light and point light", .make = [](const MakeContext& context) -> Result<Parts> {
            return Parts{still_life_part("Ambient light", "ambient", {{"intensity", 0.7}}, context),
                         still_life_part("Point light", "point", {{"intensity", 60.0}}, context)};
          }};
}

Figure figure_1_2() {
  return {
      .title = "Phong shading",
      .note = "Ray casting with local illumination: ambient light and a point light, without shadows.",
      .make = [](const MakeContext& context) -> Result<Parts> {
        Scene scene;
        const Rgb colors[] = {
            {0.8f, 0.25f, 0.2f}, {0.25f, 0.6f, 0.25f}, {0.25f, 0.35f, 0.8f}, {0.8f, 0.65f, 0.2f}, {0.6f, 0.3f, 0.65f}};
        for (int i = 0; i < 5; ++i)
          add_ball(scene, {1.7f * static_cast<float>(i) - 3.4f, 0.8f, i % 2 == 0 ? 0.0f : -1.2f}, 0.8f,
                   phong_surface(colors[i], 10 * std::pow(2, i)));
        add_floor(scene, Rgb(0.5f));
        add_light(scene, "point", {{"intensity", 90.0}}, {-3, 5, 4});
        add_light(scene, "ambient", {{"intensity", 0.15}}, {0, 3, 0});
        render::Document document = view_of(std::move(scene), {0, 3.2f, 9}, {0, 0.6f, 0}, 0.5f);
        MakeContext wide = context;
        wide.width = 3 * context.width / 2;
        set(document, {"integrator=raycast", "raycast.lights=every"});
        return Parts{rendering_part("", document, wide, {.samples = 32, .curve = image::ToneCurve::none, .aspect = 2})};
      }};
}

}  // namespace etendue::figures
