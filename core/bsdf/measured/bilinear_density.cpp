#include "bsdf/measured/bilinear_density.h"

namespace etendue {
namespace {

// The interval between two of `nodes` equidistant nodes that contains x in [0, 1], and the position in it.
struct Patch {
  size_t index;
  float t;

  Patch(float x, size_t nodes) {
    const float scaled = std::clamp(x, 0.0f, 1.0f) * static_cast<float>(nodes - 1);
    index = std::min(static_cast<size_t>(scaled), nodes - 2);
    t = scaled - static_cast<float>(index);
  }
};

float lerp(float a, float b, float t) { return a + (b - a) * t; }

// The t for which area_below(a, b, t) is `area`.
float inverse_area(float a, float b, float area) {
  const float root = a + safe_sqrt(a * a + 2 * (b - a) * area);
  return root > 0 ? std::clamp(2 * area / root, 0.0f, 1.0f) : 0.5f;
}
// The integral from 0 to t of a linear function with the values a at 0 and b at 1.
float area_below(float a, float b, float t) { return t * (a + 0.5f * (b - a) * t); }

}  // namespace

BilinearGrid::BilinearGrid(std::span<const float> values, size_t width, size_t height)
    : values_(values.begin(), values.end()), width_(width), height_(height) {}

float BilinearGrid::at(const Vec2& p, const SliceBlend& blend, size_t slice_stride) const {
  const Patch x(p.x, width_), y(p.y, height_);
  const auto slice = [&](size_t k) {
    const float* v = &values_[(k * height_ + y.index) * width_ + x.index];
    return lerp(lerp(v[0], v[1], x.t), lerp(v[width_], v[width_ + 1], x.t), y.t);
  };
  const float first = slice(blend.first);
  return blend.t > 0 ? lerp(first, slice(blend.first + slice_stride), blend.t) : first;
}

BilinearDensity::BilinearDensity(std::span<const float> values, size_t width, size_t height)
    : values_(values.begin(), values.end()), width_(width), height_(height), slices_(values.size() / (width * height)) {
  row_sums_.resize(values_.size());
  marginal_.resize(slices_ * height);
  const double dx = 1.0 / static_cast<double>(width - 1), dy = 1.0 / static_cast<double>(height - 1);
  for (size_t k = 0; k < slices_; ++k) {
    float* v = &values_[k * height * width];
    double total = 0;
    const auto row_total = [&](size_t y) {
      double sum = 0;
      for (size_t x = 0; x + 1 < width; ++x) sum += 0.5 * dx * (double{v[y * width + x]} + v[y * width + x + 1]);
      return sum;
    };
    for (size_t y = 0; y + 1 < height; ++y) total += 0.5 * dy * (row_total(y) + row_total(y + 1));
    for (size_t i = 0; i < width * height; ++i) v[i] = total > 0 ? static_cast<float>(v[i] / total) : 1;
    double below = 0, previous = row_total(0);
    for (size_t y = 0; y < height; ++y) {
      double sum = 0;
      for (size_t x = 0; x < width; ++x) {
        if (x > 0) sum += 0.5 * dx * (double{v[y * width + x - 1]} + v[y * width + x]);
        row_sums_[(k * height + y) * width + x] = static_cast<float>(sum);
      }
      if (y > 0) below += 0.5 * dy * (previous + sum);
      previous = sum;
      marginal_[k * height + y] = static_cast<float>(below);
    }
  }
}

// Two blended slices, read as one.
struct BilinearDensity::View {
  const BilinearDensity& density;
  size_t first, second;
  float t;

  View(const BilinearDensity& density_, const SliceBlend& blend)
      : density(density_), first(blend.first), second(blend.t > 0 ? blend.first + 1 : blend.first), t(blend.t) {}

  float value(size_t y, size_t x) const {
    return blended(density.values_, density.height_ * density.width_, y * density.width_ + x);
  }
  float row_sum(size_t y, size_t x) const {
    return blended(density.row_sums_, density.height_ * density.width_, y * density.width_ + x);
  }
  float row_total(size_t y) const { return row_sum(y, density.width_ - 1); }
  float below(size_t y) const { return blended(density.marginal_, density.height_, y); }

 private:
  float blended(const std::vector<float>& data, size_t stride, size_t at) const {
    return lerp(data[first * stride + at], data[second * stride + at], t);
  }
};

namespace {

// The largest index below nodes - 1 whose cumulative sum does not exceed u.
template <class Sum>
size_t find_interval(size_t nodes, float u, Sum&& sum) {
  size_t low = 0, high = nodes - 1;
  while (high - low > 1) {
    const size_t middle = (low + high) / 2;
    (sum(middle) <= u ? low : high) = middle;
  }
  return low;
}

}  // namespace

BilinearDensity::Sample BilinearDensity::sample(const Vec2& u, const SliceBlend& blend) const {
  const View view(*this, blend);
  const auto rows = static_cast<float>(height_ - 1), columns = static_cast<float>(width_ - 1);
  const float target_y = u.y * view.below(height_ - 1);
  const size_t y = find_interval(height_, target_y, [&](size_t k) { return view.below(k); });
  const float a = view.row_total(y), b = view.row_total(y + 1);
  const float t = inverse_area(a, b, (target_y - view.below(y)) * rows);

  const float target_x = u.x * lerp(a, b, t);
  const auto sum = [&](size_t k) { return lerp(view.row_sum(y, k), view.row_sum(y + 1, k), t); };
  const size_t x = find_interval(width_, target_x, sum);
  const float v0 = lerp(view.value(y, x), view.value(y + 1, x), t);
  const float v1 = lerp(view.value(y, x + 1), view.value(y + 1, x + 1), t);
  const float s = inverse_area(v0, v1, (target_x - sum(x)) * columns);
  return {Vec2((static_cast<float>(x) + s) / columns, (static_cast<float>(y) + t) / rows), lerp(v0, v1, s)};
}

BilinearDensity::Sample BilinearDensity::invert(const Vec2& p, const SliceBlend& blend) const {
  const View view(*this, blend);
  const auto rows = static_cast<float>(height_ - 1), columns = static_cast<float>(width_ - 1);
  const Patch x(p.x, width_), y(p.y, height_);
  const float a = view.row_total(y.index), b = view.row_total(y.index + 1);
  const float total = lerp(a, b, y.t);
  const float v0 = lerp(view.value(y.index, x.index), view.value(y.index + 1, x.index), y.t);
  const float v1 = lerp(view.value(y.index, x.index + 1), view.value(y.index + 1, x.index + 1), y.t);
  const float left = lerp(view.row_sum(y.index, x.index), view.row_sum(y.index + 1, x.index), y.t);
  const Vec2 u(total > 0 ? (left + area_below(v0, v1, x.t) / columns) / total : x.t,
               view.below(y.index) + area_below(a, b, y.t) / rows);
  return {u, lerp(v0, v1, x.t)};
}

}  // namespace etendue
