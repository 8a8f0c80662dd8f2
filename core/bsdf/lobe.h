// What every lobe of a BSDF speaks: directions of transport, kinds of scattering, the result of sampling.
//
// Directions are local to the shading frame (z is the shading normal), unit, and point away from the surface. `eval`
// leaves the cosine out; densities are per solid angle of wi. A lobe offers
//
//   Color eval(wo, wi, TransportMode) const;
//   float pdf(wo, wi, TransportMode) const;
//   bool  sample(wo, LobeRandom, TransportMode, LobeSample<Color>&) const;    // false: absorbed
//   float weight(wo) const;                                             // about its albedo: its share when sampling
//   bool  is_delta() const;                                             // eval and pdf are zero
//   bool  has_component(ScatterType) const;                                      // eval has a part of this letter
//   Color eval_component(ScatterType, wo, wi, TransportMode) const;                  // that part; all parts together
//   are eval void  add_deltas(wo, TransportMode, DeltaSet<Color>&) const;              // those that `sample` would
//   choose from
#pragma once
#include <array>

#include "base/warp.h"

namespace etendue {

// Radiance flows from wi to wo as the camera sees it; importance the other way. They differ by eta^2 in refraction.
enum class TransportMode : uint8_t { radiance, importance };

// Heckbert's letters for a scattering event, and the side that it goes to.
enum class ScatterType : uint8_t { diffuse, glossy, specular };

// The random numbers of one sample of a lobe. The direction is that which `u` stands for under the cosine: most lobes
// want it, and it is cheaper to compute for many paths at once.
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
  Color weight{0};            // f cos / pdf, and the delta's coefficient where `delta`
  float pdf_solid_angle = 0;  // 0 where `delta`
  float eta = 1;              // eta(wi side) / eta(wo side): not 1 after refraction
  ScatterType type = ScatterType::diffuse;
  bool delta = false;
  bool transmitted = false;
};

// Every delta of a surface at once, for methods that follow each: `weight` is its coefficient, nothing was chosen.
// `probabilities` are those with which `sample` chooses them.
template <class Color>
struct DeltaSet {
  static constexpr int kMost = 4;

  std::array<LobeSample<Color>, kMost> lobes;
  std::array<float, kMost> probabilities;
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
    lobes[i] = lobe, probabilities[i] = probability;
  }
};

// The single direction that deltas take light to, on one side of the surface.
template <class Color>
struct DeltaDirection {
  Vec3 wi{0};
  Color value{0};         // the delta's coefficient
  float probability = 0;  // with which `sample` chooses it
  float eta = 1;          // as in LobeSample
};

}  // namespace etendue
