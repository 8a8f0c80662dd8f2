// Phong's lobe without the cosine that made it depend on who looks at whom.              thesis (4.235), item 54
//
//   f = rho_d / pi + rho_s cos^n(theta_ro)
//
// Reciprocal. Not normalised: its albedo exceeds one where rho_d + 2 pi rho_s / (n + 2) does (2.09 for rho_s = n = 1).
#pragma once
#include "material/cosine_power.h"
#include "material/lambert.h"
#include "material/model_description.h"

namespace etendue {

struct ReciprocalPhongModel {
  static constexpr ModelDescription kDescription{
      "reciprocal-phong", "Phong, reciprocal", ModelClass::phenomenological,
      "f = rho_d/pi + rho_s cos^n about the mirrored direction. Reciprocal; conserves energy only where rho_d + 2 pi "
      "rho_s/(n + 2) is at most 1.",
      "by cos^n about the mirrored direction; what falls below the surface is absorbed"};
  template <class Color>
  using Lobes = std::tuple<Lambert<Color>, CosinePower<Color>>;

  Number<float> diffuse{"diffuse", "Diffuse", 0.5f, {0, 1}, "rho_d, as a factor on the base colour"};
  Triple specular{"specular", "Specular", Vec3(0.3f), {0, 1}, "rho_s: the height of the lobe, in 1/sr"};
  Number<float> exponent{"exponent", "Exponent",        20, {0, 1e5f}, "n: 1 is matte, above 100 glossy",
                         "",         Scale::logarithmic};
  auto parameters() { return std::tie(diffuse, specular, exponent); }

  template <class Mix>
  void add_lobes(const Rgb& base, Mix& lobes) const {
    lobes.add(Lambert<Rgb>{base * diffuse});
    CosinePower<Rgb> lobe;
    lobe.scale = rgb_of(specular), lobe.exponent = exponent;
    lobe.albedo = average(lobe.scale) * 2 * kPi / (exponent + 2);
    lobes.add(lobe);
  }
};

}  // namespace etendue
