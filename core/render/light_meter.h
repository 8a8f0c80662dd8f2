// Light meters: what arrives at a point of a surface, what leaves it towards the eye, and what an object sends out.
//                                                                              thesis 3.3, 3.4; table 3.1 and 3.2
//
// The irradiance is read as a photographer does, off a small white card: a disk of albedo one, some ten-thousandths of
// the scene wide, lies on the surface and is looked at from close by. It is measured by path tracing, whatever method
// makes the picture.
#pragma once
#include <functional>
#include <memory>

#include "render/session.h"

namespace etendue::render {

// What is looked at: a point that the camera sees.
struct Spot {
  Vec3 position{0}, normal{0, 1, 0};  // the geometric normal on the eye's side
  Vec3 eye{0};                        // where it is seen from
  uint32_t instance = 0;              // of the compiled scene
};

// The spot under a place of the picture, in pixels; nothing if the ray meets nothing.
std::optional<Spot> meter_point_at(const Document& document, const scene::CompiledScene& scene, Vec2 raster);

// Of the mean, per band, with one standard error of the mean over bands.
struct MeterReading {
  Rgb value{0};
  double standard_error = 0;
};

struct MeterReadings {
  Spot spot;
  MeterReading radiance;    // W/(m^2 sr), from the spot to the eye
  MeterReading irradiance;  // W/m^2, onto the spot from the eye's side
  // W, what the object under the spot emits, by its material; of textured emission the mean.
  Rgb emitted_flux{0};
  uint32_t samples = 0;  // of each of 64 pixels
};

// Goes on with more samples, and publishes each time, until there are `samples` or `publish` says no.
void measure_light(const Document& document, std::shared_ptr<const scene::CompiledScene> scene, const Spot& spot,
                   uint32_t samples, int threads, const std::function<bool(const MeterReadings&)>& publish);

}  // namespace etendue::render
