#include "advisor/pilot.h"

#include <algorithm>
#include <cmath>

#include "advisor/reference_method.h"

namespace etendue::advisor {
namespace {

// A pilot that is so many times behind the best, at its best and the other's worst, is not worth its time.
constexpr double kHopeless = 3;
// Errors that fewer samples tell are not yet a reason to give up.
constexpr uint32_t kLeastSamples = 8;
// From here on adaptive sampling has found its ways.
constexpr uint32_t kSettled = 32;

// So many pixels at most, in the same shape.
render::Document reduced(const render::Document& document, int most_pixels) {
  const double pixels = static_cast<double>(document.width) * document.height;
  if (pixels <= most_pixels) return document;
  const double scale = std::sqrt(most_pixels / pixels);
  render::Document d = document;
  d.width = std::max(1, static_cast<int>(std::lround(document.width * scale)));
  d.height = std::max(1, static_cast<int>(std::lround(document.height * scale)));
  return d;
}

class Runner {
 public:
  Runner(render::Session& session, const PilotPlan& plan, const bench::Progress& watch, const PilotPublisher& publish)
      : session_(session), plan_(plan), watch_(watch), publish_(publish) {}

  Pilots go(const std::vector<bench::MethodSpec>& methods) {
    for (const auto& method : methods) {
      Pilot& pilot = all_.pilots.emplace_back(method);
      pilot.method.document = reduced(method.document, plan_.most_pixels);
      pilot.method.document.seed = plan_.seed;
    }
    const bool whole = compare_sizes(methods) && go_on();
    all_.interrupted = !whole;
    return std::move(all_);
  }

 private:
  // Two samples of every pixel, one for each half, in both sizes.
  bool compare_sizes(const std::vector<bench::MethodSpec>& methods) {
    if (methods.empty()) return true;
    const render::Document large = trusted(methods[0].document), small = reduced(large, plan_.most_pixels);
    if (small.width == large.width) return true;
    Pilot at_large({"", large}), at_small({"", small});
    if (!advance(at_small, 2) || !advance(at_large, 2)) return false;
    all_.enlargement.seconds = at_large.seconds / at_small.seconds;
    if (at_small.error.rmse > 0) all_.enlargement.rmse = at_large.error.rmse / at_small.error.rmse;
    return true;
  }

  bool go_on() {
    for (uint32_t samples = 2;; samples *= 2) {
      bool any = false;
      for (Pilot& pilot : all_.pilots) {
        if (is_done(pilot)) continue;
        any = true;
        if (!advance(pilot, samples)) return false;
      }
      if (!any) return true;
      give_up_the_hopeless();
      if (publish_) publish_(all_);
    }
  }

  // The next step takes as long again as everything before.
  bool is_done(const Pilot& pilot) const {
    const bool there = pilot.error.known && pilot.error.rmse_interval.high * all_.enlargement.rmse <= plan_.target;
    return pilot.given_up || there || pilot.seconds >= 0.6 * plan_.seconds;
  }

  bool advance(Pilot& pilot, uint32_t samples) {
    render::Document d = pilot.method.document;
    d.limits = {samples, 0, 0};
    const uint64_t version = pilot.samples > 0 ? session_.submit(d, std::move(pilot.film)) : session_.submit(d);
    const auto keep_going = [&](const render::Status& s) { return watch_(progress(s.seconds), pilot.method.name); };
    const bool whole = bench::wait_for(session_, version, keep_going);
    const auto status = session_.status();
    pilot.film = session_.film_copy();
    pilot.seconds += status.seconds, spent_ += status.seconds;
    pilot.samples = status.samples;
    pilot.error = pilot.film.error();
    // The fall of the error on which adaptive sampling sets in is not how it goes on.
    if (d.method.adaptive == render::Adaptive::off || pilot.samples >= kSettled)
      pilot.forecast.add(pilot.samples, pilot.seconds, pilot.error);
    if (pilot.error.known) pilot.looks.push_back({pilot.seconds, pilot.error.rmse});
    return whole;
  }

  double progress(double now) const {
    return std::min(1.0, (spent_ + now) / (plan_.seconds * static_cast<double>(all_.pilots.size())));
  }

  void give_up_the_hopeless() {
    const double target = plan_.target / all_.enlargement.rmse;
    double best = INFINITY;
    for (const Pilot& pilot : all_.pilots)
      if (const auto time = pilot.time_to(target)) best = std::min(best, time->interval.high);
    for (Pilot& pilot : all_.pilots)
      if (const auto time = pilot.time_to(target); time && pilot.samples >= kLeastSamples)
        pilot.given_up = pilot.given_up || time->interval.low > kHopeless * best;
  }

  render::Session& session_;
  const PilotPlan& plan_;
  const bench::Progress& watch_;
  const PilotPublisher& publish_;
  double spent_ = 0;
  Pilots all_;
};

}  // namespace

std::optional<render::Prediction> Pilot::time_to(double rmse) const {
  for (const Look& look : looks)
    if (look.rmse <= rmse) return render::Prediction{look.seconds, {look.seconds, look.seconds}};
  return forecast.time_to(rmse, 0);
}

Pilots run_pilots(render::Session& session, const std::vector<bench::MethodSpec>& methods, const PilotPlan& plan,
                  const bench::Progress& watch, const PilotPublisher& publish) {
  return Runner(session, plan, watch, publish).go(methods);
}

}  // namespace etendue::advisor
