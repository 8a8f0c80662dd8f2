#include "render/frame.h"

#include <mutex>
#include <span>

namespace etendue::render {
namespace {

using Row = std::span<Rgb>;

Row row_of(Frame& frame, int y) {
  const auto width = static_cast<size_t>(frame.width);
  return {&frame.pixels[static_cast<size_t>(y) * width], width};
}

std::span<const Rgb> blocks_behind(const Frame& coarse, int y) {
  const int row = std::min(y / coarse.coarseness, coarse.height - 1);
  const auto width = static_cast<size_t>(coarse.width);
  return {&coarse.pixels[static_cast<size_t>(row) * width], width};
}

void enlarge(std::span<const Rgb> blocks, int coarseness, Row row) {
  const auto size = static_cast<size_t>(coarseness);
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

FrameMaker::FrameMaker(Workers& workers) : workers_(workers), pool_(std::make_shared<Pool>()) {}

std::shared_ptr<Frame> FrameMaker::blank(int width, int height) {
  const auto give_back = [pool = pool_](Frame* frame) {
    pool->give_back(std::move(frame->pixels));
    delete frame;
  };
  std::shared_ptr<Frame> frame(new Frame, give_back);
  frame->width = width, frame->height = height;
  frame->pixels = pool_->take(static_cast<size_t>(width) * static_cast<size_t>(height));
  return frame;
}

std::shared_ptr<const Frame> FrameMaker::coarse(const film::Film& film, int coarseness) {
  auto frame = std::make_shared<Frame>();
  frame->width = film.width(), frame->height = film.height(), frame->coarseness = coarseness;
  frame->pixels.resize(film.pixels().size());
  for (int y = 0; y < frame->height; ++y) fill_from(film, y, false, row_of(*frame, y));
  return frame;
}

std::shared_ptr<Frame> FrameMaker::enlarged(const Frame& coarse, int width, int height) {
  auto frame = blank(width, height);
  frame->coarseness = coarse.coarseness;
  workers_.for_bands(height, [&](int first, int end) {
    for (int y = first; y < end; ++y) {
      const Row row = row_of(*frame, y);
      const bool same = y > first && blocks_behind(coarse, y).data() == blocks_behind(coarse, y - 1).data();
      if (same)
        std::ranges::copy(row_of(*frame, y - 1), row.begin());
      else
        enlarge(blocks_behind(coarse, y), coarse.coarseness, row);
    }
  });
  return frame;
}

std::shared_ptr<Frame> FrameMaker::full(const film::Film& film, const Frame* coarse) {
  auto frame = blank(film.width(), film.height());
  frame->coarseness = coarse ? coarse->coarseness : 1;
  workers_.for_bands(film.height(), [&](int first, int end) {
    for (int y = first; y < end; ++y) {
      const Row row = row_of(*frame, y);
      if (coarse) enlarge(blocks_behind(*coarse, y), coarse->coarseness, row);
      fill_from(film, y, coarse != nullptr, row);
    }
  });
  return frame;
}

}  // namespace etendue::render
