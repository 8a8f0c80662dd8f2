#include "render/light_meter.h"

#include <algorithm>
#include <cmath>

#include "light/placed_light.h"
#include "render/incompatibility.h"
#include "scene/builtin/shapes.h"
#include "scene/compiled_scene.h"
#include "scene/light_kinds.h"

namespace etendue::render {
namespace {

constexpr int kPixels = 8;            // width and height of the rendered images
constexpr float kCardRadius = 1e-4f;  // as a fraction of the scene's radius
constexpr float kSensorAlbedo = 0.01f;
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

// The card must be distinguishable from the surface in single precision.
float card_radius(const scene::CompiledScene& scene, const MeterPoint& point) {
  const float distance_from_origin = std::max(glm::length(point.position), glm::length(point.eye));
  return std::max(kCardRadius * scene.bounds().radius(), 1e-5f * distance_from_origin);
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

  film::Film render(uint32_t samples) {
    document_.limits.samples = samples;
    session_.submit(document_);
    session_.finish();
    return session_.film_copy();
  }
  MeterReading read(uint32_t samples) { return reading_of(render(samples), factor_); }
  // For an image whose pixels all depend on the same photons: their errors do not average out.
  MeterReading read_photons(uint32_t samples) {
    const film::Film film = render(samples);
    MeterReading reading = reading_of(film, factor_);
    double sum = 0;
    for (int y = 0; y < kPixels; ++y)
      for (int x = 0; x < kPixels; ++x)
        sum += std::sqrt(static_cast<double>(max_component(film.variance_of_mean(x, y))));
    reading.standard_error = static_cast<double>(factor_) * sum / (kPixels * kPixels);
    return reading;
  }

 private:
  Document document_;
  float factor_;
  Session session_;
};

// A measurement with what path tracing does not find: caustics of lights without extent. These are estimated from
// photons within a part of the scene's radius, so they are averaged over such a disk.
class MeterWithCaustics {
 public:
  // `pixel` is the width of a pixel of the measurement at the surface, m.
  MeterWithCaustics(const Document& document, float factor, const std::shared_ptr<const scene::CompiledScene>& scene,
                    float pixel, int threads)
      : light_(document, factor, scene, threads) {
    if (!has_point_lights(*document.scene) || !has_specular_surfaces(*scene)) return;
    Document caustics = document;
    caustics.scene = std::make_shared<const scene::Scene>(with_point_lights_only(*document.scene));
    caustics.method.integrator = "sppm";
    caustics.method.color = transport::ColorMode::rgb;
    caustics.method.paths = kPointCaustics;
    const double radius = std::clamp<double>(kCausticRadius * scene->bounds().radius() / pixel, 0.1, 1000);
    for (const auto& [name, value] :
         {std::pair<const char*, Value>{"sppm.radius", radius}, {"sppm.photons", int64_t{kPhotons}}})
      caustics = *with(caustics, name, value);
    if (incompatibility(caustics, *scene).empty()) caustics_.emplace(std::move(caustics), factor, scene, threads);
  }

  MeterReading read(uint32_t samples) {
    MeterReading sum = light_.read(samples);
    if (!caustics_) return sum;
    const MeterReading caustics = caustics_->read_photons(samples);
    return {sum.value + caustics.value, std::hypot(sum.standard_error, caustics.standard_error)};
  }

 private:
  static constexpr const char* kPointCaustics = "E.*SL";
  static constexpr float kCausticRadius = 0.005f;  // as a fraction of the scene's radius
  static constexpr int kPhotons = 4096;            // per sample

