// Comparison of several methods at equal cost, with short interleaved renderings (pilots) and a budget for all of them.
//
// In each round every remaining method continues to twice its samples. Methods that are clearly worse than the best one
// end early, and when the budget does not suffice for another round of all, only the better half continues (successive
// halving [Karnin et al. 2013]). The cost is the rendering time, or any other additive number, so that a comparison can
// be repeated with the same result.
#pragma once
#include <cmath>
#include <functional>
#include <string>
#include <vector>

#include "bench/progress.h"
#include "film/error_measure.h"
#include "film/film.h"
#include "render/document.h"
#include "render/time_estimate.h"

namespace etendue::advisor {

struct ComparedMethod {
  render::MethodSettings method;
  double missing = 0;  // squared error by paths that it does not find, which does not fall
  film::Film film = {};
  std::vector<std::byte> integrator_state = {};  // as in render::ResumePoint
  uint32_t samples = 0;                          // per pixel
  double cost = 0;
  double processor_seconds = 0;         // of all threads
  film::MeasuredError error = {};       // as measured_error of minimised_error.h
  render::TimeEstimator convergence{};  // its rate, from the errors of all rounds
  double mean = 0, standard_error = 0;  // luminance of the image
  double relative_error = INFINITY;  // if FLIP is minimised, for the choice of the pilot that others are compared with
  // The squared error that more samples reduce, and the square of the bias, of the pilot image.
  double noise = 0, bias = 0;
  double predicted_error = 0;  // in the unit of `error`, at the horizon of the plan; infinite if unknown
  // It is significantly darker than another pilot, because its samples missed rare bright paths, or the paths that it
  // does not find are not negligible at the predicted error.
  bool misses_light = false;
};

// The cost of the rendering that a status describes.
using CostFunction = std::function<double(const render::Status&, const render::MethodSettings&)>;
// Rendering time in seconds.
double time_cost(const render::Status& status, const render::MethodSettings& method);
// The number of rays, weighted by the typical time per ray of the integrator (integrator_costs.h). It is the same on every machine.
double ray_cost(const render::Status& status, const render::MethodSettings& method);

struct ComparisonPlan {
  render::MinimisedError measure = render::MinimisedError::relative;
  CostFunction cost = time_cost;
  double budget = 1;  // cost of all pilots together
  // Whether a pilot ends when the budget is used up. Otherwise the first round is completed in any case, and the result
  // depends on the costs of complete pilots only.
  bool strict = true;
  // Whether costs are divided among the methods by their processor time, which depends less than the rendering time on
  // other programs that run at the same time.
  bool by_processor_time = false;
  // If positive, the budget is the cost of this number of samples of a pixel, by the cheapest method.
  double budget_samples = 0;
  double horizon = 10;         // the error is predicted for a rendering of this multiple of the budget
  uint32_t max_samples = 4096;  // per pixel
  int max_pixels = 40000;      // larger images are reduced to this size
  uint64_t seed = 0;
};

struct Comparison {
  // Those of the last round by predicted error, then those that ended earlier; methods that miss light come last.
  std::vector<ComparedMethod> methods;
  double cost = 0;  // of all pilots
  double budget = 0;
  bool interrupted = false;
};

// `methods` have their settings and their missing paths, or are pilots of an earlier comparison with the same seed and size,
// which continue. All rendering takes place in `session`. If `progress` returns
// false, the result is what has been measured so far.
Comparison compare_methods(render::Session& session, const render::Document& document,
                           std::vector<ComparedMethod> methods, const ComparisonPlan& plan,
                           const bench::Progress& progress);

}  // namespace etendue::advisor
