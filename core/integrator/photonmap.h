// Photon mapping: photons stored before, looked up from the camera.       thesis 9.5.3, 9.5.4, (9.140)-(9.147); S36-S38
//
// Light paths are parted at the first vertex with a wide part (D_G, transport/lobe_split.h) that the camera sees, after
// any number of narrow ones (S_G):
//
//   E S_G* L                              met by the walk from the camera
//   E S_G* D_G L                   a      `direct`: all of it estimated from the global map
//   E S_G* D_G S_G+ L              c      `classic`: a by shadow rays, c from the caustics map, d by final gathering,
//   E S_G* D_G S_G* D_G (.)* L     d                 whose rays look up the global map where they arrive at D_G
//
// so that nothing is counted twice: gather rays never count a light that they meet (a, c). Where one is so short that
// the disc of a lookup would reach around the corner, a, c and d are found there as they are at the first vertex. A
// narrow gloss is lit by shadow rays and by its own rays, which share paths by multiple importance sampling.
//
// Each half of the film has photons of its own, so that its stated error knows how they fell. What it cannot know is
// bias: light is spread over the discs, lost at edges, and gathered from around curved surfaces. A map stays until
// something but the camera changes. Photons that stay are independent random numbers whatever the sampler, because a
// rendering that goes on after its first samples makes the same map again.
#pragma once
#include "integrator/method.h"
#include "integrator/photon_lookup.h"
#include "integrator/photon_walks.h"

namespace etendue::integrator {

enum class PhotonUse { direct, classic };

}  // namespace etendue::integrator

template <>
struct etendue::Options<etendue::integrator::PhotonUse> {
  static constexpr std::array<etendue::Option, 2> kOptions{
      {{"direct", "Look up what is seen"}, {"classic", "Shadow rays, caustics, final gathering"}}};
};

namespace etendue::integrator {

class PhotonMapping final : public Method<PhotonMapping> {
 public:
  static constexpr Description kDescription{
      "photonmap",
      "Photon mapping",
      "Photons stored where light arrives; the camera's walks look up how densely they lie",
      Group::two_pass,
      "E(D|G|S)*L",
      "E.*(D|G).*L",
      Bias::biased,
      "before the first samples 2 to 4 rays per photon and 32 bytes for each that is stored, twice; then 2 + 2 gather "
      "rays per sample, with a lookup for each",
      "however many samples: blurred caustics and contacts, blotches of too few photons; looked up directly also dark "
      "edges and leaks; glossy surfaces under the roughness limit see point lights only directly",
      Sampling::pictures,
      '8'};

  Choice<PhotonUse> mode{"mode", "Photons are", PhotonUse::classic,
                         "Looked up where the camera looks: fast and blotched; or where gather rays arrive"};
  Number<int> photons{"photons",
                      "Photons",
                      100'000,
                      {0, 100'000'000},
                      "That leave the lights for the global map. More: less bias and noise, more memory",
                      "",
                      Scale::logarithmic};
  Number<int> caustic_photons{"caustic-photons",
                              "Caustic photons",
                              100'000,
                              {0, 100'000'000},
                              "That leave the lights for the caustics map; only what meets something narrow stays",
                              "",
                              Scale::logarithmic};
  Number<int> nearest{"nearest",
                      "Photons in an estimate",
                      50,
                      {2, 100'000},
                      "The relative noise is one over the root of it; more: a wider disc, more blur",
                      "",
                      Scale::logarithmic};
  Number<float> beta{
      "beta",
      "Growth with photons",
      0,
      {0, 1},
      "Photons in an estimate grow as (photons / 100,000)^beta: between 0 and 1 both bias and noise fall "
      "as photons are added, at 2/3 fastest; at 0 noise stays, at 1 bias"};
  Number<float> radius{"radius",
                       "Largest radius",
                       0.1f,
                       {0, 1},
                       "No photon is taken from farther away, as a part of the scene's size; 0: no limit",
                       "",
                       Scale::logarithmic};
  Choice<photon::Kernel> kernel{"kernel", "Kernel", photon::Kernel::constant,
                                "Others weigh near photons more: sharper, noisier"};
  Number<float> roughness{"roughness",
                          "Narrow below roughness",
                          0.2f,
                          {0, 1},
                          "Glossy lobes below are followed by rays as mirrors are, others are estimated from photons"};
  Number<int> gather{"gather", "Gather rays", 2, {1, 256}, "Of each sample, from the first wide surface; classic only"};
  Number<float> near{"near",
                     "Gather again within",
                     0.02f,
                     {0, 1},
                     "Shorter gather rays look nothing up but gather again, as a part of the scene's size; more: "
                     "better corners, slower"};
  Toggle renew{"renew", "New photons for every sample", false,
               "Averages the blotches of many maps; the bias of one stays. What moves always gets new ones"};
  Number<int> roulette_start{
      "roulette-start", "Roulette from vertex", 4, {1, 64}, "Earlier ends more paths: faster, noisier"};

  auto knobs() {
    return std::tie(max_depth, mode, photons, caustic_photons, nearest, beta, radius, kernel, roughness, gather, near,
                    renew, roulette_start);
  }

  std::unique_ptr<Work> begin(const Pass& pass, const Work* previous) const final;

 private:
  transport::LobeSplit split() const { return transport::LobeSplit(roughness); }
  bool direct() const { return mode == PhotonUse::direct; }

  // In an estimate from a map of so many photons.
  NearestPhotons nearest_of(int emitted, float size) const {
    constexpr double kReference = 100'000;
    const double most = nearest * std::pow(emitted / kReference, double{beta});
    const float farthest = radius > 0 ? radius * size : kInfinity;
    return {static_cast<size_t>(std::clamp(most + 0.5, 2.0, 1e7)), sqr(farthest), kernel};
  }

  PhotonPlan plan(bool caustics) const {
    PhotonPlan plan;
    plan.photons = max_depth == 1 ? 0 : caustics ? caustic_photons : photons;
    plan.split = split();
    plan.caustics = caustics;
    plan.shortest = caustics ? 2 : 1;
    plan.longest = std::max(0, max_depth - 1);
    return plan;
  }

  class Maps;
};

}  // namespace etendue::integrator
