// Pictures as they are shown, and how they are made of films.
#pragma once
#include <cstdint>
#include <memory>
#include <vector>

#include "film/film.h"
#include "film/firefly_reweighting.h"
#include "render/thread_pool.h"

namespace etendue::render {

struct Frame {
  int width = 0, height = 0;
  // Linear radiance, row 0 on top. Frames that differ only in what they say of it share it.
  std::shared_ptr<const std::vector<Rgb>> pixels;
  uint64_t version = 0;
  uint32_t samples = 0;   // complete samples of every pixel; 0 while coarse parts show
  int preview_scale = 1;  // pixels are blocks of this size; 1 is full resolution
};

// Makes frames on all workers. Pixels of frames that nobody holds any more are used again: fresh memory costs more time
// than what is written into it.
class FrameMaker {
 public:
  explicit FrameMaker(ThreadPool& workers);

  // The means of a film of one sample, pixel by pixel, of a picture that is `preview_scale` times as large.
  std::shared_ptr<const Frame> coarse(const film::Film& film, int preview_scale);
  // The coarse frame as blocks.
  std::shared_ptr<Frame> enlarged(const Frame& coarse, int width, int height);
  // The means of the film where it has samples, the coarse frame's blocks (or black without one) where it has none yet.
  // With cascades the means are re-weighted.
  std::shared_ptr<Frame> full(const film::Film& film, const Frame* coarse, const film::FireflyCascades* cascades);

 private:
  struct Pool;
  struct Canvas;
  Canvas blank(int width, int height);

  ThreadPool& workers_;
  std::shared_ptr<Pool> pool_;
};

}  // namespace etendue::render
