// Samples of lights, as a receiver sees them.                                      [Lang, sec. 6.4, eq. 9.21-9.23]
#pragma once
#include <array>

#include "base/parameter.h"
#include "base/vectorize.h"
#include "light/sampling/light_receiver.h"
#include "spectrum/rgb.h"

namespace etendue {

// A triangle, sphere or disk that emits; a light without extent; the environment; media that emit (only in records).
enum class LightKind : uint8_t { triangle, placed, environment, medium };

struct LightSample {
  LightKind kind = LightKind::triangle;
  Vec3 wi{0};                  // unit direction towards the light
  float distance = kInfinity;  // m; 0 if nothing can block the light
  float pdf = 0;               // of the choice and of the sample: per solid angle, or discrete if `delta`
  bool delta = false;          // no other technique can find this light
  bool textured = false;       // `radiance` is the mean of the triangle's texture; the scene has the value at the point
  Rgb radiance{0};             // unoccluded, cd/m^2; of a delta light irradiance on a facing surface, lx
  uint32_t light = 0;
  float choice = 0;     // the probability with which the light was chosen
  Vec2 barycentric{0};  // weights of vertices 1 and 2 of a triangle; surface coordinates of a sphere or disk
};

// Receivers and the random numbers of their samples; arrays with room for whole registers.
struct LightQueries {
  Vec3LanesView from;
  const float *choice, *u0, *u1;
  size_t count;
  const float* times = nullptr;           // 0 at the opening of the shutter, 1 at its closing; null if no light moves
  const PackedNormal* normals = nullptr;  // of the receivers; null if they have none

  LightReceiver receiver(size_t i) const { return {from[i], normals ? normals[i] : PackedNormal()}; }
};

class LearnedLightChoice;

// How lights are chosen for a receiver.
//
//   one           one light, with probability proportional to its power
//   every         each light: the sum over lights [Lang, eq. 8.19, corrected]
//   tree          one light, by the light tree: proportional to a bound of its contribution at the receiver
//   automatic     `tree` or `one`, whichever suits the scene (light_selector.h), or a group of lights with learned
//                 probabilities and a light of it
//   emission_pdf  one light by power and a point uniform over its area, as `LightTable::sample_emission` does
//   emission_auto one light as by `automatic`, and a point uniform over its area
//
// All but the last two sample large triangles and spheres by solid angle. The last two are for MIS weights that need
// the densities of emission.
enum class LightStrategy : uint8_t { one, every, tree, automatic, emission_pdf, emission_auto };

// Whether points on a light, and directions of the environment, are distributed as those of emitted rays.
constexpr bool samples_as_emission(LightStrategy strategy) {
  return strategy == LightStrategy::emission_pdf || strategy == LightStrategy::emission_auto;
}

// How the lights of a receiver are sampled. BSDF samples find smooth parts of the environment well. If the light
// samples are combined with them by MIS, they cover only what exceeds the mean radiance of the environment
// [Karlik et al. 2019]; they leave out a uniform environment (EnvironmentMap).
struct LightSampling {
  LightStrategy strategy = LightStrategy::automatic;
  bool is_compensated = false;  // every direction of the environment is found by BSDF samples as well
  // Probabilities of the groups of these lights, with the same compensation, for the strategies `automatic` and
  // `emission_auto`; null: none.
  const LearnedLightChoice* learned = nullptr;

  constexpr LightSampling(LightStrategy chosen) : strategy(chosen) {}  // NOLINT: a strategy alone
  static constexpr LightSampling compensated(LightStrategy chosen) {
    LightSampling sampling(chosen);
    sampling.is_compensated = true;
    return sampling;
  }
  constexpr LightSampling with(const LearnedLightChoice* choice) const {
    LightSampling sampling(*this);
    sampling.learned = choice;
    return sampling;
  }
};

}  // namespace etendue

// `emission_pdf` and `emission_auto` are chosen by integrators, never by the user.
template <>
struct etendue::Options<etendue::LightStrategy> {
  static constexpr std::array<etendue::Option, 4> kOptions{{{"one", "One, proportional to power"},
                                                            {"every", "All"},
                                                            {"tree", "One, by the light tree"},
                                                            {"auto", "Automatic"}}};
};
