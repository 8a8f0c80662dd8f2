#include "integration/looks/sheet.h"

#include <algorithm>

#include "base/file.h"
#include "integration/looks/bitmap_font.h"

namespace etendue::looks {
namespace {

constexpr int kAdvance = kGlyphAdvance, kTextHeight = kGlyphHeight + 3;
constexpr int kGap = 2;

void put(Picture& on, int x, int y, const uint8_t* rgb) {
  if (x < 0 || y < 0 || x >= on.width || y >= on.height) return;
  std::copy_n(rgb, 3, &on.rgb[(static_cast<size_t>(y) * static_cast<size_t>(on.width) + static_cast<size_t>(x)) * 3]);
}

void write_text(Picture& on, int x, int y, const std::string& text) {
  constexpr uint8_t kInk[3] = {230, 230, 230};
  for (const char c : text) {
    const uint16_t bits = bitmap_glyph(c);
    for (int i = 0; i < kGlyphWidth * kGlyphHeight; ++i)
      if (bits >> (kGlyphWidth * kGlyphHeight - 1 - i) & 1) put(on, x + i % kGlyphWidth, y + i / kGlyphWidth, kInk);
    x += kAdvance;
  }
}

// Channel c of a pixel over black.
double over_black(const image::Image& from, int x, int y, int c) {
  const size_t at = (static_cast<size_t>(y) * static_cast<size_t>(from.width) + static_cast<size_t>(x)) *
                    static_cast<size_t>(from.channels);
  const bool grey = from.channels < 3, transparent = from.channels % 2 == 0;
  const double alpha = transparent ? from.bytes[at + static_cast<size_t>(from.channels) - 1] / 255.0 : 1;
  return from.bytes[at + static_cast<size_t>(grey ? 0 : c)] * alpha;
}

Result<image::Image> decoded(const std::filesystem::path& file) {
  const auto bytes = read_file(file);
  if (!bytes) return bytes.error();
  auto from = image::decode_image(*bytes, file.string());
  if (from && from->type != image::PixelType::byte8) return input_error(file.string() + ": is not an 8-bit image");
  return from;
}

// The mean of the source pixels that cover each pixel; `at(x, y, c)` is the source.
template <class Source>
Picture averaged(int from_width, int from_height, int width, int height, Source&& at) {
  Picture to{width, height, {}};
  for (int y = 0; y < height; ++y)
    for (int x = 0; x < width; ++x) {
      const int x0 = x * from_width / width, x1 = std::max(x0 + 1, (x + 1) * from_width / width);
      const int y0 = y * from_height / height, y1 = std::max(y0 + 1, (y + 1) * from_height / height);
      for (int c = 0; c < 3; ++c) {
        double sum = 0;
        for (int v = y0; v < y1; ++v)
          for (int u = x0; u < x1; ++u) sum += at(u, v, c);
        to.rgb.push_back(static_cast<uint8_t>(sum / ((x1 - x0) * (y1 - y0)) + 0.5));
      }
    }
  return to;
}

// Width and height, scaled so that the longer side is at most `size`.
std::pair<int, int> fitted(int width, int height, int size) {
  const double scale = std::min(1.0, static_cast<double>(size) / std::max(width, height));
  return {std::max(1, static_cast<int>(width * scale)), std::max(1, static_cast<int>(height * scale))};
}

}  // namespace

Result<Picture> thumbnail(const std::filesystem::path& file, int width, int height) {
  const auto from = decoded(file);
  if (!from) return from.error();
  return averaged(from->width, from->height, width, height,
                  [&](int x, int y, int c) { return over_black(*from, x, y, c); });
}

Result<Picture> thumbnail(const std::filesystem::path& file, int size) {
  const auto from = decoded(file);
  if (!from) return from.error();
  const auto [width, height] = fitted(from->width, from->height, size);
  return averaged(from->width, from->height, width, height,
                  [&](int x, int y, int c) { return over_black(*from, x, y, c); });
}

Picture shrunk(const Picture& from, int size) {
  const auto [width, height] = fitted(from.width, from.height, size);
  return averaged(from.width, from.height, width, height,
                  [&](int x, int y, int c) { return from.rgb[static_cast<size_t>((y * from.width + x) * 3 + c)]; });
}

void Sheet::add(const Picture* picture, const std::string& text) {
  const auto most = static_cast<size_t>(tile_ / kAdvance);
  tiles_.push_back(
      {row_, column_, picture ? *picture : Picture{}, text.size() > most ? text.substr(text.size() - most) : text});
  if (++column_ == columns_) end_row();
}

void Sheet::end_row() {
  if (column_ > 0) ++row_;
  column_ = 0;
}

Picture Sheet::picture() const {
  const int rows = row_ + (column_ > 0 ? 1 : 0), step_x = tile_ + kGap, step_y = tile_ + kTextHeight;
  Picture sheet{columns_ * step_x, std::max(1, rows * step_y), {}};
  sheet.rgb.assign(static_cast<size_t>(sheet.width) * static_cast<size_t>(sheet.height) * 3, 24);
  for (const Tile& t : tiles_) {
    const int left = t.column * step_x, top = t.row * step_y;
    const int x0 = left + (tile_ - t.picture.width) / 2, y0 = top + (tile_ - t.picture.height) / 2;
    for (int y = 0; y < t.picture.height; ++y)
      for (int x = 0; x < t.picture.width; ++x)
        put(sheet, x0 + x, y0 + y,
            &t.picture
                 .rgb[(static_cast<size_t>(y) * static_cast<size_t>(t.picture.width) + static_cast<size_t>(x)) * 3]);
    write_text(sheet, left, top + tile_ + 1, t.text);
  }
  return sheet;
}

}  // namespace etendue::looks
