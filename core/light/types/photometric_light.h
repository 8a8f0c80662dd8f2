// Photometric light: a point light with the measured intensity of a luminaire, from an IES file.   [IES LM-63-2002]
//
//   E = I(direction) cos(theta) / r^2,    Phi = (integral of I over the sphere)
//
// I includes the TILT factor of the file for the angle between the direction of emission and straight down (-y), which
// is the position of the measurement. photometry_profile.h describes the files and their angles. Rays that leave the
// light are uniform over the solid angle of the measured angles.
#pragma once
#include <memory>

#include "light/photometry_source.h"
#include "light/types/punctual_emitter.h"

namespace etendue {

enum class PhotometricQuantity : uint8_t { factor, power };

}  // namespace etendue

template <>
struct etendue::Options<etendue::PhotometricQuantity> {
  static constexpr std::array<etendue::Option, 2> kOptions{
      {{"factor", "Factor on the candela of the file"}, {"power", "Luminous flux"}}};
};

namespace etendue {

inline constexpr LightQuantity kFactorOnFile{"Factor", "", "Factor", ""};

struct PhotometricLight {
  static constexpr LightTypeDescription kDescription{
      .name = "photometric",
      .label = "Photometric light (IES)",
      .summary = "A point light with the measured intensity of a luminaire, from an IES file",
      .light_class = LightClass::delta_position,
      .quantity = &kFactorOnFile,
      .formula = "E = I cos / r^2, with the intensity I of the profile in the direction to the receiver",
      .sampling = "its position; rays that leave it are uniform over the measured solid angle",
      .source = "[IES LM-63-2002]",
  };

  Number<float> intensity{"intensity",
                          "Intensity",
                          1,
                          {0, 1e9f},
                          "Factor on the intensity of the profile, or the luminous flux (see Quantity)",
                          "",
                          Scale::logarithmic};
  Choice<PhotometricQuantity> quantity{"quantity", "Quantity", PhotometricQuantity::factor,
                                       "Quantity that the intensity gives"};
  Text profile{"profile",
               "Profile",
               kPhotometryProfiles.front().name,
               "Path of an .ies file, or one of the profiles uniform, cosine, batwing and street, whose largest "
               "intensity or intensity on the axis is 1 cd",
               accepts_photometry,
               {kPhotometryProfiles.begin(), kPhotometryProfiles.end()}};
  Toggle tilt{
      "tilt", "Tilt factors", true,
      "Applies the TILT data of the file: luminaires that are tilted from pointing straight down (-y) may emit less. "
      "Files without such data are not affected"};
  Number<float> range = range_parameter();
  auto parameters() {
    intensity.unit = quantity == PhotometricQuantity::power ? kLuminousFlux.unit : kFactorOnFile.unit;
    return std::tie(intensity, quantity, profile, tilt, range);
  }

  struct Emitter : PunctualEmitter {
    std::shared_ptr<const PhotometryProfile> profile = photometry_profile(kPhotometryProfiles.front().name);
    bool tilts = true;

    // Of the luminaire as it was measured, without the tilt factor of its place.
    Rgb flux() const { return radiant_intensity() * profile->flux(); }
    float power(float) const { return luminance(flux()); }

    LightBounds bounds(const LightPlace& place) const {
      LightBounds b = PunctualEmitter::bounds(place);
      b.intensity *= profile->largest_intensity() * tilt_factor(place);
      return b;
    }

    bool sample(const LightPlace& place, const Vec3& from, Vec2, LightSample& s) const {
      if (!sample_point(place, from, s)) return false;
      s.radiance *= profile->intensity(place.frame().to_local(-s.wi)) * tilt_factor(place);
      return !is_black(s.radiance);
    }

    Rgb emitted(const LightPlace& place, const Vec3& direction, float distance) const {
      return radiant_intensity() *
             (profile->intensity(place.frame().to_local(direction)) * tilt_factor(place) * range_window(distance));
    }
    EmissionDensity emission_density(const SceneSphere&) const { return {1, profile->direction_pdf(), true, false}; }
    void sample_emission(const LightPlace& place, const SceneSphere& scene, const EmissionRandom& random,
                         Emission& e) const {
      e.position = place.position;
      resample_emission(place, scene, random.direction, e);
    }
    void resample_emission(const LightPlace& place, const SceneSphere&, Vec2 u, Emission& e) const {
      const Vec3 local = profile->sample_direction(u);
      e.direction = place.frame().to_world(local);
      e.radiance = radiant_intensity() * (profile->intensity(local) * tilt_factor(place));
    }

   private:
    float tilt_factor(const LightPlace& place) const {
      return tilts ? profile->tilt_factor(std::acos(std::clamp(-place.direction.y, -1.0f, 1.0f))) : 1;
    }
  };
  Emitter emitter(const Rgb& color) const {
    Emitter e{{color, intensity, range_or_infinity(range)}, photometry_profile(profile), tilt};
    if (quantity == PhotometricQuantity::power) e.intensity = e.profile->flux() > 0 ? intensity / e.profile->flux() : 0;
    return e;
  }
};

}  // namespace etendue