  Meter light_;
  std::optional<Meter> caustics_;
};

// The width of a pixel at a distance from a camera with this field of view, m.
float pixel_width(float distance, float view) { return 2 * distance * std::tan(0.5f * view) / kPixels; }

// The flux that an instance emits, in lm, and the area of its emitting sides.
struct EmittedFlux {
  Rgb flux{0};
  float area = 0;
};
EmittedFlux flux_of(const scene::CompiledScene& scene, uint32_t instance) {
  EmittedFlux sum;
  for (const AreaLightTriangle& t : scene.lights().triangles()) {
    if (t.instance != instance) continue;
    sum.flux += t.flux();
    sum.area += t.area * (t.double_sided ? 2.0f : 1.0f);
  }
  return sum;
}

// Spheres, disks and cylinders are left out.
void add_area_lights(const scene::CompiledScene& scene, const Vec3& at, std::vector<LightIntensity>& lights) {
  constexpr uint32_t kNone = 0xffffffffU;
  uint32_t instance = kNone;
  for (const AreaLightTriangle& t : scene.lights().triangles()) {
    if (t.is_analytic()) continue;
    const Vec3 centroid = t.p0 + (t.e1 + t.e2) / 3.0f;
    const Vec3 to_point = at - centroid;
    const float distance = glm::length(to_point);
    if (!(distance > 0)) continue;
    if (t.instance != instance) {
      instance = t.instance;
      const scene::Node& node = scene.description().nodes[scene.instances()[instance].node];
      lights.push_back({node.name.empty() ? "emissive object" : node.name, Rgb(0), distance});
    }
    const float cosine = glm::dot(t.normal, to_point) / distance;
    const float facing = t.double_sided ? std::abs(cosine) : std::max(cosine, 0.0f);
    lights.back().intensity += t.radiance * (t.profile(facing) * facing * t.area);
    lights.back().distance = std::min(lights.back().distance, distance);
  }
}

void add_placed_lights(const scene::CompiledScene& scene, const Vec3& at, std::vector<LightIntensity>& lights) {
  const LightTable& table = scene.lights();
  const auto& placed = table.placed();
  for (size_t i = 0; i < placed.size(); ++i) {
    if (placed[i].is_infinite()) continue;
    const Vec3 to_point = at - placed[i].at(0).position;
    const float distance = glm::length(to_point);
    if (!(distance > 0)) continue;
    const auto number = static_cast<uint32_t>(table.triangles().size() + i);
    const Rgb intensity = table.emitted_by_placed(number, to_point / distance, distance, 0);
    lights.push_back({placed[i].name.empty() ? placed[i].type->name : placed[i].name, intensity, distance});
  }
}

std::vector<LightIntensity> intensities_towards(const scene::CompiledScene& scene, const Vec3& at) {
  std::vector<LightIntensity> lights;
  add_area_lights(scene, at, lights);
  add_placed_lights(scene, at, lights);
  std::erase_if(lights, [](const LightIntensity& light) { return is_black(light.intensity); });
  const auto illuminance = [](const LightIntensity& light) { return luminance(light.intensity) / sqr(light.distance); };
  std::ranges::stable_sort(lights, std::greater<>(), illuminance);
  if (lights.size() > kMeterLights) lights.resize(kMeterLights);
  return lights;
}

// A sensor in front of the surface, seen by an orthographic camera that it fills.
Document flux_measurement(const Document& document, const MeterPoint& point, float size, float offset, float albedo) {
  auto scene = std::make_shared<scene::Scene>(*document.scene);
  Material sensor = scene::diffuse(Rgb(albedo));
  sensor.name = "light meter";
  sensor.double_sided = false;
  const auto [corner, right, opposite, top] = sensor_corners(point, size);
  const Vec3 lift = offset * point.normal, centre = point.position + lift;
  scene::add(*scene, scene::rectangle(corner + lift, right - corner, top - corner), sensor);
  Camera camera = look_at(centre + 0.5f * lift, centre, glm::normalize(top - corner), 1);
  camera.projection = Projection::orthographic;
  camera.ymag = 0.5f * size;
  return measurement(document, std::move(scene), camera);
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
                    .instance = surface.instance->number};
}

std::array<Vec3, 4> sensor_corners(const MeterPoint& point, float size) {
  const Vec3 right = normalize_or(glm::cross(Vec3(0, 1, 0), point.normal), Vec3(1, 0, 0));
  const Vec3 x = 0.5f * size * right, y = 0.5f * size * glm::cross(point.normal, right);
  const Vec3& p = point.position;
  return {p - x - y, p + x - y, p + x + y, p - x + y};
}

void measure_light(const Document& document, std::shared_ptr<const scene::CompiledScene> scene, const MeterPoint& point,
                   const MeterSettings& settings, const std::function<bool(const MeterReadings&)>& publish) {
  const auto [samples, threads, sensor_size] = settings;
  const float radius = card_radius(*scene, point);
  MeterReadings readings;
  readings.point = point;
  const EmittedFlux emitted = flux_of(*scene, point.instance);
  readings.emitted_flux = emitted.flux;
  if (emitted.area > 0) readings.emitted_exitance = emitted.flux / emitted.area;
  readings.lights = intensities_towards(*scene, point.position);
  const float distance = glm::distance(point.position, point.eye);
  MeterWithCaustics radiance(radiance_measurement(document, point), 1, scene, pixel_width(distance, kRayView), threads);
  MeterWithCaustics irradiance(irradiance_measurement(document, point, radius), kPi, scene,
                               pixel_width(2 * radius, kCardView), threads);
  std::optional<Meter> received;
  if (sensor_size > 0)
    received.emplace(flux_measurement(document, point, sensor_size, radius, kSensorAlbedo),
                     kPi / kSensorAlbedo * sqr(sensor_size), nullptr, threads);
  for (uint32_t n = std::min(samples, 4U);; n = std::min(samples, 2 * n)) {
    readings.radiance = radiance.read(n);
    readings.irradiance = irradiance.read(n);
    if (received) readings.received_flux = received->read(n);
    readings.samples = n;
    if (!publish(readings) || n == samples) return;
  }
}

Result<MeasuredSpectrum> measure_radiance_spectrum(const Document& document,
                                                   std::shared_ptr<const scene::CompiledScene> scene,
                                                   const MeterPoint& point, uint32_t samples,
                                                   const std::function<bool()>& keep_going) {
  const Document seen = radiance_measurement(document, point);
  return measure_spectrum(seen, scene::compile(seen.scene, seen.camera, scene), samples, keep_going);
}

Result<MeasuredSpectrum> measure_irradiance_spectrum(const Document& document, const scene::CompiledScene& scene,
                                                     const MeterPoint& point, uint32_t samples,
                                                     const std::function<bool()>& keep_going) {
  const Document card = irradiance_measurement(document, point, card_radius(scene, point));
  const auto spectrum = measure_spectrum(card, scene::compile(card.scene, card.camera, nullptr), samples, keep_going);
  if (!spectrum) return spectrum.error();
  return spectrum->times(double{kPi});
}

}  // namespace etendue::render
