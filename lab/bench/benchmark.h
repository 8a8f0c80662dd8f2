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
  int threads = 0;            // of the denoiser; 0: one per hardware thread
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
  std::optional<double> khat;   // of the last repeat (film/tail.h); nothing if there is no tail
  bool has_heavy_tail = false;  // its error estimate is unreliable (render/reliability.h)
};

struct Outcome {
  std::vector<MethodResult> methods;
  bool interrupted = false;
};

// The result of one repeat of one method.
struct RepeatResult {
  size_t method = 0;
  std::string failure = {};  // why another renderer failed; the rest is then empty
  std::string choice = {};   // the reason of an automatic choice
  metrics::ErrorCurve curve = {};
  std::vector<float> image = {};
  double rays_per_second = 0;
  std::optional<double> startup_seconds = {};
  std::optional<double> khat = {};
  bool has_heavy_tail = false;
};

// The number of repeats of all methods together. They are numbered in the order in which they are rendered: the first
// repeat of each method, the second of each, and so on.
size_t unit_count(const Plan& plan);

// Builds the outcome from results in the order of their numbers.
class OutcomeBuilder {
 public:
  // `incompatibilities` has one text per method, empty for methods that can render the scene.
  OutcomeBuilder(const Plan& plan, const std::vector<std::string>& incompatibilities);
  // Methods without results are not rendered any more.
  bool is_measured(size_t method) const { return outcome_.methods[method].incompatibility.empty(); }
  void add(RepeatResult result);
  Outcome take(bool interrupted) {
    outcome_.interrupted = interrupted;
    return std::move(outcome_);
  }

 private:
  Outcome outcome_;
};

// The results of the repeats with the numbers from `first` to `end` - 1.
struct PartOutcome {
  std::vector<std::string> incompatibilities;  // one per method
  std::vector<RepeatResult> repeats;           // without those of methods that are incompatible or have failed before
  bool interrupted = false;
};
PartOutcome run_part(render::Session& session, const Plan& plan, size_t first, size_t end, const Reference& reference,
                     const Progress& progress);

// Measures errors at 1, 2, 3, 4, 6, 8, 12 ... samples per pixel and at the end of each repeat; only rendering is timed.
// The time of an automatic choice counts as rendering time: it is part of the budget and of the times of the curve.
// The time of a denoised image is that of the rendering and of one run of the denoiser; the runs for earlier points of the
// curve are not counted.
// Other renderers start again for each measurement, at 1, 2, 4, 8 ... samples; a repeat therefore takes about twice its
// budget. A renderer that fails is reported as incompatible.
// If `progress` returns false, the outcome holds the complete repeats.
Outcome run(render::Session& session, const Plan& plan, const Reference& reference, const Progress& progress);

}  // namespace etendue::bench
