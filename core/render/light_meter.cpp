#include "render/light_meter.h"

#include <algorithm>
#include <cmath>

#include "light/flux.h"
#include "scene/builtin/shapes.h"
#include "scene/compiled_scene.h"

namespace etendue::render {
namespace {

constexpr int kPixels = 8;           // of a reading, either way
constexpr float kCardShare = 1e-4f;  // the card's radius, in parts of the scene's
constexpr float kLift = 0.02f;       // how far the card lies off the surface, in parts of its radius
constexpr float kField = 0.2f;       // radians, of the camera that looks at the card
constexpr float kNeedle = 1e-3f;     // radians, of the one that looks along the eye's ray

Mat4 placed(const Vec3& position, const Vec3& normal) {
  // The disk lies in the xz plane and faces +y.
  const etendue::Frame frame(normal);
  return {Vec4(frame.x, 0), Vec4(normal, 0), Vec4(glm::cross(frame.x, normal), 0), Vec4(position, 1)};
}

Document bare(const Document& document, std::shared_ptr<const scene::Scene> scene, const Camera& camera) {
  Document d;
  d.scene = std::move(scene);
  d.camera = camera;
  d.camera.lens_radius = 0, d.camera.shutter = document.camera.shutter;
  d.width = d.height = kPixels;
  d.filter = film::FilterKind::box;
  d.forced_flags = document.forced_flags;
  d.seed = document.seed;
  return d;
}

Document of_irradiance(const Document& document, const Spot& spot, float radius) {
  auto scene = std::make_shared<scene::Scene>(*document.scene);
  Material card = scene::diffuse(Rgb(1));
  card.name = "light meter";
  card.double_sided = false;
  const Vec3 at = spot.position + spot.normal * (kLift * radius);
  scene::add(*scene, scene::disk(radius, 24), card, placed(at, spot.normal));
  const Vec3 eye = at + spot.normal * (2 * radius);
  const Camera camera = look_at(eye, at, etendue::Frame(spot.normal).x, kField);
  return bare(document, std::move(scene), camera);
}

Document of_radiance(const Document& document, const Spot& spot) {
  const Vec3 towards = normalize_or(spot.position - spot.eye, -spot.normal);
  return bare(document, document.scene, look_at(spot.eye, spot.position, etendue::Frame(towards).x, kNeedle));
}

MeterReading reading_of(const film::Film& film, float factor) {
  double sums[3]{}, squares = 0;
  constexpr int kAll = kPixels * kPixels;
  for (int y = 0; y < kPixels; ++y)
    for (int x = 0; x < kPixels; ++x) {
      const Rgb mean = film.mean(x, y), variance = film.variance_of_mean(x, y);
      for (int c = 0; c < 3; ++c) sums[c] += static_cast<double>(mean[c]);
      // Bands are as noisy together as any alone.
      squares += static_cast<double>(max_component(variance));
    }
  const auto f = static_cast<double>(factor);
  MeterReading r;
  for (int c = 0; c < 3; ++c) r.value[c] = static_cast<float>(f * sums[c] / kAll);
  r.standard_error = f * std::sqrt(squares) / kAll;
  return r;
}

// One of the two small renderings, which goes on where it was.
class Instrument {
 public:
  Instrument(Document document, float factor, std::shared_ptr<const scene::CompiledScene> scene, int threads)
      : document_(std::move(document)), factor_(factor), session_(options_of(std::move(scene), threads)) {}

  MeterReading read(uint32_t samples) {
    document_.limits.samples = samples;
    session_.submit(document_);
    session_.finish();
    return reading_of(session_.film_copy(), factor_);
  }

 private:
  static SessionOptions options_of(std::shared_ptr<const scene::CompiledScene> scene, int threads) {
    SessionOptions options;
    options.threads = threads, options.scene = std::move(scene);
    return options;
  }

  Document document_;
  float factor_;
  Session session_;
};

Rgb flux_of(const scene::CompiledScene& scene, uint32_t instance) {
  Rgb flux(0);
  for (const EmissiveTriangle& t : scene.lights().triangles())
    if (t.instance == instance) flux += etendue::flux_of(t);
  return flux;
}

}  // namespace

std::optional<Spot> meter_point_at(const Document& document, const scene::CompiledScene& scene, Vec2 raster) {
  Camera pinhole = document.camera;
  pinhole.lens_radius = 0;
  const Ray ray = CameraRays(pinhole, document.width, document.height).ray(raster, Vec2(0.5f));
  const Hit hit = scene.intersect(ray, 0);
  if (!hit) return std::nullopt;
  const Vec3 wo = -ray.direction;
  scene::SurfacePoint point;
  scene.surfaces({&wo, 1}, {&hit, 1}, &point);
  Spot spot;
  spot.position = point.position, spot.eye = ray.origin;
  spot.normal = glm::dot(point.ng, wo) < 0 ? -point.ng : point.ng;
  spot.instance = static_cast<uint32_t>(point.instance - scene.instances().data());
  return spot;
}

void measure_light(const Document& document, std::shared_ptr<const scene::CompiledScene> scene, const Spot& spot,
                   uint32_t samples, int threads, const std::function<bool(const MeterReadings&)>& publish) {
  // Floats must tell the card from the surface.
  const float far_away = std::max(glm::length(spot.position), glm::length(spot.eye));
  const float radius = std::max(kCardShare * scene->bounds().radius(), 1e-5f * far_away);
  MeterReadings readings;
  readings.spot = spot;
  readings.emitted_flux = flux_of(*scene, spot.instance);
  Instrument radiance(of_radiance(document, spot), 1, scene, threads);
  Instrument irradiance(of_irradiance(document, spot, radius), kPi, scene, threads);
  for (uint32_t n = std::min(samples, 4U);; n = std::min(samples, 2 * n)) {
    readings.radiance = radiance.read(n), readings.irradiance = irradiance.read(n);
    readings.samples = n;
    if (!publish(readings) || n == samples) return;
  }
}

}  // namespace etendue::render
