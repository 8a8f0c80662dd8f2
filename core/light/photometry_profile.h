// The luminous intensity of a luminaire in every direction, as measured by a goniophotometer.
//
// Files are those of IES LM-63 (1986, 1991, 1995, 2002 and 2019), photometry of types C, B and A. Values between the
// measured angles are interpolated linearly, directions beyond them are dark. Symmetries of the angles are expanded.
// Candela values are multiplied by the file's multiplier and ballast factor, in files of 1986 and 1991 also by the
// photometric factor. They are absolute: the lumens per source, or -1 for absolute photometry, change nothing.
//                                                                                                    [IES LM-63-2002]
//
// Directions are in the frame of a light: -z is the direction of emission.
//
//   type C    vertical angle from -z; horizontal angle from +x towards +y
//   type B    vertical angle about the x axis from -z towards +y; horizontal angle out of the yz plane, towards +x
//   type A    horizontal angle about the y axis from -z towards +x; vertical angle out of the xz plane, towards +y
#pragma once
#include <cstdint>
#include <vector>

#include "base/vec.h"

namespace etendue {

class PhotometryProfile {
 public:
  // A profile by a function of the vertical and the horizontal angle of type C, in radians, at steps of one degree up
  // to 180, and of 10 degrees around.
  static PhotometryProfile sampled(float (*intensity)(float vertical, float horizontal));

  // cd, in a unit direction.
  float intensity(const Vec3& direction) const;
  float largest_intensity() const { return largest_; }
  // The integral of the intensity over the sphere, lm. In closed form.
  float flux() const { return flux_; }

  // The factor on the intensity of a luminaire that is tilted by this angle in radians from the position of the
  // measurement (the TILT data of the file), interpolated linearly; 1 without such data.
  float tilt_factor(float angle) const;

  // Directions uniform over the solid angle between the measured angles, outside of which there is no light.
  Vec3 sample_direction(Vec2 u) const;
  // Of `sample_direction`, per solid angle.
  float direction_pdf() const { return 1 / solid_angle_; }

 private:
  enum class Type : uint8_t { c = 1, b = 2, a = 3 };
  friend class PhotometryReader;

  // `polar` and `azimuths` ascend; `values` has one row of polar angles per azimuth.
  PhotometryProfile(Type type, std::vector<float> polar, std::vector<float> azimuths, std::vector<float> values);

  float value(size_t azimuth, size_t polar) const { return values_[azimuth * polar_.size() + polar]; }
  void integrate();

  Type type_;
  // Angles about and from the axis of the type: -z of type C, x of type B, y of type A. Radians.
  std::vector<float> polar_, azimuths_, values_;
  std::vector<float> tilt_angles_, tilt_factors_;  // ascending, radians
  float largest_ = 0, flux_ = 0, solid_angle_ = 4 * kPi;
};

}  // namespace etendue
