// Frames: images for display, and how they are made from films.
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
  // Linear radiance, row by row from the top. Frames that differ only in version or sample count share their pixels.
  std::shared_ptr<const std::vector<Rgb>> pixels;
  uint64_t version = 0;
  uint32_t samples = 0;   // complete samples of every pixel; 0 while a preview is visible
  int preview_scale = 1;  // size in pixels of the blocks of a preview; 1 is full resolution
};

// Makes frames on all workers. The pixel arrays of released frames are reused, because allocating fresh memory takes
// longer than filling it.
class FrameMaker {
 public:
  explicit FrameMaker(ThreadPool& workers);

  // The preview in a film of 1 / preview_scale of the image's size, with one pixel per block.
  std::shared_ptr<const Frame> preview(const film::Film& film, int preview_scale);
  // A preview enlarged to the size of the image.
  std::shared_ptr<Frame> enlarged(const Frame& preview, int width, int height);
  // The means of a film. Pixels without samples show the preview, or are black if it is null. The means are re-weighted
  // if there are firefly reweighting.
  std::shared_ptr<Frame> full(const film::Film& film, const Frame* preview,
                              const film::FireflyReweighting* reweighting);

 private:
  struct Pool;
  struct Canvas;
  Canvas new_canvas(int width, int height);

  ThreadPool& workers_;
  std::shared_ptr<Pool> pool_;
};

}  // namespace etendue::render
