// Interleaved benchmark of several methods: error against a reference over time and samples.
//
// The repeats of all methods alternate (A B A B), so that changes in the load of the machine affect all methods alike.
#pragma once
#include <functional>
#include <optional>
#include <vector>

#include "bench/method_spec.h"
#include "bench/progress.h"
#include "bench/reference.h"
#include "metrics/convergence.h"

namespace etendue::bench {

// The automatic choice of an integrator, for one rendering.
struct ChosenMethod {
  render::Document document;  // with the method
  std::string reason;
  double seconds = 0;  // that the choice took
  bool interrupted = false;
};
// Chooses the method of a document by its limits. It may render in the session.
using MethodChooser =
    std::function<Result<ChosenMethod>(render::Session& session, const render::Document& document, const Progress&)>;

struct Plan {
  std::vector<MethodSpec> methods;
  double seconds = 0;    // rendering time per method and repeat; 0 is no limit
  uint32_t samples = 0;  // samples per pixel, per method and repeat; 0 is no limit. At least one limit is required
  int repeats = 1;
  uint64_t seed = 0;          // the seed of each repeat of each method is derived from it
  MethodChooser choose = {};  // for automatic methods
};

struct MethodResult {
  std::vector<std::string> choices;     // reasons of the automatic choice, one per repeat
  std::string incompatibility;          // why the method cannot render the scene; it then has no curves and no image
  metrics::MethodCurves curves;         // as measured, including the noise of the reference
  std::vector<double> rays_per_second;  // one per repeat; NaN for other renderers
  std::vector<double> startup_seconds;  // of other renderers, one per repeat; not contained in the curves
  std::vector<float> image;             // of the last repeat, linear
  // The average image of the repeats and the mean of their MSE; together they separate bias from variance.
  std::vector<double> mean_image;
  double mean_mse = 0;
  std::shared_ptr<const render::Reliability> reliability;  // of the last repeat; null while there are too few samples
};

struct Outcome {
  std::vector<MethodResult> methods;
  bool interrupted = false;
};

// Measures errors at 1, 2, 3, 4, 6, 8, 12 ... samples per pixel and at the end of each repeat; only rendering is timed.
// The time of an automatic choice counts as rendering time: it is part of the budget and of the times of the curve.
// Other renderers start again for each measurement, at 1, 2, 4, 8 ... samples; a repeat therefore takes about twice its
// budget. A renderer that fails is reported as incompatible.
// If `progress` returns false, the outcome holds the complete repeats.
Outcome run(render::Session& session, const Plan& plan, const Reference& reference, const Progress& progress);

}  // namespace etendue::bench
