#include "film/film.h"

namespace etendue::film {

Film::Film(int width, int height)
    : width_(width), height_(height), pixels_(static_cast<size_t>(width) * static_cast<size_t>(height)) {}

uint32_t Film::samples(int x, int y) const {
  const Pixel& p = at(x, y);
  return p.count[0] + p.count[1];
}

Rgb Film::mean(int x, int y) const {
  const Pixel& p = at(x, y);
  const uint32_t n = p.count[0] + p.count[1];
  if (n == 0) return Rgb(0);
  const double scale = 1.0 / n;
  const auto channel = [&](size_t c) { return static_cast<float>((p.sum[0][c] + p.sum[1][c]) * scale); };
  return {channel(0), channel(1), channel(2)};
}

Rgb Film::variance_of_mean(int x, int y) const {
  const Pixel& p = at(x, y);
  if (p.count[0] == 0 || p.count[1] == 0) return Rgb(0);
  const double n = p.count[0] + p.count[1];
  // The mean is w A + (1-w) B with w = nA/n. With variances that fall as 1/n each, (A - B)^2 has the expectation
  // s^2 (1/nA + 1/nB), and the mean has the variance s^2 / n.
  const double scale = p.count[0] * (p.count[1] / (n * n));
  const auto channel = [&](size_t c) {
    const double d = p.sum[0][c] / p.count[0] - p.sum[1][c] / p.count[1];
    return static_cast<float>(d * d * scale);
  };
  return {channel(0), channel(1), channel(2)};
}

ErrorEstimate Film::error() const {
  std::vector<RowError> rows;
  for (int y = 0; y < height_; ++y) rows.push_back(error_of_row(y));
  return error(rows);
}

Film::RowError Film::error_of_row(int y) const {
  RowError row;
  for (int x = 0; x < width_; ++x) {
    const Pixel& p = at(x, y);
    if (p.count[0] == 0 || p.count[1] == 0) return {0, 0, false};
    const Rgb v = variance_of_mean(x, y), m = mean(x, y);
    for (int c = 0; c < 3; ++c) {
      row.squares += v[c];
      row.relative += v[c] / (sqr(double{m[c]}) + 0.01);
    }
  }
  return row;
}

ErrorEstimate Film::error(std::span<const RowError> rows) const {
  double squares = 0, relative = 0;
  for (const RowError& row : rows) {
    if (!row.known) return {};
    squares += row.squares, relative += row.relative;
  }
  const double n = 3.0 * width_ * height_;
  return {std::sqrt(squares / n), relative / n, n > 0};
}

void Film::clear_rows(int first, int end) {
  const auto row = [&](int y) { return pixels_.begin() + static_cast<std::ptrdiff_t>(y) * width_; };
  std::fill(row(first), row(end), Pixel{});
}

}  // namespace etendue::film
