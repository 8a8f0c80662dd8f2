// Short interleaved renderings of several methods, from which their errors at later times are predicted.
//
// In each round every method continues to twice its samples. The load of the machine thus affects all methods alike,
// and the half-buffers of the film hold complete digital nets whenever the error is measured. Large images are piloted
// at a reduced size: a longer pilot determines the convergence rate better than more pixels do.
#pragma once
#include <functional>
#include <optional>
#include <vector>

#include "bench/method_spec.h"
#include "bench/progress.h"
#include "render/time_estimate.h"

namespace etendue::advisor {

// The measurements of one method, for the reduced image.
struct Pilot {
  explicit Pilot(bench::MethodSpec method_)
      : method(std::move(method_)), estimator(find_sampler(method.document.method.sampler)->independent) {}

  bench::MethodSpec method;
  film::Film film;
  uint32_t samples = 0;
  double seconds = 0;
  film::MeasuredError error;
  render::TimeEstimator estimator;
  struct Measurement {
    double seconds, error;
  };
  std::vector<Measurement> measurements;
  bool abandoned = false;  // stopped early because another method is much faster

  // Seconds of rendering, from the first sample on, until the error is reached; nothing if it cannot be predicted yet.
  std::optional<render::Prediction> time_to(double target) const;
};

struct PilotPlan {
  double seconds = 1;        // longest rendering time per method
  double total_seconds = 0;  // longest time of all pilots, with what precedes their first samples; 0: no limit
  double target = 0;         // error; decides which methods are abandoned
  uint64_t seed = 0;
  int max_pixels = 40000;
  film::ErrorMeasure measure = film::ErrorMeasure::rmse;  // of `target`
};

// Time and error of the full-size image divided by those of the reduced image.
struct SizeRatio {
  double seconds = 1, error = 1;
};

struct Pilots {
  std::vector<Pilot> pilots;
  SizeRatio size_ratio;
  bool interrupted = false;
};

// `publish` receives the state after every round.
using PilotPublisher = std::function<void(const Pilots&)>;
Pilots run_pilots(render::Session& session, const std::vector<bench::MethodSpec>& methods, const PilotPlan& plan,
                  const bench::Progress& progress, const PilotPublisher& publish = {});

}  // namespace etendue::advisor
