// Instant global illumination: a few light paths for all pixels.       thesis 9.6, (9.148)-(9.158), E33; S40, S41
//                                              Keller 1997; interleaved: Keller & Heidrich 2001; bounded: Kollig &
//                                              Keller 2004
// The camera's walk follows mirrors and clear glass to the first other vertex z, where direct light is found as in path
// tracing and every virtual light (virtual_lights.h) is connected. Vertices y and z that come close make G = cos cos /
// r^2, and with it the variance, infinite. Where G is kept below a bound, what is lost is found again, if wanted, by a
// walk from z by the BSDF: at the vertex where it arrives everything is done as at z, weighed by what the bound cut
// off,
//
//   1 = min(1, bound / G)  +  max(0, 1 - bound / G)
//                    lights   walk
//
// Unbiased with the full BSDF of virtual lights, or where all surfaces are diffuse; and with no bound, or with what it
// loses found again. Pixels that share virtual lights share their error: it shows as a wrong brightness, not as noise.
#pragma once
#include "integrator/method.h"
#include "integrator/virtual_lights.h"

namespace etendue::integrator {

class InstantGlobalIllumination final : public Method<InstantGlobalIllumination> {
 public:
  static constexpr Description kDescription{
      "igi",
      "Instant global illumination",
      "Virtual point lights on a few light paths, connected to what all pixels see",
      Group::two_pass,
      "ES*[(D|G)[(D|G).*]]L",
      "ES*(D|G)[(D|G).*]L",
      Bias::biased,
      "3 + the number of virtual lights rays per sample: 2 to 4 for each light path; a few hundred bytes for each",
      "caustics and whatever shines through glass onto what is seen: black; corners: splotches, or with a bound and "
      "without compensation too dark; glossy surfaces as virtual lights are taken for matt ones unless told otherwise",
      Sampling::pictures};

  Number<int> light_paths{"light-paths",
                          "Light paths",
                          32,
                          {1, 100'000},
                          "Each leaves a few virtual lights, which every pixel is connected to",
                          "",
                          Scale::logarithmic};
  Number<int> interleave{
      "interleave",
      "Interleaved pixels",
      1,
      {1, 16},
      "The lights are dealt out to squares of so many pixels a side: faster, and the error becomes a "
      "pattern"};
  Toggle full{"full-bsdf", "Full BSDF of virtual lights", false,
              "Virtual lights scatter as their surface does; else as if it were matt"};
  Number<float> bound{"bound",
                      "Bound of G",
                      0,
                      {0, 1e9f},
                      "The largest cos cos / r^2 of a connection; 0: none. Lower: darker corners without splotches",
                      "1/m^2",
                      Scale::logarithmic};
  Toggle compensate{"compensate", "Find what the bound loses", true,
                    "By walks from the camera's vertices: no bias, noise"};
  Toggle renew{"renew", "New lights for every sample", true,
               "Else the error of the first lights stays, unless something moves"};
  Number<int> roulette_start{
      "roulette-start", "Roulette from vertex", 4, {1, 64}, "Of the camera's walk. Earlier: faster, noisier"};

  using Method::at_limit;

  auto knobs() { return std::tie(max_depth, light_paths, interleave, full, bound, compensate, renew, roulette_start); }

  std::unique_ptr<Work> begin(const Pass& pass, const Work* previous) const final;

  VirtualLightPlan plan() const {
    VirtualLightPlan plan;
    plan.subsets = interleave * interleave;
    plan.paths = (light_paths + plan.subsets - 1) / plan.subsets * plan.subsets;
    plan.lambertian = !full;
    plan.longest = max_depth > 0 ? std::max(1, max_depth - 2) : 0;
    return plan;
  }
};

}  // namespace etendue::integrator
