#include "figures/composition.h"

#include <algorithm>
#include <cmath>

#include "base/base64.h"
#include "base/file.h"
#include "image/image.h"
#include "metrics/drawing_layout.h"

namespace etendue::figures {
namespace {

using metrics::Drawing;

constexpr int kGap = 16;                                                    // around the parts
constexpr double kCaptionSize = 14, kHeadingSize = 18, kLetterWidth = 0.5;  // the width is relative to the size
constexpr metrics::Color kInk{34, 34, 34};

struct Size {
  int width, height;
};
Size size_of(const Part& part) {
  return std::visit([](const auto& content) { return Size{content.width, content.height}; }, part.content);
}

std::vector<std::string> wrapped(const std::string& text, double width, double size) {
  const auto most = static_cast<size_t>(std::max(8.0, width / (kLetterWidth * size)));
  std::vector<std::string> lines;
  std::string line;
  size_t start = 0;
  while (start < text.size()) {
    const size_t end = std::min(text.find(' ', start), text.size());
    const std::string word = text.substr(start, end - start);
    if (!line.empty() && line.size() + 1 + word.size() > most) {
      lines.push_back(line);
      line.clear();
    }
    line += (line.empty() ? "" : " ") + word;
    start = end + 1;
  }
  if (!line.empty()) lines.push_back(line);
  return lines;
}

Drawing caption_drawing(const std::string& text, int width, double size) {
  Drawing drawing{.width = width, .height = 0, .title = {}, .shapes = {}};
  for (const std::string& line : wrapped(text, width, size)) {
    drawing.height += static_cast<int>(1.35 * size);
    drawing.shapes.emplace_back(
        metrics::Text{.at = {0, drawing.height - 0.3 * size}, .text = line, .size = size, .color = kInk});
  }
  return drawing;
}

void add(Composition& all, const Part& part, int x, int y) {
  if (const auto* drawing = std::get_if<Drawing>(&part.content)) {
    metrics::place(all.drawing, *drawing, {static_cast<double>(x), static_cast<double>(y)});
  } else {
    all.pictures.push_back({x, y, std::get<Picture>(part.content)});
  }
}

// Adds one row of parts with their captions at height y and returns the height below it.
int add_row(Composition& all, std::span<const Part> row, int y) {
  int x = kGap, end = y;
  for (const Part& part : row) {
    const Size size = size_of(part);
    const int below = y + size.height;
    add(all, part, x, y);
    const Drawing caption = caption_drawing(part.caption, size.width, kCaptionSize);
    metrics::place(all.drawing, caption, {static_cast<double>(x), below + 4.0});
    end = std::max(end, below + 4 + caption.height);
    x += size.width + kGap;
  }
  all.drawing.width = std::max(all.drawing.width, x);
  return end + kGap;
}

}  // namespace

Composition composed(const Parts& parts, int columns, const std::string& heading) {
  Composition all;
  const size_t per_row = columns > 0 ? static_cast<size_t>(columns) : std::max<size_t>(parts.size(), 1);
  int width = 0;
  for (size_t first = 0; first < parts.size(); first += per_row) {
    int row = kGap;
    for (size_t i = first; i < std::min(first + per_row, parts.size()); ++i) row += size_of(parts[i]).width + kGap;
    width = std::max(width, row);
  }
  int y = kGap;
  if (!heading.empty()) {
    const Drawing text = caption_drawing(heading, width - 2 * kGap, kHeadingSize);
    metrics::place(all.drawing, text, {kGap, static_cast<double>(y)});
    y += text.height + kGap / 2;
  }
  for (size_t first = 0; first < parts.size(); first += per_row)
    y = add_row(all, std::span(parts).subspan(first, std::min(per_row, parts.size() - first)), y);
  all.drawing.height = y;
  all.drawing.title = heading;
  return all;
}

Picture rasterized(const Composition& composition) {
  Picture all{composition.drawing.width, composition.drawing.height, metrics::rasterize(composition.drawing)};
  for (const auto& [x, y, picture] : composition.pictures)
    for (int row = 0; row < picture.height; ++row) {
      const auto from = picture.pixels.begin() + 3L * row * picture.width;
      std::copy(from, from + 3L * picture.width, all.pixels.begin() + 3L * ((y + row) * all.width + x));
    }
  return all;
}

std::string to_svg(const Composition& composition) {
  std::string svg = metrics::to_svg(composition.drawing), images;
  for (const auto& [x, y, picture] : composition.pictures) {
    const auto png = image::encode_png(picture.width, picture.height, picture.pixels);
    if (!png) continue;
    images += "<image x=\"" + std::to_string(x) + "\" y=\"" + std::to_string(y) + "\" width=\"" +
              std::to_string(picture.width) + "\" height=\"" + std::to_string(picture.height) +
              "\" href=\"data:image/png;base64," + base64(*png) + "\"/>\n";
  }
  return svg.insert(svg.rfind("</svg>"), images);
}

Result<void> write_figure(const std::filesystem::path& file, const Composition& composition) {
  if (file.extension() == ".svg") {
    const std::string svg = to_svg(composition);
    return write_file(file, svg.data(), svg.size());
  }
  if (file.extension() != ".png")
    return usage_error(file.string() + ": figures are written as .png or .svg; give a name with one of these endings");
  const Picture picture = rasterized(composition);
  return image::write_png(file, picture.width, picture.height, picture.pixels);
}

namespace {

Picture reduced(const Picture& picture, int size) {
  const double factor = static_cast<double>(std::max(picture.width, picture.height)) / size;
  if (factor <= 1) return picture;
  const auto scaled = [&](int length) { return std::max(1, static_cast<int>(length / factor)); };
  Picture small{scaled(picture.width), scaled(picture.height), {}};
  for (int y = 0; y < small.height; ++y)
    for (int x = 0; x < small.width; ++x) {
      const int x0 = x * picture.width / small.width, x1 = std::max(x0 + 1, (x + 1) * picture.width / small.width);
      const int y0 = y * picture.height / small.height, y1 = std::max(y0 + 1, (y + 1) * picture.height / small.height);
      for (int c = 0; c < 3; ++c) {
        int sum = 0;
        for (int v = y0; v < y1; ++v)
          for (int u = x0; u < x1; ++u) sum += picture.pixels[static_cast<size_t>(3 * (v * picture.width + u) + c)];
        small.pixels.push_back(static_cast<uint8_t>(sum / ((x1 - x0) * (y1 - y0))));
      }
    }
  return small;
}

}  // namespace

Picture thumbnail(const Picture& picture, int size) {
  const Picture small = reduced(picture, size);
  Picture result{size, small.height, std::vector<uint8_t>(3 * static_cast<size_t>(size * small.height), 255)};
  const long margin = (size - small.width) / 2;
  for (long row = 0; row < small.height; ++row)
    std::copy_n(small.pixels.begin() + 3 * row * small.width, 3 * small.width,
                result.pixels.begin() + 3 * (row * size + margin));
  return result;
}

}  // namespace etendue::figures
