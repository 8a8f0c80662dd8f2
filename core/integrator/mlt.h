// Metropolis light transport: Markov chains over whole paths.    thesis 9.4, (9.112)-(9.124), errata E27-E29; Veach &
// Guibas 1997; digest 8-10: S23-S29
//
// A chain goes from path to path by mutations, and stays at each for as long as its brightness asks for: it is at a
// path x with the density f(x) / b, and what it visits is the picture but for the factor b. That is the mean of what
// paths from nothing are worth, and chains start from such paths, chosen by what they are worth: without any start-up
// bias (Veach & Guibas 1997, 4.1). Chains are started anew whenever the number of samples has doubled, from ever more
// candidates, so that b converges as well.
//
// What a step of a chain may do is counted in full, both the path it is at and the one it may go to (expected values).
#pragma once
#include "integrator/method.h"

namespace etendue::integrator {

class Mlt final : public Method<Mlt> {
 public:
  static constexpr Description kDescription{
      "mlt",
      "Metropolis light transport",
      "Markov chains over whole paths, which change by bidirectional mutations and by perturbations of the lens, of "
      "caustics and of chains of them",
      "E(D|G|S)*L",
      "E.*(D|G)L|E(D|G).*L|E.*(D|G)(D|G).*L",
      Bias::unbiased,
      "a mutation for each pixel and sample, about 3 rays; a path for each chain and a picture beside the film",
      "simple scenes, where samples that depend on each other are worse than others; paths that no chain starts from "
      "stay missing or spotty for long; point lights seen in mirrors by way of something that scatters: never",
      Sampling::only_splats};

  Number<int> chains{"chains", "Chains", 128, {1, 65536}, "Side by side, for each half of the samples"};
  Number<int> candidates{"candidates",
                         "Candidates",
                         8192,
                         {16, 1 << 24},
                         "Paths from nothing, at least, from which the chains are chosen; more make the brightness of "
                         "the whole picture surer"};
  Number<float> bidirectional{
      "bidirectional",
      "Bidirectional mutations",
      1,
      {0.01f, 1},
      "How often, against the others: new paths; without them chains would stay where they are"};
  Number<float> lens{
      "lens-perturbation", "Lens perturbations", 1, {0, 1}, "How often: the point of the picture is moved"};
  Number<float> caustic{"caustic-perturbation",
                        "Caustic perturbations",
                        1,
                        {0, 1},
                        "How often: the light's direction is turned before it meets the last surface"};
  Number<float> chain{
      "multi-chain", "Multi-chain perturbations", 1, {0, 1}, "How often: caustics seen in mirrors or through glass"};
  Number<float> subpath{"lens-subpath",
                        "Lens subpath mutations",
                        1,
                        {0, 1},
                        "How often: the point of the picture is chosen anew, all parts of the picture alike"};

  auto knobs() { return std::tie(max_depth, chains, candidates, bidirectional, lens, caustic, chain, subpath); }

  std::unique_ptr<Work> begin(const Pass& pass, const Work* previous) const override;
};

}  // namespace etendue::integrator
