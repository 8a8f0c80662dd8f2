// The automatic choice of the method of a document (render.integrator = auto).
//
// Candidates are the integrators that auto.allow permits, that support the scene and that find all of its light
// (allowed_methods.h). Integrators that miss paths of point, spot and directional lights are candidates if these paths
// carry little energy. Short pilot renderings of a reduced image compare them at equal cost (method_comparison.h); the
// winner is then compared with itself under other samplers. Pilot images are not part of the final image: they are
// smaller, and an image that was selected by its own noise would be biased.
#pragma once
#include <functional>
#include <string>
#include <vector>

#include "advisor/allowed_methods.h"
#include "advisor/method_comparison.h"
#include "base/result.h"

namespace etendue::advisor {

// The pilots may take this fraction of the time limit or, without a time limit, of the cost of all samples.
inline constexpr double kPilotFraction = 0.1;
// Without a limit on time or samples, the pilots have the budget for an image with this number of samples per pixel.
inline constexpr uint32_t kAssumedSamples = 256;

// One line of the explanation.
struct ConsideredMethod {
  std::string name;          // integrator, and the sampler if several were compared
  std::string refusal = {};  // why it was not compared; empty if it was
  uint32_t samples = 0;      // of its pilot, per pixel
  double cost = 0;           // seconds, or weighted rays
  double pilot_error = 0, predicted_error = 0;
  bool misses_light = false;
};

struct MethodChoice {
  render::MethodSettings method;
  std::string reason;                        // one sentence for people
  std::vector<ConsideredMethod> considered;  // the chosen one first
  render::MinimisedError measure = render::MinimisedError::relative;
  bool by_time = false;  // costs are seconds; otherwise they are weighted rays and the choice is reproducible
  double seconds = 0;    // that the choice took
  bool interrupted = false;
  // The pilots of the chosen method and of the best other integrator, and what they share: for a revision of the choice
  // (choice_revision.h). Fewer if there was no comparison.
  std::vector<ComparedMethod> finalists;
  int pilot_pixels = 0;
  uint64_t pilot_seed = 0;
};

struct ChoiceOptions {
  // Time for the choice; 0: kPilotFraction of the time limit, if the document has one.
  double seconds = 0;
  // The cost of a rendering: by default seconds if the time is limited, otherwise weighted rays.
  CostFunction cost = {};
  // Seconds since some moment, to measure how long the choice takes; by default the steady clock.
  std::function<double()> clock = {};
};

// Chooses the method of a document by its limits and the settings of its section "auto". All rendering takes place in
// `session`. Without a time limit, the same document gives the same choice. An input error if no integrator can be
// used. If `progress` returns false, the choice follows from what has been measured so far.
Result<MethodChoice> choose_method(render::Session& session, const render::Document& document,
                                   const bench::Progress& progress, const ChoiceOptions& options = {});

// Whether the predicted error of `a` is smaller than that of `b` by at least 5 %, also at the upper end of its confidence
// interval. Another sampler replaces the present one only then: of several equal ones, the one with the smallest error by
// chance would be chosen otherwise.
bool is_clearly_better(const ComparedMethod& a, const ComparedMethod& b);

// Methods in ascending order of their predicted errors: while the first one is a variant that is not clearly better than
// its plain form, moves it behind that. A variant spends more on each sample, and pilots may be too short to show what
// that gains.
void demote_unclear_variants(std::vector<ComparedMethod>& methods);

// The document with the chosen method and the reason.
render::Document with_choice(render::Document document, const MethodChoice& choice);

// The choice as JSON, for reports.
std::string choice_json(const MethodChoice& choice);

}  // namespace etendue::advisor
