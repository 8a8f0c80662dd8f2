// Which method to use here, for an error that is asked for, and for how long.
//
// Of every method of the registries, those that are biased, or that miss paths whose energy matters at that error, are
// taken out with the reason; the others are piloted, and ranked by the time that they are foretold to need.
#pragma once
#include <optional>
#include <string>
#include <vector>

#include "advisor/missing_paths.h"
#include "advisor/pilot.h"

namespace etendue::advisor {

struct Question {
  double target = 0;         // RMSE, above zero
  double pilot_seconds = 1;  // of rendering, about, for each method
  uint64_t seed = 0;
  TableOptions table = {};
};

struct Advice {
  bench::MethodSpec method;
  MissingPaths misses;
  bool suitable = true;
  std::string reason;  // why it is where it is, in words
  // Of a method that was piloted, in terms of the whole picture.
  uint32_t pilot_samples = 0;
  double pilot_seconds = 0;  // of the pilot's own picture, which may be smaller
  double pilot_rmse = 0;
  render::TimeEstimator::Exponent exponent{};
  std::optional<render::Prediction> time;  // of rendering until the error is reached
};

struct Ranking {
  double target = 0;
  ClassTable table;
  std::vector<Advice> methods;              // the fastest first; those that are not suitable last
  std::vector<std::string> beyond_methods;  // what no method finds, as far as that can be told
  bool interrupted = false;

  const Advice* best() const { return !methods.empty() && methods[0].time ? &methods[0] : nullptr; }
};

// What missing paths may add to the RMSE, in parts of the target: a third adds 5 % to the total.
inline constexpr double kNegligible = 1.0 / 3;

// Every integrator with every sampler, in a document's picture. What else the document's method sets stays.
std::vector<bench::MethodSpec> candidates(const render::Document& document);

// The session is used for everything and left with one of the pictures. What is told to `publish` gets better step by
// step: first the table, then the ranking.
using RankingPublisher = std::function<void(const Ranking&)>;
Ranking advise(render::Session& session, const render::Document& document, const Question& question,
               const bench::Progress& watch, const RankingPublisher& publish = {});

}  // namespace etendue::advisor
