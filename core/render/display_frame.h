// Frames: images for display, and how they are made from films.
#pragma once
#include <cstdint>
#include <functional>
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
  uint32_t samples = 0;  // complete samples of every pixel; 0 while a preview is visible
  // A preview by path tracing, because the phases of the integrator before its first pixel take long.
  bool is_substitute = false;
  int preview_scale = 1;  // size in pixels of the blocks that a preview is interpolated from; 1 is full resolution
};

// A small image that is shown enlarged until there are samples.
struct Preview {
  int width = 0, height = 0;  // blocks
  int scale = 1;              // size of a block in pixels
  // x / (1 + x) of the radiance in each channel. Blocks are interpolated in this form, so that a bright block does not
  // outshine its neighbours.
  std::vector<Rgb> blocks;
};

// Makes frames on all workers. The pixel arrays of released frames are reused, because allocating fresh memory takes
// longer than filling it. A large frame takes tens of milliseconds: it is null if `keep_going` stops it.
class FrameMaker {
 public:
  using KeepGoing = std::function<bool()>;
  explicit FrameMaker(ThreadPool& workers);

  // The preview in a film of 1 / scale of the image's size.
  static std::shared_ptr<const Preview> preview(const film::Film& film, int scale);
  // A preview enlarged to the size of the image, with interpolation between the centres of the blocks.
  std::shared_ptr<Frame> enlarged(
      const Preview& preview, int width, int height, const KeepGoing& keep_going = [] { return true; });
  // The means of a film. Pixels without samples show the preview, or are black if it is null. The means are re-weighted
  // if `reweighting` is not null.
  std::shared_ptr<Frame> full(
      const film::Film& film, const Preview* preview, const film::FireflyReweighting* reweighting,
      const KeepGoing& keep_going = [] { return true; });

 private:
  struct Pool;
  struct Canvas;
  Canvas new_canvas(int width, int height);

  ThreadPool& workers_;
  std::shared_ptr<Pool> pool_;
};

}  // namespace etendue::render
