// Metropolis light transport in primary sample space.       Kelemen, Szirmay-Kalos, Antal, Csonka 2002; thesis 9.4
//
// A path is a function of the random numbers that it asks for. Markov chains wander through the cube of these numbers,
// where all are equally likely, and stay where the function is large: f is the luminance of everything that one sample
// of the whole picture brings. What a sample is, the form says:
//
//   path           a walk from the camera, with direct light at every vertex
//   bidirectional  a walk from either end, and every connection of them
//   multiplexed    one technique (s, t) of paths of one length, times the number of techniques and with its weight
//                  among them (Hachisuka, Kaplanyan, Dachsbacher 2014). The technique is a number like the others;
//                  the length changes with large steps alone. How often each is tried is learned (technique_law.h)
//
// Decisions of stochastic opacity, and the length, are drawn with each large step and stay as they are in between.
#pragma once
#include "integrator/method.h"
#include "transport/mis.h"

namespace etendue::integrator {

enum class PrimaryForm { path, bidirectional, multiplexed };

class Pssmlt final : public Method<Pssmlt> {
 public:
  static constexpr Description kDescription{
      "pssmlt",
      "Metropolis, primary space",
      "Markov chains through the random numbers of paths: what is bright is looked at again, a little changed. Chains "
      "have their own numbers: the sampler plays no part",
      Group::markov_chain,
      "E(D|G|S)*L",
      "E.*(D|G)L|E(D|G).*L|E.*(D|G)(D|G).*L",
      Bias::consistent,
      "one sample of its form for each mutation; numbers and splats of every chain; brightness is known from "
      "independent "
      "samples alone, and too dark until they have found what is rare and bright",
      "simple scenes, where samples of equal effort do better alone: neighbours in a chain are alike; noise in "
      "blotches "
      "that looks like structure",
      Sampling::only_splats};

  Choice<PrimaryForm> form{"form", "Form", PrimaryForm::bidirectional,
                           "What a point of primary sample space stands for"};
  Number<float> large_steps{
      "large-steps", "Large steps", 0.3f, {0.01f, 1}, "Share of the mutations that draw all numbers anew"};
  Number<float> step{"step",
                     "Largest small step",
                     1.0f / 64,
                     {1e-4f, 0.25f},
                     "How far a number moves at most; of the picture's width, too",
                     "",
                     Scale::logarithmic};
  Number<float> least_step{
      "least-step", "Smallest small step", 1.0f / 1024, {1e-6f, 0.25f}, "How far a number moves at least",
      "",           Scale::logarithmic};
  Number<int> chains{"chains",
                     "Chains",
                     4096,
                     {1, 1 << 20},
                     "Markov chains side by side in each half of the film; one for each pixel at most",
                     "",
                     Scale::logarithmic};
  Number<int> candidates{"candidates",
                         "Candidates",
                         16384,
                         {1, 1 << 24},
                         "Independent samples among which the first chains choose their starts, 16 for each pixel at "
                         "most; later ones have more",
                         "",
                         Scale::logarithmic};
  Toggle combined{"combined", "Large steps count", true,
                  "Large steps are independent samples too: both ways to a path share it by their densities"};
  Choice<transport::MisHeuristic> heuristic{"heuristic", "MIS heuristic", transport::MisHeuristic::power,
                                            "How the techniques that find a path share it"};
  Number<int> roulette_start{"roulette-start",
                             "Roulette from vertex",
                             4,
                             {1, 64},
                             "Earlier ends more paths: faster, noisier; its decisions are numbers as any other"};

  auto knobs() {
    return std::tie(max_depth, form, large_steps, step, least_step, chains, candidates, combined, heuristic,
                    roulette_start);
  }

  std::unique_ptr<Work> begin(const Pass& pass, const Work* previous) const override;
};

}  // namespace etendue::integrator

template <>
struct etendue::Options<etendue::integrator::PrimaryForm> {
  static constexpr std::array<etendue::Option, 3> kOptions{
      {{"path", "Path"}, {"bidirectional", "Bidirectional"}, {"multiplexed", "Multiplexed"}}};
};
