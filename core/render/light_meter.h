// A virtual light meter: irradiance at a surface point, radiance from it to the camera, and flux of the object there.
//                                                                       [Lang, sec. 3.3, 3.4; tables 3.1 and 3.2]
//
// Irradiance is measured as a photographer does, with a white card: a disk of albedo one, with a radius of about 1e-4
// of the scene's, lies on the surface, and a camera views it from close by. All quantities are measured by path
// tracing, independently of the integrator of the document. Path tracing does not find caustics of point, spot and
// directional lights. Radiance and irradiance contain them as estimates from photons (progressive photon mapping), averaged
// over a disk of 0.5 % of the scene's radius; the flux of a sensor and spectra do not.
#pragma once
#include <array>
#include <functional>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "render/measured_spectrum.h"
#include "render/session.h"

namespace etendue::render {

// The measured point: a surface point that the camera sees.
struct MeterPoint {
  Vec3 position{0};
  Vec3 normal{0, 1, 0};   // geometric normal on the side of the camera
  Vec3 eye{0};            // position from which the point is seen
  uint32_t instance = 0;  // of the compiled scene
};

// The surface point at a position of the image, in pixels; nothing if the camera ray hits nothing.
std::optional<MeterPoint> meter_point_at(const Document& document, const scene::CompiledScene& scene, Vec2 raster);

// A mean per colour channel with its standard error, that of the noisiest channel.
struct MeterReading {
  Rgb value{0};
  double standard_error = 0;
};

// What a light emits towards the measured point, whether or not something is in between.
struct LightIntensity {
  std::string name;
  Rgb intensity{0};    // cd; of an extended light the sum over its surface, as from far away
  float distance = 0;  // m; of an extended light to the nearest of its triangle centroids
};

struct MeterReadings {
  MeterPoint point;
  MeterReading radiance;    // luminance in cd/m^2, from the point to the camera
  MeterReading irradiance;  // illuminance in lx, at the point, on the side of the camera
  // lm, emitted by the object at the point. For textured emission this uses the mean radiance.
  Rgb emitted_flux{0};
  Rgb emitted_exitance{0};  // lm/m^2, the emitted flux over the area of all emitting sides
  // Lights without extent and emissive meshes, strongest illuminance first, at most kMeterLights.
  std::vector<LightIntensity> lights;
  std::optional<MeterReading> received_flux;  // lm, by the sensor; nothing without one
  uint32_t samples = 0;                       // per pixel, of 64 pixels
};

inline constexpr size_t kMeterLights = 8;

struct MeterSettings {
  uint32_t samples = 1024;  // per pixel, of 64 pixels
  int threads = 0;          // 0: one per hardware thread
  // Side of a square sensor at the point that measures the received flux on the side of the camera, m; 0 for none. It
  // is opaque with an albedo of 1 %, so that it casts a shadow but hardly reflects.
  float sensor_size = 0;
};

// The corners of the sensor, in order. Two of its sides are horizontal, or along x if it lies flat.
std::array<Vec3, 4> sensor_corners(const MeterPoint& point, float size);

// Measures with a growing number of samples and calls `publish` after each step, until the number reaches that of the
// settings or `publish` returns false.
void measure_light(const Document& document, std::shared_ptr<const scene::CompiledScene> scene, const MeterPoint& point,
                   const MeterSettings& settings, const std::function<bool(const MeterReadings&)>& publish);

// The spectrum of the radiance from the point to the camera, and that of the irradiance at the point, in W/(m^2 nm).
// An error says why the scene has no spectral rendering, or that `keep_going` returned false.
Result<MeasuredSpectrum> measure_radiance_spectrum(const Document& document,
                                                   std::shared_ptr<const scene::CompiledScene> scene,
                                                   const MeterPoint& point, uint32_t samples,
                                                   const std::function<bool()>& keep_going);
Result<MeasuredSpectrum> measure_irradiance_spectrum(const Document& document, const scene::CompiledScene& scene,
                                                     const MeterPoint& point, uint32_t samples,
                                                     const std::function<bool()>& keep_going);

}  // namespace etendue::render
