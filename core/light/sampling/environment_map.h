// The environment, prepared for sampling.
//
// Radiance is interpolated between texel centres, and the sampling density as well: it follows a small sun exactly, so
// that radiance over density stays bounded. A patch between four texel centres is chosen by its mean, a point in it
// by its corners. The patches at the poles reach half a texel beyond the map; points there are mirrored back.
//
// A sun is added to the map. Directions come from its disk with a probability that follows its share of the flux, else
// from the map; the density is that of the mixture.
#pragma once
#include <optional>
#include <vector>

#include "base/piecewise_constant.h"
#include "base/vec.h"
#include "light/environment.h"
#include "light/sampling/sun_cone.h"

namespace etendue {

class EnvironmentMap {
 public:
  EnvironmentMap() = default;
  explicit EnvironmentMap(const Environment& environment);

  bool black() const { return environment_.black(); }
  bool visible() const { return environment_.visible; }
  // Null: the colours determine the spectra.
  const EmissionSpectrum* spectrum() const { return environment_.spectrum.spectrum.get(); }
  // cd/m^2, from a unit direction.
  Rgb radiance(const Vec3& direction) const;
  struct Sample {
    Vec3 direction;
    float pdf_solid_angle;
  };
  Sample sample(Vec2 u) const;
  float pdf_solid_angle(const Vec3& direction) const;
  // Over the sphere.
  Rgb mean_radiance() const { return mean_; }

 private:
  Vec2 uv_of(const Vec3& direction) const;
  void prepare_map();
  void prepare_sun(const Rgb& tint);
  Rgb map_radiance(const Vec3& direction) const;
  Sample sample_map(Vec2 u) const;
  float map_pdf(const Vec3& direction) const;

  Environment environment_;
  std::vector<float> weights_;  // per texel, luminance times sine, relative to the largest; empty without a map
  Piecewise2D density_;         // of the patches between texels
  std::optional<SunCone> sun_;
  float sun_probability_ = 0;
  Rgb mean_{0};
};

}  // namespace etendue
