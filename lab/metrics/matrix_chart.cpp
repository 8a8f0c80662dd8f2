#include "metrics/matrix_chart.h"

#include <algorithm>
#include <cmath>

#include "spectrum/colormap.h"

namespace etendue::metrics {
namespace {

using Rows = std::vector<std::vector<double>>;

constexpr double kTextSize = 13, kTitleSize = 16, kScaleWidth = 14, kScaleText = 52, kOverlap = 0.5;
constexpr int kScaleSteps = 32;

// The mean of the finite values of a block; NaN if there is none.
double block_mean(const Rows& rows, size_t y0, size_t y1, size_t x0, size_t x1) {
  double sum = 0, count = 0;
  for (size_t y = y0; y < y1; ++y)
    for (size_t x = x0; x < x1; ++x)
      if (std::isfinite(rows[y][x])) {
        sum += rows[y][x];
        ++count;
      }
  return count > 0 ? sum / count : NAN;
}

Rows reduced(const Rows& rows) {
  const size_t height = rows.size(), width = height > 0 ? rows.front().size() : 0;
  const size_t m = std::min(height, kMostCells), n = std::min(width, kMostCells);
  Rows result(m, std::vector<double>(n));
  for (size_t i = 0; i < m; ++i)
    for (size_t j = 0; j < n; ++j)
      result[i][j] = block_mean(rows, i * height / m, (i + 1) * height / m, j * width / n, (j + 1) * width / n);
  return result;
}

// From the least to the largest value, at least one of them not zero.
struct ValueScale {
  double low = 0, high = 0;

  explicit ValueScale(const Rows& rows) {
    for (const auto& row : rows)
      for (const double value : row)
        if (std::isfinite(value)) {
          low = std::min(low, value);
          high = std::max(high, value);
        }
    if (low < 0) low = -(high = std::max(high, -low));
    if (high == 0) high = 1;
  }

  Color color(double value) const {
    const auto x = static_cast<float>(value / high);
    const Rgb c = low < 0 ? diverging_color(x) : viridis(x);
    const auto byte = [](float v) { return static_cast<uint8_t>(255 * v + 0.5f); };
    return {byte(c.r), byte(c.g), byte(c.b)};
  }
};

Polygon rectangle(double x0, double y0, double x1, double y1, const Color& color) {
  return {.points = {{x0, y0}, {x1, y0}, {x1, y1}, {x0, y1}}, .color = color};
}

void add_scale(Drawing& drawing, const ValueScale& scale, double x, double top, double bottom, const Color& text) {
  const auto at = [&](double share) { return bottom + (top - bottom) * share; };
  for (int i = 0; i < kScaleSteps; ++i) {
    const double share = static_cast<double>(i) / kScaleSteps, next = (i + 1.0) / kScaleSteps;
    const double value = scale.low + (scale.high - scale.low) * (share + next) / 2;
    drawing.shapes.emplace_back(rectangle(x, at(next), x + kScaleWidth, at(share), scale.color(value)));
  }
  for (const double share : {0.0, 1.0})
    drawing.shapes.emplace_back(Text{.at = {x + kScaleWidth + 5, at(share) + (share > 0 ? kTextSize : 0)},
                                     .text = short_number(scale.low + (scale.high - scale.low) * share),
                                     .size = kTextSize,
                                     .color = text});
}

}  // namespace

Drawing matrix_drawing(const MatrixChart& chart, const ChartOptions& options) {
  Drawing drawing{.width = options.width, .height = options.height, .title = chart.title, .shapes = {}};
  const Rows rows = reduced(chart.rows);
  if (rows.empty() || rows.front().empty()) return drawing;
  const double top = options.embedded ? 6 : 52, bottom = options.height - (options.embedded ? 6.0 : 34.0);
  const double left = options.embedded ? 6 : 24;
  const auto height = static_cast<double>(rows.size()), width = static_cast<double>(rows.front().size());
  const double cell =
      std::max(1.0, std::min((bottom - top) / height, (options.width - left - kScaleWidth - kScaleText - 12) / width));
  const ValueScale scale(rows);
  for (size_t i = 0; i < rows.size(); ++i)
    for (size_t j = 0; j < rows[i].size(); ++j) {
      if (!std::isfinite(rows[i][j])) continue;
      const double x = left + cell * static_cast<double>(j), y = top + cell * static_cast<double>(i);
      // Cells overlap, so that no background is visible between them.
      const double right = x + cell + (j + 1 < rows[i].size() ? kOverlap : 0);
      const double end = y + cell + (i + 1 < rows.size() ? kOverlap : 0);
      drawing.shapes.emplace_back(rectangle(x, y, right, end, scale.color(rows[i][j])));
    }
  add_scale(drawing, scale, left + cell * width + 12, top, top + cell * height, options.palette.text);
  if (options.embedded) return drawing;
  const auto add_text = [&](double x, double y, const std::string& text, double size) {
    drawing.shapes.emplace_back(Text{.at = {x, y}, .text = text, .size = size, .color = options.palette.text});
  };
  add_text(left, 20, chart.title, kTitleSize);
  add_text(left, 42, chart.y_label, kTextSize);
  add_text(left, top + cell * height + 20, chart.x_label, kTextSize);
  return drawing;
}

}  // namespace etendue::metrics
