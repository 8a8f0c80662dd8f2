// The registry of diffusion profiles, and the subsurface scattering of a material.
//
// A profile is a class with
//
//   float value(r) const            density of light that leaves at the distance r from its entry, 1/m^2, integral 1
//   float sample_radius(u) const    a distance with this density
//   float largest_radius() const    the distance beyond which light is neglected, m
//
// and a constructor that `make_profile` calls.
#pragma once
#include <variant>

#include "bsdf/diffusion/dipole_diffusion.h"
#include "bsdf/diffusion/normalized_diffusion.h"

namespace etendue {

// One line each.
// clang-format off
using DiffusionProfile = std::variant<
    NormalizedDiffusion,
    DipoleDiffusion>;
// clang-format on

// The position in the registry.
template <class Profile, size_t index = 0>
constexpr uint8_t profile_index() {
  if constexpr (std::is_same_v<Profile, std::variant_alternative_t<index, DiffusionProfile>>)
    return index;
  else
    return profile_index<Profile, index + 1>();
}

struct Subsurface {
  uint8_t profile = 0;
  Rgb mean_free_path{0};     // below the surface, m; 0 if light leaves where it arrived
  float mismatch = 1;        // of the boundary (dipole_diffusion.h)
  float albedo_scale = kPi;  // the albedo over the value of the lobe for directions along the normal
};

template <class Profile>
Profile make_profile(const Subsurface& material, float mean_free_path, float albedo) {
  if constexpr (std::is_constructible_v<Profile, float, float, float>)
    return {mean_free_path, albedo, material.mismatch};
  else
    return {mean_free_path, albedo};
}

// Calls use.operator()<Profile>() with the profile of the material.
template <size_t index = 0, class Use>
void with_profile_type(const Subsurface& material, const Use& use) {
  if constexpr (index < std::variant_size_v<DiffusionProfile>) {
    if (material.profile == index)
      use.template operator()<std::variant_alternative_t<index, DiffusionProfile>>();
    else
      with_profile_type<index + 1>(material, use);
  }
}

}  // namespace etendue
