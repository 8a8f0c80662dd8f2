// Recommends an integrator and a sampler for a scene and a target error, and predicts the rendering time.
//
// Methods that are biased, or that miss paths whose energy matters at the target error, are excluded with a reason. The
// others are rendered for a short time (a pilot) and ranked by the time that they are predicted to need.
#pragma once
#include <optional>
#include <string>
#include <vector>

#include "advisor/missing_paths.h"
#include "advisor/pilot.h"

namespace etendue::advisor {

struct AdviceRequest {
  double target = 0;         // error, above zero
  film::ErrorMeasure measure = film::ErrorMeasure::rmse;
  double pilot_seconds = 1;  // approximate rendering time per method
  // Approximate total time; 0 is no limit. If it is short, pilots are shorter and predictions less certain.
  double seconds = 0;
  uint64_t seed = 0;
  TableOptions table = {};
};

struct Advice {
  bench::MethodSpec method;
  MissingPaths misses;
  double missing_error = 0;  // approximate contribution of the missing paths to the error, in the measure
  bool suitable = true;
  std::string reason;  // explains the rank, or why the method is not suitable
  // Results of the pilot, if there was one.
  uint32_t pilot_samples = 0;
  double pilot_seconds = 0;  // rendering time of the pilot image, which may be smaller than the document's
  double pilot_error = 0;    // converted to the size of the document
  render::TimeEstimator::Exponent exponent{};
  std::optional<render::Prediction> time;  // rendering time until the target is reached
};

struct Ranking {
  double target = 0;
  film::ErrorMeasure measure = film::ErrorMeasure::rmse;
  ClassTable table;
  std::vector<Advice> methods;              // by predicted time; methods that are not suitable come last
  std::vector<std::string> beyond_methods;  // light that no method finds, as far as the scene reveals it
  bool interrupted = false;

  const Advice* best() const { return !methods.empty() && methods[0].time ? &methods[0] : nullptr; }
};

// Methods are suitable if missing paths contribute at most this fraction of the target error. At 1/3 they increase
// the total error by 5 %.
inline constexpr double kNegligible = 1.0 / 3;

// Every combination of integrator and sampler, with the other settings of the document.
std::vector<bench::MethodSpec> candidates(const render::Document& document);

// Ranks all candidates. All rendering takes place in `session`, which afterwards holds one of the pilot images.
// `publish` receives intermediate results: first the path class table, then rankings after each round of pilots.
// `on_plan` receives the number of pilots and the longest time that they may take, before the first one starts.
using RankingPublisher = std::function<void(const Ranking&)>;
using PlanPublisher = std::function<void(size_t pilots, double seconds)>;
Ranking advise(render::Session& session, const render::Document& document, const AdviceRequest& request,
               const bench::Progress& progress, const RankingPublisher& publish = {},
               const PlanPublisher& on_plan = {});

}  // namespace etendue::advisor
