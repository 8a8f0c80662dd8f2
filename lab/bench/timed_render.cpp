#include "bench/timed_render.h"

#include <algorithm>
#include <chrono>

namespace etendue::bench {
namespace {

using Clock = std::chrono::steady_clock;

double seconds_since(Clock::time_point start) { return std::chrono::duration<double>(Clock::now() - start).count(); }

}  // namespace

TimedRender::TimedRender(const render::Document& document, const std::shared_ptr<const scene::CompiledScene>& scene,
                         film::Film start, double seconds)
    : renderer_(document, scene, document.width, document.height),
      film_(start.width() > 0 ? std::move(start) : film::Film(document.width, document.height)),
      seconds_(seconds),
      initial_seconds_(seconds) {
  renderer_.begin(film_);
}

bool TimedRender::run(render::ThreadPool& workers, uint32_t target, double seconds,
                      const std::function<bool()>& keep_going) {
  const double before = seconds_, end = before + seconds;
  const auto start = Clock::now();
  bool completed = true;
  for (const uint32_t first = samples();
       samples() < target && completed && (samples() == first || !has_reached(end));) {
    completed = renderer_.advance(workers, {film_}, keep_going, counters_, keep_going);
    seconds_ = before + seconds_since(start);
  }
  return completed;
}

double TimedRender::rays_per_second() const {
  const double seconds = seconds_ - initial_seconds_;
  return seconds > 0 ? static_cast<double>(counters_.rays) / seconds : 0;
}

}  // namespace etendue::bench
