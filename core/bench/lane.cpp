#include "bench/lane.h"

#include <algorithm>
#include <chrono>

namespace etendue::bench {
namespace {

using Clock = std::chrono::steady_clock;

double seconds_since(Clock::time_point start) { return std::chrono::duration<double>(Clock::now() - start).count(); }

uint32_t least_samples(const film::Film& film) {
  uint32_t least = UINT32_MAX;
  for (const auto& p : film.pixels()) least = std::min(least, p.count[0] + p.count[1]);
  return least;
}

}  // namespace

Lane::Lane(const render::Document& document, const std::shared_ptr<const scene::CompiledScene>& scene, film::Film start,
           double seconds)
    : runner_(document, scene, document.width, document.height),
      film_(start.width() > 0 ? std::move(start) : film::Film(document.width, document.height)),
      samples_(least_samples(film_)),
      seconds_(seconds),
      seconds_before_(seconds) {}

bool Lane::run(render::Workers& workers, uint32_t target, double seconds, const std::function<bool()>& keep_going) {
  const double before = seconds_, end = before + seconds;
  const auto start = Clock::now();
  bool whole = true;
  for (const uint32_t first = samples_; samples_ < target && whole && (samples_ == first || !reached(end));) {
    whole = runner_.run(workers, film_, samples_ + 1, keep_going, counters_, keep_going);
    seconds_ = before + seconds_since(start);
    if (whole) ++samples_;
  }
  return whole;
}

double Lane::rays_per_second() const {
  const double seconds = seconds_ - seconds_before_;
  return seconds > 0 ? static_cast<double>(counters_.rays) / seconds : 0;
}

}  // namespace etendue::bench
