// One sample of every pixel, collected from splats and from the pixels' own blocks.
//
// Tasks that run in parallel each write their splats to a list of their own. The lists of a batch of tasks are merged
// in the order of the tasks, so that the sums have the same bits for any number of threads. Batches keep the lists
// short.
#pragma once
#include <span>
#include <vector>

#include "film/splats.h"
#include "integrator/pixel_block.h"
#include "render/thread_pool.h"

namespace etendue::render {

class SplatImage {
 public:
  static constexpr size_t kBatchTasks = 128;  // largest number of tasks of a batch

  SplatImage(int width, int height) : width_(width), height_(height) {}

  // Sets all pixels to black.
  void begin_sample();
  // Empties the lists for the next batch.
  void begin_batch();
  // The list of a task, numbered within its batch.
  film::Splats& list(size_t task_of_batch) { return lists_[task_of_batch]; }
  // Adds the lists of the batch to the pixels and empties them.
  void merge_batch(ThreadPool& workers);

  // Adds to the pixels of a block, which may have received splats already.
  void add(const integrator::PixelBlock& block, std::span<const Rgb> radiance);
  // Copies the pixels of a block, row by row.
  void read(const integrator::PixelBlock& block, std::span<Rgb> radiance) const;

  size_t memory() const;  // bytes

 private:
  size_t index(int x, int y) const {
    return static_cast<size_t>(y) * static_cast<size_t>(width_) + static_cast<size_t>(x);
  }

  int width_, height_;
  std::vector<Rgb> pixels_;
  std::vector<film::Splats> lists_;
};

}  // namespace etendue::render
