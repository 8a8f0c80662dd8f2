#include "advisor/pilot.h"

#include <algorithm>
#include <cmath>

#include "advisor/reference_integrator.h"
#include "render/clock.h"

namespace etendue::advisor {
namespace {

// A pilot is abandoned if its earliest predicted time exceeds the latest one of the best method by this factor ...
constexpr double kAbandonRatio = 3;
// ... and it has at least this many samples; error estimates from fewer samples are too uncertain.
constexpr uint32_t kMinSamples = 8;
// Seconds that a rendering gets at least.
constexpr double kShortest = 0.01;
// The number of samples from which on adaptive sampling converges at a steady rate.
constexpr uint32_t kAdaptiveSteady = 32;

class Runner {
 public:
  Runner(render::Session& session, const PilotPlan& plan, const bench::Progress& progress,
         const PilotPublisher& publish)
      : session_(session), plan_(plan), progress_(progress), publish_(publish) {}

  Pilots run(const std::vector<bench::MethodSpec>& methods) {
    for (const auto& method : methods) {
      Pilot& pilot = all_.pilots.emplace_back(method);
      pilot.method.document = limited_to(method.document, plan_.max_pixels);
      pilot.method.document.seed = plan_.seed;
    }
    const bool completed = compare_sizes(methods) && run_rounds();
    all_.interrupted = !completed && !is_out_of_time();
    return std::move(all_);
  }

 private:
  // Renders two samples per pixel, one per half-buffer, in both sizes. Returns false if interrupted.
  bool compare_sizes(const std::vector<bench::MethodSpec>& methods) {
    if (methods.empty()) return true;
    const render::Document large = with_reference_integrator(methods[0].document);
    const render::Document small = limited_to(large, plan_.max_pixels);
    if (small.width == large.width) return true;
    Pilot at_large({"", large}), at_small({"", small});
    if (!advance(at_small, 2) || !advance(at_large, 2)) return false;
    all_.size_ratio.seconds = at_large.seconds / at_small.seconds;
    if (at_small.error.value > 0) all_.size_ratio.error = at_large.error.value / at_small.error.value;
    return true;
  }

  // Returns false if interrupted.
  bool run_rounds() {
    for (uint32_t samples = 2;; samples *= 2) {
      bool any = false;
      for (Pilot& pilot : all_.pilots) {
        if (is_done(pilot)) continue;
        any = true;
        if (!advance(pilot, samples)) return false;
      }
      if (!any) return true;
      abandon_slow_pilots();
      if (publish_) publish_(all_);
    }
  }

  bool is_out_of_time() const { return plan_.total_seconds > 0 && render::seconds_since(start_) > plan_.total_seconds; }

  // The next round takes as long as all previous ones together, so a pilot ends once half of its time is used.
  bool is_done(const Pilot& pilot) const {
    const bool reached = pilot.error.known && pilot.error.interval.high * all_.size_ratio.error <= plan_.target;
    return pilot.abandoned || reached || pilot.seconds >= 0.5 * plan_.seconds;
  }

  bool advance(Pilot& pilot, uint32_t samples) {
    render::Document d = pilot.method.document;
    // At least the first two samples are complete, because an error needs both half-buffers.
    const bool is_first = pilot.samples < film::kHalfBuffers;
    d.limits = {samples, is_first ? 0 : std::max(kShortest, plan_.seconds - pilot.seconds), 0};
    const uint64_t version = pilot.samples > 0 ? session_.submit(d, std::move(pilot.film)) : session_.submit(d);
    const auto keep_going = [&](const render::Status& s) {
      return progress_(done(s.seconds), pilot.method.name) && !is_out_of_time();
    };
    const bool completed = bench::wait_for(session_, version, keep_going);
    const auto status = session_.status();
    pilot.film = session_.film_copy();
    pilot.seconds += status.seconds;
    total_seconds_ += status.seconds;
    pilot.samples = status.samples;
    if (pilot.samples < samples)
      return completed;  // out of time; half a digital net says less than the measurement before
    pilot.error = film::measured_error(pilot.film, plan_.measure, d.display.transform());
    // The error drops when adaptive sampling starts; that drop must not enter the predicted convergence rate.
    if (d.method.adaptive == render::Adaptive::off || pilot.samples >= kAdaptiveSteady)
      pilot.estimator.add(pilot.samples, pilot.seconds, pilot.error);
    if (pilot.error.known) pilot.measurements.push_back({pilot.seconds, pilot.error.value});
    return completed;
  }

  // The fraction of the planned time, with `current` seconds of the rendering in progress.
  double done(double current) const {
    return std::min(1.0, (total_seconds_ + current) / (plan_.seconds * static_cast<double>(all_.pilots.size())));
  }

  void abandon_slow_pilots() {
    const double target = plan_.target / all_.size_ratio.error;
    double best = INFINITY;
    for (const Pilot& pilot : all_.pilots)
      if (const auto time = pilot.time_to(target)) best = std::min(best, time->interval.high);
    for (Pilot& pilot : all_.pilots)
      if (const auto time = pilot.time_to(target); time && pilot.samples >= kMinSamples)
        pilot.abandoned = pilot.abandoned || time->interval.low > kAbandonRatio * best;
  }

  render::Session& session_;
  const PilotPlan& plan_;
  const bench::Progress& progress_;
  const PilotPublisher& publish_;
  render::Clock::time_point start_ = render::Clock::now();
  double total_seconds_ = 0;
  Pilots all_;
};

}  // namespace

std::optional<render::Prediction> Pilot::time_to(double target) const {
  for (const Measurement& m : measurements)
    if (m.error <= target) return render::Prediction{m.seconds, {m.seconds, m.seconds}};
  return estimator.time_to(target, 0);
}

Pilots run_pilots(render::Session& session, const std::vector<bench::MethodSpec>& methods, const PilotPlan& plan,
                  const bench::Progress& progress, const PilotPublisher& publish) {
  return Runner(session, plan, progress, publish).run(methods);
}

}  // namespace etendue::advisor
