#include "render/light_meter.h"

#include <algorithm>
#include <cmath>

#include "scene/builtin/shapes.h"
#include "scene/compiled_scene.h"

namespace etendue::render {
namespace {

constexpr int kPixels = 8;            // width and height of the rendered images
constexpr float kCardRadius = 1e-4f;  // as a fraction of the scene's radius
constexpr float kCardOffset = 0.02f;  // distance of the card from the surface, as a fraction of the card's radius
constexpr float kCardView = 0.2f;     // radians: field of view of the camera in front of the card
constexpr float kRayView = 1e-3f;     // radians: field of view of the camera at the eye

// The transform of a disk, which lies in the xz plane and faces +y, to a position with this normal.
Mat4 disk_transform(const Vec3& position, const Vec3& normal) {
  const etendue::Frame frame(normal);
  return {Vec4(frame.x, 0), Vec4(normal, 0), Vec4(glm::cross(frame.x, normal), 0), Vec4(position, 1)};
}

// A document with default settings for a measurement. Seed, shutter and model flags are those of the measured document.
Document measurement(const Document& document, std::shared_ptr<const scene::Scene> scene, const Camera& camera) {
  Document d;
  d.scene = std::move(scene);
  d.camera = camera;
  d.camera.lens_radius = 0;
  d.camera.shutter = document.camera.shutter;
  d.width = kPixels;
  d.height = kPixels;
  d.filter = film::FilterKind::box;
  d.forced_flags = document.forced_flags;
  d.method.color = document.method.color;
  d.seed = document.seed;
  return d;
}

// The radiance of the card is its irradiance divided by pi.
Document irradiance_measurement(const Document& document, const MeterPoint& point, float radius) {
  auto scene = std::make_shared<scene::Scene>(*document.scene);
  Material card = scene::diffuse(Rgb(1));
  card.name = "light meter";
  card.double_sided = false;
  const Vec3 center = point.position + point.normal * (kCardOffset * radius);
  scene::add(*scene, scene::disk(radius, 24), card, disk_transform(center, point.normal));
  const Vec3 eye = center + point.normal * (2 * radius);
  const Camera camera = look_at(eye, center, etendue::Frame(point.normal).x, kCardView);
  return measurement(document, std::move(scene), camera);
}

Document radiance_measurement(const Document& document, const MeterPoint& point) {
  const Vec3 direction = normalize_or(point.position - point.eye, -point.normal);
  const Camera camera = look_at(point.eye, point.position, etendue::Frame(direction).x, kRayView);
  return measurement(document, document.scene, camera);
}

// The mean over all pixels, times `factor`.
MeterReading reading_of(const film::Film& film, float factor) {
  double sums[3]{}, squares = 0;
  constexpr int kAll = kPixels * kPixels;
  for (int y = 0; y < kPixels; ++y)
    for (int x = 0; x < kPixels; ++x) {
      const Rgb mean = film.mean(x, y);
      for (int c = 0; c < 3; ++c) sums[c] += static_cast<double>(mean[c]);
      squares += static_cast<double>(max_component(film.variance_of_mean(x, y)));
    }
  const auto f = static_cast<double>(factor);
  MeterReading r;
  for (int c = 0; c < 3; ++c) r.value[c] = static_cast<float>(f * sums[c] / kAll);
  r.standard_error = f * std::sqrt(squares) / kAll;
  return r;
}

// A rendering of a measurement that continues with more samples at each reading.
class Meter {
 public:
  Meter(Document document, float factor, std::shared_ptr<const scene::CompiledScene> scene, int threads)
      : document_(std::move(document)), factor_(factor), session_({.threads = threads, .scene = std::move(scene)}) {}

  MeterReading read(uint32_t samples) {
    document_.limits.samples = samples;
    session_.submit(document_);
    session_.finish();
    return reading_of(session_.film_copy(), factor_);
  }

 private:
  Document document_;
  float factor_;
  Session session_;
};

// The flux that an instance emits, in lm.
Rgb flux_of(const scene::CompiledScene& scene, uint32_t instance) {
  Rgb flux(0);
  for (const AreaLightTriangle& t : scene.lights().triangles())
    if (t.instance == instance) flux += t.flux();
  return flux;
}

}  // namespace

std::optional<MeterPoint> meter_point_at(const Document& document, const scene::CompiledScene& scene, Vec2 raster) {
  Camera pinhole = document.camera;
  pinhole.lens_radius = 0;
  const Ray ray = CameraRays(pinhole, document.width, document.height).ray(raster, Vec2(0.5f));
  const Hit hit = scene.intersect(ray, 0);
  if (!hit) return std::nullopt;
  const Vec3 wo = -ray.direction;
  scene::SurfacePoint surface;
  scene.surfaces({&wo, 1}, {&hit, 1}, &surface);
  return MeterPoint{.position = surface.position,
                    .normal = glm::dot(surface.ng, wo) < 0 ? -surface.ng : surface.ng,
                    .eye = ray.origin,
                    .instance = static_cast<uint32_t>(surface.instance - scene.instances().data())};
}

void measure_light(const Document& document, std::shared_ptr<const scene::CompiledScene> scene, const MeterPoint& point,
                   uint32_t samples, int threads, const std::function<bool(const MeterReadings&)>& publish) {
  // The card must be distinguishable from the surface in single precision.
  const float distance_from_origin = std::max(glm::length(point.position), glm::length(point.eye));
  const float radius = std::max(kCardRadius * scene->bounds().radius(), 1e-5f * distance_from_origin);
  MeterReadings readings;
  readings.point = point;
  readings.emitted_flux = flux_of(*scene, point.instance);
  Meter radiance(radiance_measurement(document, point), 1, scene, threads);
  Meter irradiance(irradiance_measurement(document, point, radius), kPi, scene, threads);
  for (uint32_t n = std::min(samples, 4U);; n = std::min(samples, 2 * n)) {
    readings.radiance = radiance.read(n);
    readings.irradiance = irradiance.read(n);
    readings.samples = n;
    if (!publish(readings) || n == samples) return;
  }
}

}  // namespace etendue::render
