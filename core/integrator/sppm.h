// Progressive photon mapping: photons that are forgotten after each sample.   digest 8-10: S35, Remark 9.33
//                                             Hachisuka & Jensen 2009; in the form of Knaus & Zwicker 2011
// Each sample of the picture sends out photons of its own and estimates the light on the first wide surface that the
// camera's walk comes to, from all photons within a radius that shrinks from sample to sample:
//
//   r_i+1^2 / r_i^2 = (i + alpha) / (i + 1)
//
// The variance of a sample grows as 1 / r^2, slowly enough that the mean over samples still converges (as n^-alpha);
// its bias falls as r^2, that is as n^(alpha - 1). Hachisuka and Jensen keep a radius and photon statistics for each
// pixel and let them shrink by what was found there; here the radius follows from the sample's number alone, so that
// samples are independent and a film of means holds them. Each half of the film counts its own samples. The first
// radius follows the pixel's footprint: about so many pixels, seen over the length of the walk.
#pragma once
#include "integrator/method.h"
#include "integrator/photon_walks.h"

namespace etendue::integrator {

class ProgressivePhotonMapping final : public Method<ProgressivePhotonMapping> {
 public:
  static constexpr Description kDescription{
      "sppm",
      "Progressive photon mapping",
      "New photons for every sample, looked up within a radius that shrinks",
      Group::two_pass,
      "E(D|G|S)*L",
      "E.*(D|G).*L",
      Bias::consistent,
      "2 to 4 rays per photon and about 2 per pixel for each sample, a lookup for each pixel; 32 bytes for each photon "
      "that one sample stores, twice",
      "early samples blur, and light leaks through what is thinner than the radius; error falls as samples^-1/3 at "
      "best: slower than unbiased methods where these find the "
      "light; "
      "views of a small part of what is lit: few photons come by",
      Sampling::pictures,
      '9'};

  Number<int> photons{"photons", "Photons for a sample", 0, {0, 100'000'000}, "0: as many as pixels",
                      "",        Scale::logarithmic};
  Number<float> alpha{"alpha",
                      "Rate of shrinking",
                      2.0f / 3,
                      {0.01f, 1},
                      "Larger: the radius shrinks more slowly, noise falls faster, bias more slowly; 1: it stays"};
  Number<float> radius{"radius", "First radius",    4, {0.1f, 1000}, "As it is seen where the camera looks",
                       "px",     Scale::logarithmic};
  Toggle connect{"connect", "Direct light by shadow rays", true, "Else from photons too"};
  Number<float> roughness{"roughness",
                          "Narrow below roughness",
                          0.2f,
                          {0, 1},
                          "Glossy lobes below are followed by rays as mirrors are, others are estimated from photons"};
  Number<int> roulette_start{
      "roulette-start", "Roulette from vertex", 4, {1, 64}, "Of the camera's walk. Earlier: faster, noisier"};

  using Method::at_limit;

  auto knobs() { return std::tie(max_depth, photons, alpha, radius, connect, roughness, roulette_start); }

  std::unique_ptr<Work> begin(const Pass& pass, const Work* previous) const final;

  PhotonPlan plan(int pixels) const {
    PhotonPlan plan;
    plan.photons = max_depth == 1 ? 0 : photons > 0 ? photons : pixels;
    plan.split = transport::LobeSplit(roughness);
    plan.shortest = connect ? 2 : 1;
    plan.longest = std::max(0, max_depth - 1);
    return plan;
  }

  // The squared radius of a half's sample number `index` (from 0) over the first one.
  double shrinking(uint32_t index) const {
    double ratio = 1;
    for (uint32_t i = 1; i <= index; ++i) ratio *= (i + double{alpha}) / (i + 1.0);
    return ratio;
  }
};

}  // namespace etendue::integrator
