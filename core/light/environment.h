// Light from infinity: what a user edits.
#pragma once
#include <memory>
#include <optional>
#include <string>

#include "base/vec.h"
#include "image/image.h"
#include "spectrum/emission_spectrum.h"
#include "spectrum/rgb.h"

namespace etendue {

enum class SkyModel : uint8_t { preetham, hosek_wilkie };

enum class SunPosition : uint8_t { angles, time };

// A clear sky with a sun (environments/sky.h). The angles of the sun are given, or follow from a place and a time.
struct Sky {
  SkyModel model = SkyModel::preetham;
  SunPosition sun_position = SunPosition::angles;
  float sun_elevation = 0.7f;  // radians above the horizon
  float sun_azimuth = 0.9f;    // radians; 0 is +z, pi / 2 is +x
  float latitude = 0.84f;      // radians, north is positive
  int day = 172;               // of the year, from 1; 172 is the solstice in June
  float hour = 12;             // of local solar time: the sun is highest at 12
  float turbidity = 3;         // optical depth of the atmosphere over that of pure air: 2 is very clear, 10 hazy
  float ground_albedo = 0.2f;
  bool sun_disk = true;  // the sun itself emits; without it only the sky does

  friend bool operator==(const Sky&, const Sky&) = default;
};

// A disk at infinity that is too small for a map.
struct SunDisk {
  Vec3 direction{0, 1, 0};   // unit, towards its centre, before the rotation of the environment
  Rgb radiance{0};           // mean over the disk, cd/m^2
  float angular_radius = 0;  // radians, small
  float limb_darkening = 0;  // coefficient u of L(mu) = L(1) (1 - u (1 - mu)), mu the cosine at the sun's surface

  friend bool operator==(const SunDisk&, const SunDisk&) = default;
};

// Radiance from infinity, cd/m^2: an equirectangular map times `tint`, or `tint` alone; and a sun, also
// times `tint`.
//
// Texture coordinates (u, v) of the map: u = 0.5 is the +x direction, v = 0 is +y. With phi = (u - 0.5) 2 pi the
// direction is (cos phi sin(pi v), cos(pi v), sin phi sin(pi v)), rotated by `rotation` about +y.
struct Environment {
  std::shared_ptr<const image::Image> map;  // float RGB; may be null
  std::string file;
  Rgb tint{0};
  float rotation = 0;                     // radians
  bool visible = true;                    // to camera rays
  bool backdrop = false;                  // if it is not visible: camera rays see a grey gradient instead of black
  float backdrop_brightness = 1;          // factor on the gradient
  std::optional<Sky> sky = std::nullopt;  // what the map and the sun were computed from
  std::optional<SunDisk> sun = std::nullopt;
  EmissionSpectrumRef spectrum = {};  // of all light from infinity; its RGB value multiplies the tint

  bool black() const { return is_black(tint); }
  // Takes over what does not belong to a map or a sky: rotation, background and spectrum.
  void keep_settings_of(const Environment& other) {
    rotation = other.rotation;
    visible = other.visible;
    backdrop = other.backdrop;
    backdrop_brightness = other.backdrop_brightness;
    spectrum = other.spectrum;
  }
  friend bool operator==(const Environment&, const Environment&) = default;
};

}  // namespace etendue
