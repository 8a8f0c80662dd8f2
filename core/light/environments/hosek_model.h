// A clear sky with a sun, above a Lambertian ground that brightens it.                        [Hosek and Wilkie 2012]
//
//   L = M (1 + A exp(B / (cos theta + 0.01))) (C + D exp(E gamma) + F cos^2 gamma + G chi(H, gamma) + I sqrt(cos theta))
//   chi(g, x) = (1 + cos^2 x) / (1 + g^2 - 2 g cos x)^(3/2)
//
// theta is the angle to the zenith and gamma that to the sun. A to I and the mean M are fitted to path tracing of an
// atmosphere, for each of the components X, Y and Z: quintic Bezier curves of the cube root of the sun's elevation,
// linear in turbidity and ground albedo. The sun is that of sun.h.
//
// Limits: turbidities from 1 to 10 and suns above the horizon; dark blue of twilight is not covered.
#pragma once
#include <array>

#include "light/environments/sun.h"

namespace etendue {

inline constexpr const char* kHosekSkyName = "hosek-sky";

// The model for one position of the sun.
class HosekSky {
 public:
  explicit HosekSky(const Sky& sky);

  // cd/m^2 above the horizon, from a unit direction, without the sun itself. Negative components of linear sRGB are set
  // to zero.
  Rgb radiance(const Vec3& direction) const;
  // X, Y and Z in cd/m^2, from the cosine to the zenith, at least 0, and the angle to the sun.
  std::array<double, 3> xyz(double cos_theta, double gamma) const;

 private:
  struct Component {
    std::array<double, 9> shape{};
    double mean = 0;
  };

  Vec3 sun_;
  std::array<Component, 3> components_;
};

}  // namespace etendue
