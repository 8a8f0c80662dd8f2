#include "render/splat_image.h"

namespace etendue::render {

void SplatImage::begin_sample() { pixels_.assign(static_cast<size_t>(width_) * static_cast<size_t>(height_), Rgb(0)); }

void SplatImage::begin_batch() {
  lists_.resize(kBatchTasks);
  for (film::Splats& list : lists_) list.clear();
}

void SplatImage::merge_batch(ThreadPool& workers) {
  workers.run_ranges(height_, [&](int first, int end) { film::add_rows(lists_, width_, first, end, pixels_); });
  for (film::Splats& list : lists_) list.clear();
}

void SplatImage::add(const integrator::PixelBlock& block, std::span<const Rgb> radiance) {
  const Rgb* next = radiance.data();
  for (int y = block.y; y < block.y + block.height; ++y)
    for (int x = block.x; x < block.x + block.width; ++x) pixels_[index(x, y)] += *next++;
}

void SplatImage::read(const integrator::PixelBlock& block, std::span<Rgb> radiance) const {
  Rgb* next = radiance.data();
  for (int y = block.y; y < block.y + block.height; ++y)
    for (int x = block.x; x < block.x + block.width; ++x) *next++ = pixels_[index(x, y)];
}

size_t SplatImage::memory() const {
  size_t bytes = pixels_.capacity() * sizeof(Rgb);
  for (const film::Splats& list : lists_) bytes += list.capacity() * sizeof(film::Splat);
  return bytes;
}

}  // namespace etendue::render
