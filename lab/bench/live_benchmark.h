// Methods against each other while somebody looks on: they take turns on the machine, and their curves grow.
//
// A contest owns a thread. Whoever has used the least of the budget is next, for a third of a second or until the next
// count of samples at which errors are measured; only rendering is on its clock. The reference takes turns too, as long
// as it has had less time than all methods together: it begins with what the cache holds, and goes back there at the
// end. An error is measured against the reference as it is then, and that reference's own error is taken off at once,
// so that earlier points stay valid while the reference grows.
//
// Nothing here waits for the caller; snapshots are immutable.                            design: accuracy
#pragma once
#include <functional>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "bench/method_spec.h"
#include "bench/reference.h"
#include "render/frame.h"
#include "scene/forward.h"

namespace etendue::bench {

enum class Rule { equal_time, equal_samples };

struct LiveBenchmarkPlan {
  std::vector<MethodSpec> methods;  // one at least, of one scene, camera and size
  Rule rule = Rule::equal_time;
  double seconds = 10;          // of rendering, for each method in each repeat
  uint32_t samples = 64;        // the same for equal samples
  int repeats = 5;              // fewer if their films do not fit into memory (kMostFilmBytes)
  uint64_t seed = 0;            // as in a bench: the same repeats have the same pictures at the same number of samples
  int threads = 0;              // 0: one per hardware thread
  std::filesystem::path cache;  // of references; empty is none
  std::optional<Reference> reference;                    // one that is given stays as it is
  std::shared_ptr<const scene::CompiledScene> compiled;  // what was compiled of the scene before, if it was
};

inline constexpr size_t kMostFilmBytes = size_t{2} << 30;

// Where one method stands. Picture, samples, seconds and errors are of the first repeat, which comes furthest first.
struct Standing {
  std::string name;
  metrics::MethodCurves measured, corrected;  // with the reference's noise, and without
  // Over the repeats that have come at least half as far as the first; errors without the reference's.
  metrics::Figure slope, slope_over_samples, efficiency;
  double rmse = 0, relmse = 0;  // zero where the reference is too noisy for them
  double seconds = 0, rays_per_second = 0;
  uint32_t samples = 0;
  std::shared_ptr<const render::Frame> frame;
};

struct LiveBenchmarkSnapshot {
  enum class Phase { preparing, comparing, stopped, done };
  Phase phase = Phase::preparing;
  double progress = 0;          // of all repeats, 0 to 1
  int repeat = 0, repeats = 0;  // begun, and to be
  Rule rule = Rule::equal_time;
  double seconds = 0;  // the budgets by now
  uint32_t samples = 0;
  std::vector<Standing> methods;
  std::shared_ptr<const render::Frame> reference;
  double reference_error = 0;  // its standard error, radiance; NaN if unknown
  double reference_seconds = 0;
  uint32_t reference_samples = 0;
  bool too_noisy = false;  // its error is not ten times smaller than the smallest that was measured
};

class LiveBenchmark {
 public:
  // Begins at once. `wake` is called on the contest's thread whenever there is a new snapshot.
  LiveBenchmark(LiveBenchmarkPlan plan, std::function<void()> wake);
  ~LiveBenchmark();
  LiveBenchmark(const LiveBenchmark&) = delete;
  LiveBenchmark& operator=(const LiveBenchmark&) = delete;

  // Ends the turn within a few milliseconds; everything measured stays.
  void stop();
  // After a stop, goes on from there; after the end, to twice the budget.
  void go_on();

  std::shared_ptr<const LiveBenchmarkSnapshot> snapshot() const;

 private:
  class Impl;
  std::unique_ptr<Impl> impl_;
};

}  // namespace etendue::bench
