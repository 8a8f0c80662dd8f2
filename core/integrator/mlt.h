// Metropolis light transport: Markov chains over whole paths.    thesis 9.4, (9.112)-(9.124), errata E27-E29; Veach &
// Guibas 1997; digest 8-10: S23-S29
//
// A chain goes from path to path by mutations, and stays at each for as long as its brightness asks for: it is at a
// path x with the density f(x) / b, and what it visits is the picture but for the factor b, the mean of what paths from
// nothing are worth. Chains start from such paths, chosen by what they are worth (chain_work.h).
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
      Group::markov_chain,
      "E(D|G|S)*L",
      "E.*(D|G)L|E(D|G).*L|E.*(D|G)(D|G).*L",
      Bias::consistent,
      "a mutation for each pixel and sample, about 3 rays; a path for each chain and a picture beside the film",
      "simple scenes, where samples that depend on each other are worse than others; paths that no chain starts from "
      "stay missing or spotty for long; point lights seen in mirrors by way of something that scatters: never",
      Sampling::only_splats,
      '7'};

  Number<int> chains{"chains", "Chains",          512, {1, 65536}, "Of each half of the samples, side by side",
                     "",       Scale::logarithmic};
  Number<int> candidates{
      "candidates",
      "Candidates",
      16384,
      {16, 1 << 24},
      "Pairs of walks, whose paths the chains of a half start from; more make the brightness of the picture surer",
      "",
      Scale::logarithmic};
  Number<float> bidirectional{
      "bidirectional",
      "Bidirectional",
      1,
      {0.01f, 1},
      "How often, against the others: new paths; without them chains would stay where they are"};
  Number<float> lens{"lens-perturbation", "Lens", 1, {0, 1}, "How often: the point of the picture is moved"};
  Number<float> caustic{"caustic-perturbation",
                        "Caustic",
                        1,
                        {0, 1},
                        "How often: the light's direction is turned before it meets the last surface"};
  Number<float> chain{"multi-chain", "Multi-chain", 1, {0, 1}, "How often: caustics seen in mirrors or through glass"};
  Number<float> subpath{"lens-subpath",
                        "Lens subpath",
                        1,
                        {0, 1},
                        "How often: the point of the picture is chosen anew, all parts of the picture alike"};

  auto knobs() { return std::tie(max_depth, chains, candidates, bidirectional, lens, caustic, chain, subpath); }

  std::unique_ptr<Work> begin(const Pass& pass, const Work* previous) const override;
};

}  // namespace etendue::integrator
