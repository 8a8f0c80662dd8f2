// One document made ready for sampling, and the loops over its pixels.
#pragma once
#include <memory>

#include "film/cascades.h"
#include "film/film.h"
#include "integrator/integrator.h"
#include "render/document.h"
#include "render/tile_tails.h"
#include "render/workers.h"

namespace etendue::render {

class PassRunner {
 public:
  PassRunner(const Document& document, std::shared_ptr<const scene::CompiledScene> scene, int width, int height);

  // What samples are added to: the film, and what watches them, if anything does.
  struct Sinks {
    film::Film& film;
    TileTails* tails = nullptr;
    film::Cascades* cascades = nullptr;
  };
  // Brings every pixel of the film to `target` samples, as far as `keep_going` lets it; true if it got there. Calling
  // again goes on where it stopped: a pixel knows its samples by their number. `rays` and `paths` are added to.
  struct Counters {
    std::atomic<uint64_t> rays{0}, paths{0};
  };
  // What was begun is finished, unless `wanted` says that nobody will look at it.
  bool run(
      Workers& workers, const Sinks& sinks, uint32_t target, const std::function<bool()>& keep_going,
      Counters& counters, const std::function<bool()>& wanted = [] { return true; });

  const transport::Model& model() const { return model_; }

 private:
  // False if it was given up.
  bool tile(const Sinks& sinks, int index, uint32_t sample, const std::function<bool()>& wanted,
            Counters& counters) const;

  std::shared_ptr<const scene::CompiledScene> scene_;
  transport::Model model_;
  std::unique_ptr<Sampler> sampler_;
  std::unique_ptr<integrator::Integrator> integrator_;
  CameraRays camera_;
  film::Filter filter_;
  uint64_t seed_;
  int width_, height_;
  uint32_t prepared_ = 0;        // samples the sampler has tables for, per half
  uint32_t running_ = 0;         // the sample being drawn, plus one
  std::vector<int> open_tiles_;  // those that the running sample still has to visit
};

// Samples for which the samplers make tables at a time.
inline constexpr uint32_t kTableSamples = 64;

}  // namespace etendue::render
