#include "metrics/text_raster.h"

#include <ft2build.h>
#include FT_FREETYPE_H

#include <cmath>
#include <cstdint>
#include <mutex>
#include <vector>

namespace etendue::metrics {
namespace {

constexpr const char* kFiles[] = {"/usr/share/fonts/opentype/inter/Inter-Regular.otf",
                                  "/usr/share/fonts/truetype/inter/Inter-Regular.ttf",
                                  "/usr/share/fonts/truetype/dejavu/DejaVuSans.ttf"};
constexpr double kSubpixels = 64;  // FreeType's unit is 1/64 of a pixel

// The code points of a text. A byte that is not UTF-8 becomes U+FFFD.
std::vector<uint32_t> code_points(const std::string& text) {
  std::vector<uint32_t> points;
  for (size_t i = 0; i < text.size();) {
    const auto lead = static_cast<uint8_t>(text[i++]);
    const int more = lead < 0x80 ? 0 : lead >= 0xf0 ? 3 : lead >= 0xe0 ? 2 : lead >= 0xc0 ? 1 : -1;
    uint32_t point = more < 0 ? 0xfffd : more == 0 ? lead : lead & (0x3fU >> more);
    for (int k = 0; k < more; ++k) {
      if (i == text.size() || (static_cast<uint8_t>(text[i]) & 0xc0) != 0x80) {
        point = 0xfffd;
        break;
      }
      point = point << 6 | (static_cast<uint8_t>(text[i++]) & 0x3f);
    }
    points.push_back(point);
  }
  return points;
}

// The typeface. FreeType's objects may be used by one thread at a time.
class Typeface {
 public:
  static Typeface& instance() {
    static Typeface typeface;
    return typeface;
  }

  // Calls `visit` with each glyph and its position relative to the beginning of the text; returns the width.
  template <class F>
  double for_each_glyph(const std::string& text, double size, F&& visit) {
    const std::scoped_lock lock(mutex_);
    if (!face_ || FT_Set_Char_Size(face_, 0, static_cast<FT_F26Dot6>(std::lround(size * kSubpixels)), 72, 72) != 0)
      return 0;
    double x = 0;
    for (const uint32_t point : code_points(text)) {
      if (FT_Load_Char(face_, point, FT_LOAD_RENDER | FT_LOAD_TARGET_LIGHT) != 0) continue;
      visit(*face_->glyph, x);
      x += static_cast<double>(face_->glyph->advance.x) / kSubpixels;
    }
    return x;
  }

 private:
  Typeface() {
    if (FT_Init_FreeType(&library_) != 0) return;
    for (const char* file : kFiles)
      if (FT_New_Face(library_, file, 0, &face_) == 0) return;
    face_ = nullptr;
  }
  ~Typeface() {
    if (library_) FT_Done_FreeType(library_);
  }

  std::mutex mutex_;
  FT_Library library_ = nullptr;
  FT_Face face_ = nullptr;
};

}  // namespace

double text_width(const std::string& text, double size) {
  return Typeface::instance().for_each_glyph(text, size, [](const FT_GlyphSlotRec&, double) {});
}

void rasterize_text(const std::string& text, double size, double x, double y,
                    const std::function<void(int x, int y, double coverage)>& blend) {
  Typeface::instance().for_each_glyph(text, size, [&](const FT_GlyphSlotRec& glyph, double offset) {
    const int left = static_cast<int>(std::lround(x + offset)) + glyph.bitmap_left;
    const int top = static_cast<int>(std::lround(y)) - glyph.bitmap_top;
    for (unsigned row = 0; row < glyph.bitmap.rows; ++row)
      for (unsigned column = 0; column < glyph.bitmap.width; ++column) {
        const uint8_t value = glyph.bitmap.buffer[static_cast<int>(row) * glyph.bitmap.pitch + static_cast<int>(column)];
        if (value > 0) blend(left + static_cast<int>(column), top + static_cast<int>(row), value / 255.0);
      }
  });
}

}  // namespace etendue::metrics
