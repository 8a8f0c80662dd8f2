// A rendering in time slices: a film and a clock that counts rendering time only.
#pragma once
#include <functional>
#include <memory>

#include "render/renderer.h"

namespace etendue::bench {

class TimedRender {
 public:
  // Continues `start` if it is not empty; `seconds` is the time already spent on it.
  TimedRender(const render::Document& document, const std::shared_ptr<const scene::CompiledScene>& scene,
              film::Film start = {}, double seconds = 0);

  // Renders until all pixels have `target` samples or the time slice of `seconds` has elapsed, but at least one sample
  // per pixel. Returns false if `keep_going` interrupted it; the next call then completes the unfinished sample.
  bool run(render::ThreadPool& workers, uint32_t target, double seconds, const std::function<bool()>& keep_going);

  // True if the clock would be closer to `seconds` now than after one more sample.
  bool has_reached(double seconds) const { return samples() > 0 && seconds_ + 0.5 * seconds_per_sample() >= seconds; }

  uint32_t samples() const { return renderer_.samples(); }  // per pixel; the average with adaptive sampling
  double seconds() const { return seconds_; }               // rendering time
  double rays_per_second() const;
  const film::Film& film() const { return film_; }

 private:
  double seconds_per_sample() const { return seconds_ / samples(); }

  render::Renderer renderer_;
  film::Film film_;
  render::Renderer::Counters counters_;
  double seconds_, initial_seconds_;
};

}  // namespace etendue::bench
