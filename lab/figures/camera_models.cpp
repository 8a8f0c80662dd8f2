// Figures of cameras, of the radiance that they measure, and of lights as a point sees them.
#include <cmath>

#include "base/frame.h"
#include "camera/camera_ray.h"
#include "figures/tools.h"
#include "film/film.h"
#include "render/session.h"
#include "scene/builtin/scene_builder.h"
#include "scene/compiled_scene.h"

namespace etendue::figures {
namespace {

// ---- Radiance in a vacuum

constexpr float kDistances[] = {2, 3, 4.5f, 7, 10};  // metres

// A square of a side of 1 m and the radiance 1, at a distance from a camera with a fixed field of view.
render::Document square_at(float distance) {
  scene::Scene scene;
  scene::add(scene, scene::quad(0.5f), scene::diffuse(Rgb(0), Rgb(1)));
  render::Document document;
  document.scene = std::make_shared<const scene::Scene>(std::move(scene));
  document.camera = look_at({0, distance, 0}, {0, 0, 0}, {0, 0, -1}, 0.8f);
  set(document, {"integrator=raycast"});
  return document;
}

struct Measured {
  double radiance = 0, irradiance = 0;  // of the central pixel; of the film, relative to the first distance
};
Measured measured_at(float distance, int threads) {
  render::Document document = square_at(distance);
  document.width = document.height = 129;
  const film::Film film = render::rendered(document, 64, threads);
  Measured result{.radiance = double{film.mean(64, 64).g}, .irradiance = 0};
  for (int y = 0; y < 129; ++y)
    for (int x = 0; x < 129; ++x) result.irradiance += double{film.mean(x, y).g} / (129.0 * 129.0);
  return result;
}

// ---- Lights on the sphere of directions

// The directions above a point of the scene that a pixel of the camera sees, in orthogonal projection: white where an
// emitter is visible, grey elsewhere.
Picture lights_above(const render::Document& document, Vec2 position, int size) {
  const auto scene = scene::compile(document.scene, document.camera, nullptr);
  constexpr int kRaster = 100;
  const CameraRays camera(document.camera, kRaster, kRaster);
  const auto point_on = [&](const Ray& ray, scene::SurfacePoint& point) {
    const Hit hit = scene->intersect(ray, 0);
    const Vec3 wo = -ray.direction;
    if (hit) scene->surfaces({&wo, 1}, {&hit, 1}, &point);
    return static_cast<bool>(hit);
  };
  scene::SurfacePoint start;
  if (!point_on(camera.ray(position * static_cast<float>(kRaster), {0.5f, 0.5f}), start))
    return grey_picture(size, [](double, double) { return 1.0; });
  const Frame frame(start.shading.z);
  return grey_picture(size, [&](double u, double v) {
    const double x = 2 * u - 1, y = 2 * v - 1, squared = x * x + y * y;
    if (squared >= 1) return 1.0;
    const auto z = static_cast<float>(std::sqrt(1 - squared));
    const Vec3 direction = frame.x * static_cast<float>(x) + frame.y * static_cast<float>(y) + frame.z * z;
    Ray ray;
    start.spawn(direction, ray);
    scene::SurfacePoint seen;
    if (!point_on(ray, seen)) return 0.75;
    return is_black(scene->emitted(seen, -direction)) ? 0.35 : 0.0;
  });
}

// ---- Thin lens

// Rays from five points of the lens through three points of the plane in focus, in the plane of the axis.
Part lens_part(const std::string& caption, float radius, float focus) {
  Camera camera;
  camera.yfov = 0.9f;
  camera.lens_radius = radius;
  camera.focus_distance = focus;
  constexpr int kRaster = 100;
  const CameraRays rays(camera, kRaster, kRaster);
  constexpr float kFar = 8;
  PlaneDrawing plane({.x = {-0.5, kFar}, .y = {-2.6, 2.6}, .width = 420, .height = 260, .frame = false});
  plane.line({{-0.5, 0}, {kFar, 0}}, kLightGrey, 1, true);
  plane.line({{double{focus}, -2.6}, {double{focus}, 2.6}}, kGrey, 1.5);
  plane.line({{0, -double{radius}}, {0, double{radius}}}, kBlack, 4);
  size_t color = 0;
  for (const float y : {20.0f, 50.0f, 80.0f}) {
    for (const float lens : {0.0f, 0.25f, 0.5f, 0.75f, 1.0f}) {
      // The unit square is mapped to the lens; its middle row is a diameter.
      const Ray ray = rays.ray({kRaster / 2.0f, y}, {0.5f, lens});
      const float length = (kFar + ray.origin.z) / -ray.direction.z;
      const Vec3 end = ray.origin + ray.direction * length;
      plane.line({{-double{ray.origin.z}, double{ray.origin.y}}, {-double{end.z}, double{end.y}}}, ink(color), 1);
    }
    ++color;
  }
  return plane_part(caption, plane);
}

Picture turned(Picture picture) {
  Picture result = picture;
  const size_t pixels = picture.pixels.size() / 3;
  for (size_t i = 0; i < pixels; ++i)
    for (size_t c = 0; c < 3; ++c) result.pixels[3 * i + c] = picture.pixels[3 * (pixels - 1 - i) + c];
  return result;
}

}  // namespace

Figure figure_3_8() {
  return {
      .title = "Radiance invariance in a vacuum",
      .note = "A square of radiance 1 at three distances: its image becomes smaller and not darker.",
      .make = [](const MakeContext& context) -> Result<Parts> {
        Parts parts;
        for (const float distance : {2.0f, 4.5f, 10.0f})
          parts.push_back(rendering_part("distance " + std::to_string(distance).substr(0, 4) + " m",
                                         square_at(distance), context, {.samples = 16, .exposure = -1, .columns = 2}));
        return parts;
      }};
}
Figure figure_3_9() {
  return {.title = "Radiance and irradiance over distance",
          .note =
              "Measured in renderings of the square of Figure 3.8: the radiance of the central pixel, and the mean of "
              "the image, "
              "which is proportional to the irradiance and falls with the square of the distance.",
          .make = [](const MakeContext& context) -> Result<Parts> {
            FunctionCurve radiance{.name = "radiance", .style = CurveStyle::line, .points = {}};
            FunctionCurve irradiance{.name = "irradiance, relative", .points = {}};
            FunctionCurve theory{.name = "1 / distance squared", .style = CurveStyle::dots, .points = {}};
            const double first = measured_at(kDistances[0], context.threads).irradiance;
            for (const float d : kDistances) {
              const Measured m = measured_at(d, context.threads);
              radiance.points.push_back({double{d}, m.radiance});
              irradiance.points.push_back({double{d}, m.irradiance / first});
              theory.points.push_back({double{d}, double{sqr(kDistances[0] / d)}});
            }
            return Parts{chart_part({.title = "A square of radiance 1",
                                     .x_label = "distance, m",
                                     .y_label = "",
                                     .curves = {radiance, irradiance, theory}})};
          }};
}

Figure figure_4_72() {
  return {.title = "The projection of light sources onto the unit sphere",
          .note =
              "The upper hemisphere above a point, in orthogonal projection: black where an emitter is visible, dark "
              "grey where "
              "other surfaces are, light grey where rays leave the scene.",
          .make = [](const MakeContext& context) -> Result<Parts> {
            const int size = context.width / 2 * 2;
            return Parts{{.caption = "Cornell box, on the floor",
                          .content = lights_above(document_of("cornell-spheres"), {0.5f, 0.88f}, size)},
                         {.caption = "Glossy plates, on the lowest one",
                          .content = lights_above(document_of("glossy-plates"), {0.5f, 0.8f}, size)}};
          }};
}

Figure figure_4_75() {
  return {.title = "Real and virtual pinhole camera",
          .note =
              "The film of a real camera lies behind the hole and sees the scene upside down; the image plane of the "
              "virtual "
              "camera lies in front of it.",
          .make = [](const MakeContext& context) -> Result<Parts> {
            Part upright = rendering_part("Virtual camera", document_of("cornell-spheres", {"integrator=bdpt"}),
                                          context, {.samples = 64});
            Part inverted{.caption = "Film of a real camera", .content = turned(std::get<Picture>(upright.content))};
            return Parts{std::move(inverted), std::move(upright)};
          }};
}

Figure figure_8_22() {
  return {.title = "A thin lens camera",
          .note =
              "Camera rays in the plane of the optical axis, from five points of the lens. They meet in the plane in "
              "focus; the "
              "width of a bundle elsewhere is the circle of confusion.",
          .make = [](const MakeContext&) -> Result<Parts> {
            return Parts{lens_part("focus at 4 m, radius 0.5 m", 0.5f, 4), lens_part("pinhole", 0.001f, 4)};
          }};
}

}  // namespace etendue::figures
