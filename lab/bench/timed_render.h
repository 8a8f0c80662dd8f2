// A rendering that goes on in turns: a film, and a clock that runs only while it is rendered.
#pragma once
#include <functional>
#include <memory>

#include "render/renderer.h"

namespace etendue::bench {

class TimedRender {
 public:
  // Goes on from `start`, if it has a size; `seconds` is the time that was spent on it.
  TimedRender(const render::Document& document, const std::shared_ptr<const scene::CompiledScene>& scene,
              film::Film start = {}, double seconds = 0);

  // Brings all pixels to `target` samples, or as far as they come in so many seconds, but by one sample at least. False
  // if `keep_going` cut it short; the next turn then goes on in the middle of that sample.
  bool run(render::ThreadPool& workers, uint32_t target, double seconds, const std::function<bool()>& keep_going);

  // Whether one more sample would end later than half of itself past so many seconds on the clock.
  bool reached(double seconds) const { return samples() > 0 && seconds_ + 0.5 * seconds_a_sample() >= seconds; }

  uint32_t samples() const { return runner_.samples(); }  // of a pixel; on average where they are shared out adaptively
  double seconds() const { return seconds_; }             // of rendering
  double rays_per_second() const;
  const film::Film& film() const { return film_; }

 private:
  double seconds_a_sample() const { return seconds_ / samples(); }

  render::Renderer runner_;
  film::Film film_;
  render::Renderer::Counters counters_;
  double seconds_, seconds_before_;
};

}  // namespace etendue::bench
