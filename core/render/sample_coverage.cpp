#include "render/sample_coverage.h"

#include <algorithm>
#include <numeric>
#include <tuple>

namespace etendue::render {
namespace {

bool have_common_pixels(const PixelRect& a, const PixelRect& b) {
  return a.x < b.right() && b.x < a.right() && a.y < b.bottom() && b.y < a.bottom();
}

bool contains(const PixelRect& rect, int x, int y) {
  return x >= rect.x && x < rect.right() && y >= rect.y && y < rect.bottom();
}

int64_t area(const PixelRect& rect) { return int64_t{rect.width} * rect.height; }

template <class T>
void sort_unique(std::vector<T>& values) {
  std::ranges::sort(values);
  values.erase(std::unique(values.begin(), values.end()), values.end());
}

// The pixels of an image that no rectangle contains. The boundaries of the rectangles divide the image into cells.
std::vector<PixelRect> uncovered(const std::vector<PixelRect>& rects, int width, int height) {
  int64_t covered = 0;
  for (const PixelRect& r : rects) covered += area(r);
  if (covered == int64_t{width} * height) return {};
  if (rects.empty()) return {{0, 0, width, height}};
  std::vector<int> columns{0, width}, rows{0, height};
  for (const PixelRect& r : rects) {
    columns.insert(columns.end(), {r.x, r.right()});
    rows.insert(rows.end(), {r.y, r.bottom()});
  }
  sort_unique(columns);
  sort_unique(rows);
  std::vector<PixelRect> gaps;
  for (size_t j = 0; j + 1 < rows.size(); ++j)
    for (size_t i = 0; i + 1 < columns.size(); ++i) {
      const int x = columns[i], y = rows[j], w = columns[i + 1] - x, h = rows[j + 1] - y;
      if (std::ranges::any_of(rects, [&](const PixelRect& r) { return contains(r, x, y); })) continue;
      if (!gaps.empty() && gaps.back().y == y && gaps.back().right() == x)
        gaps.back().width += w;
      else
        gaps.push_back({x, y, w, h});
    }
  return gaps;
}

}  // namespace

bool is_inside(const PixelRect& rect, int width, int height) {
  return rect.x >= 0 && rect.y >= 0 && rect.width > 0 && rect.height > 0 && rect.width <= width - rect.x &&
         rect.height <= height - rect.y;
}

std::string text_of(const SampleBox& block, int width, int height) {
  const PixelRect& p = block.pixels;
  std::string text = "samples " + std::to_string(block.first) + ":" + std::to_string(block.end);
  if (p == PixelRect{0, 0, width, height}) return text;
  return text + " of region " + std::to_string(p.x) + "," + std::to_string(p.y) + "," + std::to_string(p.width) + "," +
         std::to_string(p.height);
}

std::optional<std::pair<size_t, size_t>> find_overlap(std::span<const SampleBox> blocks) {
  std::vector<size_t> order(blocks.size());
  std::iota(order.begin(), order.end(), size_t{0});
  std::ranges::stable_sort(order, {}, [&](size_t i) { return blocks[i].first; });
  for (size_t i = 0; i < order.size(); ++i)
    for (size_t j = i + 1; j < order.size() && blocks[order[j]].first < blocks[order[i]].end; ++j)
      if (have_common_pixels(blocks[order[i]].pixels, blocks[order[j]].pixels)) return std::pair(order[i], order[j]);
  return std::nullopt;
}

std::vector<SampleBox> find_gaps(std::span<const SampleBox> blocks, int width, int height, uint32_t end, size_t most) {
  std::vector<uint32_t> bounds{0, end};
  for (const SampleBox& b : blocks) bounds.insert(bounds.end(), {std::min(b.first, end), std::min(b.end, end)});
  sort_unique(bounds);
  std::vector<SampleBox> gaps;
  for (size_t i = 0; i + 1 < bounds.size(); ++i) {
    std::vector<PixelRect> present;
    for (const SampleBox& b : blocks)
      if (b.first <= bounds[i] && bounds[i] < b.end) present.push_back(b.pixels);
    for (const PixelRect& rect : uncovered(present, width, height)) {
      const auto before =
          std::ranges::find_if(gaps, [&](const SampleBox& gap) { return gap.end == bounds[i] && gap.pixels == rect; });
      if (before != gaps.end())
        before->end = bounds[i + 1];
      else if (gaps.size() < most)
        gaps.push_back({bounds[i], bounds[i + 1], rect});
    }
  }
  return gaps;
}

std::vector<SampleBox> joined(std::vector<SampleBox> blocks) {
  std::ranges::sort(blocks, {}, [](const SampleBox& b) {
    return std::tuple(b.pixels.y, b.pixels.x, b.pixels.height, b.pixels.width, b.first);
  });
  std::vector<SampleBox> result;
  for (const SampleBox& block : blocks) {
    if (!result.empty() && result.back().pixels == block.pixels && result.back().end == block.first)
      result.back().end = block.end;
    else
      result.push_back(block);
  }
  return result;
}

}  // namespace etendue::render
