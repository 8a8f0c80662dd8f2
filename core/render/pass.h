// One document made ready for sampling, and the loops over its pixels.
#pragma once
#include <memory>

#include "film/film.h"
#include "integrator/integrator.h"
#include "render/allocation.h"
#include "render/document.h"
#include "render/tile_tails.h"
#include "render/workers.h"

namespace etendue::render {

class PassRunner {
 public:
  PassRunner(const Document& document, std::shared_ptr<const scene::CompiledScene> scene, int width, int height);

  struct Counters {
    std::atomic<uint64_t> rays{0}, paths{0};
  };
  // What samples are added to: the film, and what watches them, if anything does.
  struct Sinks {
    film::Film& film;
    TileTails* tails = nullptr;
  };
  // Takes up a film: an empty one, or one that an equal runner left.
  void begin(film::Film& film);
  // The next step, as far as `keep_going` lets it; true if it is complete: another sample of every pixel, or, in
  // adaptive sampling, a piece of the allocation. Calling again goes on where it stopped: a pixel knows its samples by
  // their number. What was begun is finished, unless `wanted` says that nobody will look at it.
  bool advance(
      Workers& workers, const Sinks& sinks, const std::function<bool()>& keep_going, Counters& counters,
      const std::function<bool()>& wanted = [] { return true; });
  // Samples of a pixel after the last complete step; in adaptive sampling on average.
  uint32_t samples() const { return samples_; }

  const transport::Model& model() const { return model_; }

 private:
  using PixelBlock = integrator::PixelBlock;
  // One task of a step.
  struct Task {
    const Sinks& sinks;
    const std::function<bool()>& wanted;
    Counters& counters;
  };

  Allocation::Piece piece() const;
  void prepare(uint32_t first_of_half);
  void finish_step(const film::Film& film);
  uint32_t average(const film::Film& film) const;
  PixelBlock block_at(size_t tile) const;
  // What the step wants of a tile; false if it was given up.
  bool visit(const Task& task, size_t tile) const;
  bool sample(const Task& task, size_t tile, const PixelBlock& block) const;
  static void note_spread(film::Film& film, size_t tile, const PixelBlock& block, std::span<const Rgb> radiance);

  std::shared_ptr<const scene::CompiledScene> scene_;
  transport::Model model_;
  std::unique_ptr<Sampler> sampler_;
  std::unique_ptr<integrator::Integrator> integrator_;
  CameraRays camera_;
  film::Filter filter_;
  uint64_t seed_;
  Adaptive adaptive_;
  int width_, height_;
  size_t tiles_ = 0;
  std::optional<Allocation> allocation_;  // in adaptive sampling
  uint32_t samples_ = 0;
  uint32_t prepared_ = 0;           // samples the sampler has tables for, per half
  std::vector<size_t> open_tiles_;  // those that the running step still has to visit; none between steps
};

// Samples for which the samplers make tables at a time.
inline constexpr uint32_t kTableSamples = 64;

}  // namespace etendue::render
