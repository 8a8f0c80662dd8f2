// Ward's model of glossy and brushed surfaces.                         thesis (4.295)-(4.300), items 64, 65, E23, E24
//
// The formulas are in material/ward_reflection.h. All forms are reciprocal. The original is dark at moderate angles
// (0.49 at 60 degrees for alpha = 0.1, rho_s = 1) and exceeds any bound in the last degree (1.48 at 89.9 degrees, 4.66
// at 89.99, for alpha = 0.5): the thesis calls it physically correct, which it is not (E24). Duer's form keeps more and
// grows sooner. The bounded form never exceeds rho_d + rho_s. Slopes of 0 are a mirror.
#pragma once
#include "bsdf/bsdf_model_info.h"
#include "bsdf/lobes/lambert.h"
#include "bsdf/lobes/mirror.h"
#include "bsdf/lobes/ward.h"

namespace etendue {

struct WardModel {
  static constexpr BsdfModelDescription kDescription{
      "ward", "Ward", ModelClass::phenomenological,
      "f = rho_d/pi + rho_s exp(-tan^2 (cos^2 phi/a_x^2 + sin^2 phi/a_y^2))/(4 pi a_x a_y sqrt(cos_i cos_o)), or two "
      "later forms. Reciprocal; only the bounded form conserves energy at grazing angles.",
      "normals by the Gaussian of their slopes, weight rho_s <o,h> cos_h^3 sqrt(cos_i/cos_o) of the original; what "
      "leaves "
      "below the surface is absorbed"};
  template <class Color>
  using Lobes = std::tuple<Lambert<Color>, Mirror<Color>, WardReflection<Color>>;

  Number<float> diffuse{"diffuse", "Diffuse", 0.5f, {0, 1}, "rho_d, as a factor on the base colour"};
  Triple specular{"specular", "Specular", Vec3(0.4f), {0, 1}, "rho_s"};
  Number<float> alpha_x{
      "alpha-x", "Slope along", 0.2f, {0, 1}, "Deviation of the slope along the tangent; 0 is a mirror"};
  Number<float> alpha_y{"alpha-y", "Slope across", 0.2f, {0, 1}, "Deviation of the slope across the tangent"};
  Number<float> rotation{"rotation", "Rotation", 0, {-180, 180}, "Of the two axes, counter-clockwise from the tangent",
                         "deg"};
  Choice<WardForm> form{"form", "Form", WardForm::ward, "What stands under the Gaussian"};
  auto parameters() { return std::tie(diffuse, specular, alpha_x, alpha_y, rotation, form); }

  template <class LobeSet>
  void add_lobes(const Rgb& base, LobeSet& lobes) const {
    if (diffuse > 0) lobes.add(Lambert<Rgb>{base * diffuse});
    const Rgb tint = rgb_of(specular);
    if (alpha_x < kSmoothAlpha && alpha_y < kSmoothAlpha) return lobes.add(Mirror<Rgb>{{}, tint, {}});
    WardReflection<Rgb> lobe;
    const float turn = rotation * (kPi / 180);
    lobe.tint = tint, lobe.form = form, lobe.along = Vec2(std::cos(turn), std::sin(turn));
    lobe.alpha_x = std::max(alpha_x.value, kMinAlpha), lobe.alpha_y = std::max(alpha_y.value, kMinAlpha);
    lobes.add(lobe);
  }
};

}  // namespace etendue
