// The interface of a lobe, one term of a BSDF, and the types that evaluation and sampling exchange.
//
// Conventions
//   Directions are unit vectors in the local shading frame, whose z axis is the shading normal. Both wo and wi point
//   away from the surface. wo is the given direction, wi the sampled one. f is the BSDF in 1/sr, without the cosine.
//   Densities are per solid angle of wi, in 1/sr. A delta has no density: `eval` and `pdf` leave deltas out.
//
// A lobe is a small value type with these members; the concept LobeFor below checks them:
//
//   Color eval(wo, wi, mode)              f, and 0 for deltas
//   float pdf(wo, wi, mode)               density with which `sample` generates wi, and 0 for deltas
//   bool  sample(wo, random, mode, s)     draws s.wi; s must be default-initialised; false if the sample is absorbed
//   float sampling_weight(wo)             estimate of the directional albedo; a set of lobes selects one in proportion
//   bool  is_delta()                      `eval` and `pdf` are 0 everywhere
//   bool  has_component(type)             `eval_component(type, ...)` can differ from 0
//   Color eval_component(type, wo, wi, mode)
//                                         the part of `eval` of one scattering type; all types together sum to `eval`
//   void  add_deltas(wo, mode, deltas)    appends every delta that `sample` can generate for wo
//   float alpha()                         optional: equivalent microfacet roughness (lobe_set.h)
#pragma once
#include <array>
#include <concepts>

#include "base/warp.h"

namespace etendue {

// What a path transports, which decides the order of the arguments of f [Veach 1997, ch. 5].
//
//   radiance     wo points to the camera and wi to the light: f(wi -> wo)
//   importance   wo points to the light and wi to the camera: the adjoint, f(wo -> wi)
//
// The two differ by eta^2 where light is refracted, and for models that are not reciprocal.
enum class TransportMode : uint8_t { radiance, importance };

// The letters D, G and S of path expressions [Heckbert 1990], and V for scattering in a medium. Lobes of surfaces do not
// use `volume`.
enum class ScatterType : uint8_t { diffuse, glossy, specular, volume };

// The random numbers of one sample, uniform in [0, 1). `choice` selects a lobe, or reflection against transmission; `u`
// selects the direction. `cosine_direction` is the cosine-distributed direction of the upper hemisphere that `u` maps
// to. Most lobes use it, and computing it for many paths at once is cheaper.
struct LobeRandom {
  float choice = 0;
  Vec2 u{0};
  Vec3 cosine_direction{0, 0, 1};

  LobeRandom(float choice_, Vec2 u_) : LobeRandom(choice_, u_, square_to_cosine_hemisphere(u_)) {}
  LobeRandom(float choice_, Vec2 u_, const Vec3& direction) : choice(choice_), u(u_), cosine_direction(direction) {}
};

template <class Color>
struct LobeSample {
  Vec3 wi{0};
  Color weight{0};            // f |cos_i| / pdf; for a delta, its coefficient over the probability of selecting it
  float pdf_solid_angle = 0;  // 1/sr; 0 for a delta
  float eta = 1;              // index of refraction on the side of wi over that on the side of wo
  ScatterType type = ScatterType::diffuse;
  bool delta = false;
  bool transmitted = false;  // wi and wo lie on opposite sides
};

// All deltas of a surface for one wo. `lobes[k].weight` is the coefficient of delta k, the integral of f |cos_i| over
// it: no selection probability is divided out. `probabilities[k]` is the probability with which `sample` selects it.
template <class Color>
struct DeltaSet {
  static constexpr int kMaxCount = 4;

  std::array<LobeSample<Color>, kMaxCount> lobes;
  std::array<float, kMaxCount> probabilities;
  int count = 0;

  void add_reflection(const Vec3& wi, const Color& weight, float probability) {
    add({wi, weight, 0, 1, ScatterType::specular, true, false}, probability);
  }
  void add_transmission(const Vec3& wi, const Color& weight, float eta, float probability) {
    add({wi, weight, 0, eta, ScatterType::specular, true, true}, probability);
  }

 private:
  void add(const LobeSample<Color>& lobe, float probability) {
    const auto i = static_cast<size_t>(count++);
    lobes[i] = lobe;
    probabilities[i] = probability;
  }
};

// The direction into which the deltas of a surface scatter on one of its sides.
template <class Color>
struct DeltaDirection {
  Vec3 wi{0};
  Color value{0};         // coefficient, as in DeltaSet
  float probability = 0;  // with which `sample` selects it
  float eta = 1;          // as in LobeSample
};

// The interface described above.
template <class Lobe, class Color>
concept LobeFor = requires(const Lobe& lobe, const Vec3& w, const LobeRandom& random, TransportMode mode,
                           ScatterType type, LobeSample<Color>& s, DeltaSet<Color>& deltas) {
  { lobe.eval(w, w, mode) } -> std::same_as<Color>;
  { lobe.pdf(w, w, mode) } -> std::same_as<float>;
  { lobe.sample(w, random, mode, s) } -> std::same_as<bool>;
  { lobe.sampling_weight(w) } -> std::same_as<float>;
  { lobe.is_delta() } -> std::same_as<bool>;
  { lobe.has_component(type) } -> std::same_as<bool>;
  { lobe.eval_component(type, w, w, mode) } -> std::same_as<Color>;
  lobe.add_deltas(w, mode, deltas);
};

}  // namespace etendue
