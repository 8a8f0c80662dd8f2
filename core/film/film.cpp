#include "film/film.h"

namespace etendue::film {

Film::Film(int width, int height)
    : width_(width),
      height_(height),
      pixels_(static_cast<size_t>(width) * static_cast<size_t>(height)),
      errors_(width, height) {}

void Film::add_sum(int x, int y, uint32_t half_buffer, const std::array<double, 3>& sum, uint32_t count) {
  Pixel& pixel = at(x, y);
  pixel.count[half_buffer] += count;
  RoundingErrors::Channels errors;
  for (size_t c = 0; c < 3; ++c) errors[c] = add_exactly(pixel.sum[half_buffer][c], sum[c]);
  if (errors[0] != 0 || errors[1] != 0 || errors[2] != 0) errors_.add(x, y, half_buffer, errors);
}

const Film::Sums& Film::rounded_sums(int x, int y, Sums& buffer) const {
  for (size_t half = 0; half < kHalfBuffers; ++half) buffer[half] = errors_.rounded(x, y, half, at(x, y).sum[half]);
  return buffer;
}

uint32_t Film::samples(int x, int y) const {
  const Pixel& p = at(x, y);
  return p.count[0] + p.count[1];
}

Rgb Film::mean(const Pixel& p, const Sums& sum) const {
  const uint32_t n = p.count[0] + p.count[1];
  if (n == 0) return Rgb(0);
  const bool equal = has_equal_weights(p);
  const double a = equal ? 0.5 / p.count[0] : 1.0 / n, b = equal ? 0.5 / p.count[1] : a;
  const auto channel = [&](size_t c) { return static_cast<float>(sum[0][c] * a + sum[1][c] * b); };
  return {channel(0), channel(1), channel(2)};
}

Rgb Film::mean(int x, int y) const {
  Sums buffer;
  return mean(at(x, y), sums(x, y, buffer));
}

Rgb Film::half_buffer_mean(int x, int y, uint32_t half_buffer) const {
  const Pixel& p = at(x, y);
  const double scale = 1.0 / p.count[half_buffer];
  Sums buffer;
  const auto& total = sums(x, y, buffer)[half_buffer];
  const auto channel = [&](size_t c) { return static_cast<float>(total[c] * scale); };
  return {channel(0), channel(1), channel(2)};
}

Rgb Film::variance_of_mean(const Pixel& p, const Sums& sum) const {
  if (p.count[0] == 0 || p.count[1] == 0) return Rgb(0);
  // The mean is w A + (1-w) B. If the variances of the half-buffers fall as 1/n, (A - B)^2 has the expectation
  // s^2 (1/nA + 1/nB), and the mean has the variance s^2 / n where w = nA/n. Where w = 1/2, it has a quarter of that of
  // the difference whatever the variances are.
  const double n = p.count[0] + p.count[1];
  const double scale = has_equal_weights(p) ? 0.25 : p.count[0] * (p.count[1] / (n * n));
  const auto channel = [&](size_t c) {
    const double d = sum[0][c] / p.count[0] - sum[1][c] / p.count[1];
    return static_cast<float>(d * d * scale);
  };
  return {channel(0), channel(1), channel(2)};
}

Rgb Film::variance_of_mean(int x, int y) const {
  Sums buffer;
  return variance_of_mean(at(x, y), sums(x, y, buffer));
}

ErrorEstimate Film::error() const {
  std::vector<RowError> rows;
  for (int y = 0; y < height_; ++y) rows.push_back(error_of_row(y));
  return error(rows);
}

RowError Film::error_of_row(int y) const {
  RowError row;
  RowSum absolute(row.absolute);
  for (int x = 0; x < width_; ++x) {
    const Pixel& p = at(x, y);
    if (p.count[0] == 0 || p.count[1] == 0) return {.absolute = {}, .known = false};
    Sums buffer;
    const Sums& sum = sums(x, y, buffer);
    const Rgb v = variance_of_mean(p, sum), m = mean(p, sum);
    double squares = 0;
    for (int c = 0; c < 3; ++c) squares += v[c], row.relative += v[c] / (sqr(double{m[c]}) + 0.01);
    absolute.add(squares);
    row.has_light = row.has_light || !is_black(m);
  }
  return row;
}

ErrorEstimate Film::error(std::span<const RowError> rows) const { return error_of(rows, 3.0 * width_ * height_); }

void Film::clear_rows(int first, int end) {
  const auto row = [&](int y) { return pixels_.begin() + static_cast<std::ptrdiff_t>(y) * width_; };
  std::fill(row(first), row(end), Pixel{});
  errors_.clear_rows(first, end);
}

}  // namespace etendue::film
