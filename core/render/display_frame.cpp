#include "render/display_frame.h"

#include <algorithm>
#include <cmath>
#include <mutex>
#include <optional>
#include <span>

namespace etendue::render {
namespace {

using Row = std::span<Rgb>;

Rgb compressed(const Rgb& c) {
  const auto compress = [](float x) {
    const float bounded = x > 0 ? std::min(x, 1e4f) : 0.0f;  // NaN becomes 0
    return bounded / (1 + bounded);
  };
  return Rgb(compress(c.r), compress(c.g), compress(c.b));
}

// Rows of an image, interpolated between the centres of the blocks of a preview.
class Enlarger {
 public:
  explicit Enlarger(const Preview& preview) : preview_(preview), blocks_(static_cast<size_t>(preview.width)) {}

  void fill(int y, Row row) {
    interpolate_blocks(y);
    const int scale = preview_.scale, half = scale / 2;
    // Pixels between the centres of two neighbouring blocks; before the first and after the last one it is a constant.
    for (int x = 0; x < static_cast<int>(row.size());) {
      const int block = (x + scale - half) / scale - 1;  // the block whose centre is on the left
      const int end = std::min((block + 1) * scale + half, static_cast<int>(row.size()));
      fill_between(block, x, row.subspan(static_cast<size_t>(x), static_cast<size_t>(end - x)));
      x = end;
    }
    expand(row);
  }

 private:
  const Rgb& block_at(int i) const { return blocks_[static_cast<size_t>(std::clamp(i, 0, preview_.width - 1))]; }
  float centre_of(int block) const { return (static_cast<float>(block) + 0.5f) * static_cast<float>(preview_.scale); }

  // The blocks of the two rows that row y of the image lies between.
  void interpolate_blocks(int y) {
    const float at = (static_cast<float>(y) + 0.5f) / static_cast<float>(preview_.scale) - 0.5f;
    const int above = static_cast<int>(std::floor(at));
    const float weight = at - static_cast<float>(above);
    const auto row_of = [&](int i) {
      return static_cast<size_t>(std::clamp(i, 0, preview_.height - 1)) * blocks_.size();
    };
    const Rgb *first = &preview_.blocks[row_of(above)], *second = &preview_.blocks[row_of(above + 1)];
    for (size_t i = 0; i < blocks_.size(); ++i) blocks_[i] = first[i] + (second[i] - first[i]) * weight;
  }

  // Pixels from x on, between the centres of `block` and the next one.
  void fill_between(int block, int x, Row row) const {
    const Rgb left = block_at(block);
    const Rgb step = (block_at(block + 1) - left) / static_cast<float>(preview_.scale);
    const float offset = static_cast<float>(x) + 0.5f - centre_of(block);
    for (size_t i = 0; i < row.size(); ++i) row[i] = left + step * (offset + static_cast<float>(i));
  }

  // The inverse of `compressed`, for all channels alike.
  static void expand(Row row) {
    float* values = &row[0].r;
    const size_t count = 3 * row.size();
    for (size_t i = 0; i < count; ++i) values[i] = values[i] / (1 - values[i]);
  }

  const Preview& preview_;
  std::vector<Rgb> blocks_;  // of the current row
};

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

std::shared_ptr<const Preview> FrameMaker::preview(const film::Film& film, int scale) {
  auto preview = std::make_shared<Preview>();
  preview->width = film.width();
  preview->height = film.height();
  preview->scale = scale;
  preview->blocks.reserve(film.pixels().size());
  for (int y = 0; y < film.height(); ++y)
    for (int x = 0; x < film.width(); ++x) preview->blocks.push_back(compressed(film.mean(x, y)));
  return preview;
}

std::shared_ptr<Frame> FrameMaker::enlarged(const Preview& preview, int width, int height,
                                            const KeepGoing& keep_going) {
  const Canvas canvas = new_canvas(width, height);
  canvas.frame->preview_scale = preview.scale;
  const auto fill = [&](int first, int end) {
    Enlarger enlarger(preview);
    for (int y = first; y < end; ++y) enlarger.fill(y, canvas.row(y));
  };
  return workers_.run_ranges(height, fill, keep_going) ? canvas.frame : nullptr;
}

std::shared_ptr<Frame> FrameMaker::full(const film::Film& film, const Preview* preview,
                                        const film::FireflyReweighting* reweighting, const KeepGoing& keep_going) {
  const Canvas canvas = new_canvas(film.width(), film.height());
  canvas.frame->preview_scale = preview ? preview->scale : 1;
  const auto fill = [&](int first, int end) {
    std::optional<Enlarger> enlarger;
    if (preview) enlarger.emplace(*preview);
    for (int y = first; y < end; ++y) {
      if (enlarger) enlarger->fill(y, canvas.row(y));
      fill_with_means(film, y, preview != nullptr, canvas.row(y));
      if (reweighting) fill_reweighted(*reweighting, film, y, canvas.row(y));
    }
  };
  return workers_.run_ranges(film.height(), fill, keep_going) ? canvas.frame : nullptr;
}

}  // namespace etendue::render
