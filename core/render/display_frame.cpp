#include "render/display_frame.h"

#include <algorithm>
#include <mutex>
#include <span>

namespace etendue::render {
namespace {

using Row = std::span<Rgb>;

// The row of preview pixels that covers row y of the image.
std::span<const Rgb> preview_row(const Frame& preview, int y) {
  const int row = std::min(y / preview.preview_scale, preview.height - 1);
  const auto width = static_cast<size_t>(preview.width);
  return std::span(*preview.pixels).subspan(static_cast<size_t>(row) * width, width);
}

void enlarge(std::span<const Rgb> blocks, int preview_scale, Row row) {
  const auto size = static_cast<size_t>(preview_scale);
  size_t x = 0;
  for (const Rgb& block : blocks) {
    const size_t end = std::min(x + size, row.size());
    while (x < end) row[x++] = block;
  }
  while (x < row.size()) row[x++] = blocks.back();
}

// With `keep_unsampled`, pixels without samples keep their values.
void fill_with_means(const film::Film& film, int y, bool keep_unsampled, Row row) {
  for (int x = 0; x < film.width(); ++x)
    if (!keep_unsampled || film.samples(x, y) > 0) row[static_cast<size_t>(x)] = film.mean(x, y);
}

void fill_reweighted(const film::FireflyReweighting& reweighting, const film::Film& film, int y, Row row) {
  for (int x = 0; x < film.width(); ++x)
    if (const uint32_t samples = film.samples(x, y); samples > 0)
      row[static_cast<size_t>(x)] = reweighting.displayed(x, y, samples);
}

}  // namespace

// Pixel arrays for reuse. Frames may outlive the FrameMaker, so each of them holds the pool that its array returns to.
struct FrameMaker::Pool {
  static constexpr size_t kLargestSize = 3;  // a frame on screen, one waiting, one in the making

  std::vector<Rgb> take(size_t pixels) {
    const std::scoped_lock lock(mutex);
    // Arrays of a former image size are not needed again.
    std::erase_if(spare, [&](const auto& s) { return s.size() != pixels; });
    if (spare.empty()) return std::vector<Rgb>(pixels);
    auto taken = std::move(spare.back());
    spare.pop_back();
    return taken;
  }

  void give_back(std::vector<Rgb>&& pixels) {
    const std::scoped_lock lock(mutex);
    if (spare.size() < kLargestSize) spare.push_back(std::move(pixels));
  }

  std::mutex mutex;
  std::vector<std::vector<Rgb>> spare;
};

// A frame whose pixels are being written.
struct FrameMaker::Canvas {
  std::shared_ptr<Frame> frame;
  std::vector<Rgb>* pixels;  // of the frame

  Row row(int y) const {
    const auto width = static_cast<size_t>(frame->width);
    return std::span(*pixels).subspan(static_cast<size_t>(y) * width, width);
  }
};

FrameMaker::FrameMaker(ThreadPool& workers) : workers_(workers), pool_(std::make_shared<Pool>()) {}

FrameMaker::Canvas FrameMaker::new_canvas(int width, int height) {
  const auto give_back = [pool = pool_](std::vector<Rgb>* pixels) {
    pool->give_back(std::move(*pixels));
    delete pixels;
  };
  auto taken =
      std::make_unique<std::vector<Rgb>>(pool_->take(static_cast<size_t>(width) * static_cast<size_t>(height)));
  const std::shared_ptr<std::vector<Rgb>> pixels(taken.release(), give_back);
  auto frame = std::make_shared<Frame>();
  frame->width = width;
  frame->height = height;
  frame->pixels = pixels;
  return {std::move(frame), pixels.get()};
}

std::shared_ptr<const Frame> FrameMaker::preview(const film::Film& film, int preview_scale) {
  auto frame = std::make_shared<Frame>();
  auto pixels = std::make_shared<std::vector<Rgb>>(film.pixels().size());
  frame->width = film.width();
  frame->height = film.height();
  frame->preview_scale = preview_scale;
  frame->pixels = pixels;
  const Canvas canvas{frame, pixels.get()};
  for (int y = 0; y < frame->height; ++y) fill_with_means(film, y, false, canvas.row(y));
  return frame;
}

std::shared_ptr<Frame> FrameMaker::enlarged(const Frame& preview, int width, int height) {
  const Canvas canvas = new_canvas(width, height);
  canvas.frame->preview_scale = preview.preview_scale;
  workers_.run_ranges(height, [&](int first, int end) {
    for (int y = first; y < end; ++y) {
      const bool repeats = y > first && preview_row(preview, y).data() == preview_row(preview, y - 1).data();
      if (repeats)
        std::ranges::copy(canvas.row(y - 1), canvas.row(y).begin());
      else
        enlarge(preview_row(preview, y), preview.preview_scale, canvas.row(y));
    }
  });
  return canvas.frame;
}

std::shared_ptr<Frame> FrameMaker::full(const film::Film& film, const Frame* preview,
                                        const film::FireflyReweighting* reweighting) {
  const Canvas canvas = new_canvas(film.width(), film.height());
  canvas.frame->preview_scale = preview ? preview->preview_scale : 1;
  workers_.run_ranges(film.height(), [&](int first, int end) {
    for (int y = first; y < end; ++y) {
      if (preview) enlarge(preview_row(*preview, y), preview->preview_scale, canvas.row(y));
      fill_with_means(film, y, preview != nullptr, canvas.row(y));
      if (reweighting) fill_reweighted(*reweighting, film, y, canvas.row(y));
    }
  });
  return canvas.frame;
}

}  // namespace etendue::render
