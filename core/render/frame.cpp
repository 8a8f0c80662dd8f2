#include "render/frame.h"

#include <mutex>
#include <span>

namespace etendue::render {
namespace {

using Row = std::span<Rgb>;

std::span<const Rgb> blocks_behind(const Frame& coarse, int y) {
  const int row = std::min(y / coarse.preview_scale, coarse.height - 1);
  const auto width = static_cast<size_t>(coarse.width);
  return std::span(*coarse.pixels).subspan(static_cast<size_t>(row) * width, width);
}

void enlarge(std::span<const Rgb> blocks, int preview_scale, Row row) {
  const auto size = static_cast<size_t>(preview_scale);
  size_t x = 0;
  for (const Rgb& block : blocks)
    for (const size_t end = std::min(x + size, row.size()); x < end; ++x) row[x] = block;
  for (; x < row.size(); ++x) row[x] = blocks.back();
}

// Pixels without samples stay as they are if there is something behind them.
void fill_from(const film::Film& film, int y, bool keep, Row row) {
  for (int x = 0; x < film.width(); ++x)
    if (!keep || film.samples(x, y) > 0) row[static_cast<size_t>(x)] = film.mean(x, y);
}

void fill_from(const film::FireflyCascades& cascades, const film::Film& film, int y, Row row) {
  for (int x = 0; x < film.width(); ++x)
    if (const uint32_t samples = film.samples(x, y); samples > 0)
      row[static_cast<size_t>(x)] = cascades.shown(x, y, samples);
}

}  // namespace

// Frames may outlive the maker: each holds the pool that its pixels go back to.
struct FrameMaker::Pool {
  static constexpr size_t kMost = 3;  // shown, waiting to be shown, being made

  std::vector<Rgb> take(size_t pixels) {
    const std::scoped_lock lock(mutex);
    // Another size will not come back.
    std::erase_if(spare, [&](const auto& s) { return s.size() != pixels; });
    if (spare.empty()) return std::vector<Rgb>(pixels);
    auto taken = std::move(spare.back());
    spare.pop_back();
    return taken;
  }

  void give_back(std::vector<Rgb>&& pixels) {
    const std::scoped_lock lock(mutex);
    if (spare.size() < kMost) spare.push_back(std::move(pixels));
  }

  std::mutex mutex;
  std::vector<std::vector<Rgb>> spare;
};

// A frame while it is painted.
struct FrameMaker::Canvas {
  std::shared_ptr<Frame> frame;
  std::vector<Rgb>* pixels;  // the frame's

  Row row(int y) const {
    const auto width = static_cast<size_t>(frame->width);
    return std::span(*pixels).subspan(static_cast<size_t>(y) * width, width);
  }
};

FrameMaker::FrameMaker(ThreadPool& workers) : workers_(workers), pool_(std::make_shared<Pool>()) {}

FrameMaker::Canvas FrameMaker::blank(int width, int height) {
  const auto give_back = [pool = pool_](std::vector<Rgb>* pixels) {
    pool->give_back(std::move(*pixels));
    delete pixels;
  };
  auto taken =
      std::make_unique<std::vector<Rgb>>(pool_->take(static_cast<size_t>(width) * static_cast<size_t>(height)));
  const std::shared_ptr<std::vector<Rgb>> pixels(taken.release(), give_back);
  auto frame = std::make_shared<Frame>();
  frame->width = width, frame->height = height, frame->pixels = pixels;
  return {std::move(frame), pixels.get()};
}

std::shared_ptr<const Frame> FrameMaker::coarse(const film::Film& film, int preview_scale) {
  auto frame = std::make_shared<Frame>();
  auto pixels = std::make_shared<std::vector<Rgb>>(film.pixels().size());
  frame->width = film.width(), frame->height = film.height(), frame->preview_scale = preview_scale,
  frame->pixels = pixels;
  const Canvas canvas{frame, pixels.get()};
  for (int y = 0; y < frame->height; ++y) fill_from(film, y, false, canvas.row(y));
  return frame;
}

std::shared_ptr<Frame> FrameMaker::enlarged(const Frame& coarse, int width, int height) {
  const Canvas canvas = blank(width, height);
  canvas.frame->preview_scale = coarse.preview_scale;
  workers_.for_bands(height, [&](int first, int end) {
    for (int y = first; y < end; ++y) {
      const bool same = y > first && blocks_behind(coarse, y).data() == blocks_behind(coarse, y - 1).data();
      if (same)
        std::ranges::copy(canvas.row(y - 1), canvas.row(y).begin());
      else
        enlarge(blocks_behind(coarse, y), coarse.preview_scale, canvas.row(y));
    }
  });
  return canvas.frame;
}

std::shared_ptr<Frame> FrameMaker::full(const film::Film& film, const Frame* coarse,
                                        const film::FireflyCascades* cascades) {
  const Canvas canvas = blank(film.width(), film.height());
  canvas.frame->preview_scale = coarse ? coarse->preview_scale : 1;
  workers_.for_bands(film.height(), [&](int first, int end) {
    for (int y = first; y < end; ++y) {
      if (coarse) enlarge(blocks_behind(*coarse, y), coarse->preview_scale, canvas.row(y));
      fill_from(film, y, coarse != nullptr, canvas.row(y));
      if (cascades) fill_from(*cascades, film, y, canvas.row(y));
    }
  });
  return canvas.frame;
}

}  // namespace etendue::render
