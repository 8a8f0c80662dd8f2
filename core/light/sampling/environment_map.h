// The environment, prepared for sampling.
//
// Radiance is interpolated between texel centres, and the sampling density as well: it follows a small sun exactly, so
// that radiance over density stays bounded. A patch between four texel centres is chosen by its mean, a point in it
// by its corners. The patches at the poles reach half a texel beyond the map; points there are mirrored back.
//
// A sun is added to the map. Directions come from its disk with a probability that follows its share of the flux, else
// from the map; the density is that of the mixture.
//
// Compensated sampling is for light samples that are combined with BSDF samples by MIS: it covers only the radiance
// above the mean, which BSDF samples find badly. Its density is 0 elsewhere, and everywhere in an environment that is
// nearly uniform.                                                                                [Karlik et al. 2019]
#pragma once
#include <optional>
#include <vector>

#include "base/piecewise_constant.h"
#include "base/vec.h"
#include "light/environment.h"
#include "light/sampling/sun_cone.h"

namespace etendue {

struct TexelPatch;

class EnvironmentMap {
 public:
  EnvironmentMap() = default;
  explicit EnvironmentMap(const Environment& environment);

  bool black() const { return environment_.black(); }
  // Whether camera rays that leave the scene see anything: the environment, or the backdrop in its place.
  bool visible() const { return environment_.visible || environment_.backdrop; }
  // Null: the colours determine the spectra.
  const EmissionSpectrum* spectrum() const { return environment_.spectrum.spectrum.get(); }
  // cd/m^2, from a unit direction.
  Rgb radiance(const Vec3& direction) const;
  // The radiance from a direction and the density of sampling it, for less than the sum of their costs.
  struct Value {
    Rgb radiance;
    float pdf_solid_angle;
  };
  Value value(const Vec3& direction, bool compensated = false) const;
  // What camera rays see: the environment, or the backdrop. The backdrop is a grey gradient from below to above. It has
  // 12 to 36 % of the radiance of a white diffuse surface that faces the light of this environment, times its brightness,
  // and emits no light.
  Rgb seen_radiance(const Vec3& direction) const;
  const EmissionSpectrum* seen_spectrum() const { return shows_backdrop() ? nullptr : spectrum(); }
  bool shows_backdrop() const { return !environment_.visible && environment_.backdrop; }
  struct Sample {
    Vec3 direction;
    float pdf_solid_angle;
    Rgb radiance;
  };
  Sample sample(Vec2 u, bool compensated = false) const;
  float pdf_solid_angle(const Vec3& direction, bool compensated = false) const;
  // The share of the flux that compensated sampling covers, in [0, 1]; if it is 0, there are no such samples.
  float compensated_share() const { return compensated_share_; }
  // Over the sphere.
  Rgb mean_radiance() const { return mean_; }

 private:
  Vec2 uv_of(const Vec3& direction) const;
  void prepare_map();
  void prepare_sun(const Rgb& tint);
  void prepare_densities();
  void prepare_backdrop();
  float weight(const Rgb& texel, float sine) const { return luminance(texel) * sine / largest_weight_; }
  float total_weight() const;

  // The luminance above a constant, where that is positive, and the sun.
  struct Density {
    float subtracted = 0;  // the constant, relative to the largest of the map
    Piecewise2D patches;   // between the texels of the map; empty without a map
    float sun_probability = 0;
  };
  // The densities at the corners of a patch between four texels: top left, top right, bottom left, bottom right.
  struct Corners;
  Corners corners_of(const TexelPatch& patch, float subtracted) const;
  Rgb map_radiance(const TexelPatch& patch) const;
  float map_pdf(const TexelPatch& patch, float sine, const Density& density) const;
  Piecewise2D patches_above(float subtracted) const;
  Sample sample_map(Vec2 u, const Density& density) const;
  Value map_value(const Vec3& direction, const Density& density) const;
  const Density& density_for(bool compensated) const { return compensated ? compensated_ : full_; }
  // The density of directions without a map.
  float uniform_pdf(const Density& density) const { return &density == &full_ ? 1 / (4 * kPi) : 0; }

  Environment environment_;
  std::vector<float> sines_;  // of the polar angles of the rows; empty without a map
  // Weights of texels, luminance times sine, are relative to the largest: squares of the largest float would overflow,
  // and the density does not depend on scale.
  float largest_weight_ = 1;
  std::optional<SunCone> sun_;
  Rgb mean_{0};
  Density full_, compensated_;
  float compensated_share_ = 0;
  float backdrop_white_ = 0;  // the largest luminance of a white diffuse surface, times the brightness of the backdrop
};

}  // namespace etendue
