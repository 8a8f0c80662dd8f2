// A benchmark that runs in the background and publishes its curves while they grow.
//
// It owns a thread. The method that has used least of its budget renders next, for a third of a second or until the
// next sample count at which errors are measured; only rendering is timed. The reference is rendered in the same way,
// as long as it has had less time than all methods together. It continues the cached reference and is saved at the end.
// Each error is measured against the reference of that moment, and the error of that reference is subtracted
// immediately, so earlier points stay valid while the reference improves.
//
// Calls never block on rendering; snapshots are immutable.
#pragma once
#include <functional>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "bench/method_spec.h"
#include "bench/reference.h"
#include "render/display_frame.h"
#include "scene/forward.h"

namespace etendue::bench {

enum class Rule { equal_time, equal_samples };

struct LiveBenchmarkPlan {
  std::vector<MethodSpec> methods;  // at least one; all of the same scene, camera and size
  Rule rule = Rule::equal_time;
  double seconds = 10;                 // rendering time per method and repeat, for equal time
  uint32_t samples = 64;               // samples per pixel, per method and repeat, for equal samples
  int repeats = 5;                     // reduced if the films would exceed kMaxFilmBytes
  uint64_t seed = 0;                   // as in bench::Plan: equal repeats and sample counts give equal images
  int threads = 0;                     // 0: one per hardware thread
  std::filesystem::path cache;         // of references; empty disables it
  std::optional<Reference> reference;  // used as it is, without rendering one
  std::shared_ptr<const scene::CompiledScene> compiled;  // an earlier compilation of the scene; may be null
};

inline constexpr size_t kMaxFilmBytes = size_t{2} << 30;

// The state of one method. Image, samples, seconds and errors are those of the first repeat, which is ahead of the
// others.
struct MethodStatus {
  std::string name;
  std::string incompatibility;  // why the method cannot render the scene; it then has no curves and no image
  metrics::MethodCurves measured, corrected;  // with the noise of the reference, and after its subtraction
  // Over the repeats with at least half as many samples as the first one, from corrected curves.
  metrics::Estimate slope, slope_over_samples, efficiency;
  double rmse = 0, relmse = 0;  // zero where the error does not exceed that of the reference
  double seconds = 0, rays_per_second = 0;
  uint32_t samples = 0;
  std::shared_ptr<const render::Frame> frame;
};

struct LiveBenchmarkSnapshot {
  enum class Phase { preparing, comparing, stopped, done };
  Phase phase = Phase::preparing;
  double progress = 0;          // of all repeats, 0 to 1
  int repeat = 0, repeats = 0;  // number of repeats started, and in total
  Rule rule = Rule::equal_time;
  double seconds = 0;  // the current budgets
  uint32_t samples = 0;
  std::vector<MethodStatus> methods;
  std::shared_ptr<const render::Frame> reference;
  std::optional<metrics::ReferenceNoise> reference_noise;  // nothing if unknown
  double reference_error = 0;  // standard error of the reference, radiance; NaN if unknown
  double reference_seconds = 0;
  uint32_t reference_samples = 0;
  bool too_noisy = false;  // metrics::is_reference_too_noisy
};

class LiveBenchmark {
 public:
  // Starts immediately. `wake` is called on the benchmark's thread after each new snapshot.
  LiveBenchmark(LiveBenchmarkPlan plan, std::function<void()> wake);
  ~LiveBenchmark();
  LiveBenchmark(const LiveBenchmark&) = delete;
  LiveBenchmark& operator=(const LiveBenchmark&) = delete;

  // Interrupts rendering within a few milliseconds; all measurements are kept.
  void stop();
  // Continues after `stop`; after the end, doubles the budget first.
  void resume();

  std::shared_ptr<const LiveBenchmarkSnapshot> snapshot() const;

 private:
  class Impl;
  std::unique_ptr<Impl> impl_;
};

}  // namespace etendue::bench
