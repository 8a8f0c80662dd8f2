// Short renderings of several methods, in turns, from which their errors at other times are foretold.
//
// Each goes on from where it stopped, to twice the samples, so that what the machine does meets all alike and the
// film's halves hold whole nets whenever they are looked at. Pictures of many pixels are piloted smaller: what one more
// second of samples tells of the exponent is worth more than pixels.
#pragma once
#include <functional>
#include <optional>
#include <vector>

#include "bench/method_spec.h"
#include "bench/progress.h"
#include "render/time_estimate.h"

namespace etendue::advisor {

// What a pilot has seen of its method: numbers of the small picture.
struct Pilot {
  explicit Pilot(bench::MethodSpec method_)
      : method(std::move(method_)), forecast(find_sampler(method.document.method.sampler)->independent) {}

  bench::MethodSpec method;
  film::Film film;
  uint32_t samples = 0;
  double seconds = 0;
  film::ErrorEstimate error;
  render::TimeEstimator forecast;
  struct Look {
    double seconds, rmse;
  };
  std::vector<Look> looks;
  bool given_up = false;  // it is far behind another; its pilot was cut short

  // Seconds from the beginning until the RMSE is this; nothing while that cannot be told.
  std::optional<render::Prediction> time_to(double rmse) const;
};

struct PilotPlan {
  double seconds = 1;  // of rendering, about, for each method
  double target = 0;   // RMSE, for giving up
  uint64_t seed = 0;
  int most_pixels = 40000;
};

// How a picture's numbers follow from those of the small one.
struct Enlargement {
  double seconds = 1, rmse = 1;
};

struct Pilots {
  std::vector<Pilot> pilots;
  Enlargement enlargement;
  bool interrupted = false;
};

// `publish` is told how things stand after every round.
using PilotPublisher = std::function<void(const Pilots&)>;
Pilots run_pilots(render::Session& session, const std::vector<bench::MethodSpec>& methods, const PilotPlan& plan,
                  const bench::Progress& watch, const PilotPublisher& publish = {});

}  // namespace etendue::advisor
