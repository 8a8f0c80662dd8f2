#include "base/piecewise_constant.h"

#include <numeric>

namespace etendue {
namespace {

// Summed in double precision, so that many small weights are not lost beside a large one.
double sum_of(std::span<const float> weights) { return std::accumulate(weights.begin(), weights.end(), 0.0); }

}  // namespace

AliasTable::AliasTable(std::span<const float> weights) : bins_(weights.size()) {
  const size_t n = weights.size();
  const double sum = sum_of(weights);
  std::vector<double> scaled(n);
  std::vector<uint32_t> small, large;
  for (size_t i = 0; i < n; ++i) {
    const double p = sum > 0 ? weights[i] / sum : 1.0 / static_cast<double>(n);
    bins_[i].probability = static_cast<float>(p);
    scaled[i] = p * static_cast<double>(n);
    (scaled[i] < 1 ? small : large).push_back(static_cast<uint32_t>(i));
  }
  while (!small.empty() && !large.empty()) {
    const uint32_t s = small.back(), l = large.back();
    small.pop_back();
    bins_[s].threshold = static_cast<float>(scaled[s]);
    bins_[s].alias = l;
    scaled[l] -= 1 - scaled[s];
    if (scaled[l] < 1) {
      large.pop_back();
      small.push_back(l);
    }
  }
  // The remaining bins are full up to rounding. None of them has weight zero, since the mass left over is their number.
  for (const auto* rest : {&small, &large})
    for (const uint32_t i : *rest) {
      bins_[i].threshold = 1;
      bins_[i].alias = i;
    }
}

Piecewise1D::Piecewise1D(std::span<const float> values)
    : values_(values.begin(), values.end()), cdf_(values.size() + 1) {
  const double n = static_cast<double>(values.size());
  const double sum = sum_of(values);
  if (!(sum > 0)) values_.assign(values.size(), 0.0f);
  double running = 0;
  for (size_t i = 0; i < values_.size(); ++i) {
    running += sum > 0 ? values_[i] / sum : 1 / n;
    cdf_[i + 1] = static_cast<float>(running);
  }
  cdf_.back() = 1;
  integral_ = static_cast<float>(sum / n);
  const size_t buckets = values_.size() / 2 + 1;
  guide_.reserve(buckets + 1);
  uint32_t cell = 0;
  for (size_t i = 0; i <= buckets; ++i) {
    // A little below i / buckets, because the lookup multiplies in float precision and may round up.
    const float u = (static_cast<float>(i) - 0.01f) / static_cast<float>(buckets);
    while (cell + 1 < values_.size() && cdf_[cell + 1] <= u) ++cell;
    guide_.push_back(cell);
  }
}

Piecewise1D::Point Piecewise1D::find(float u) const {
  const auto bucket = static_cast<size_t>(u * static_cast<float>(guide_.size() - 1));
  const auto first = cdf_.begin() + guide_[bucket] + 1;
  const auto last = cdf_.begin() + std::min<std::ptrdiff_t>(guide_[std::min(bucket + 2, guide_.size() - 1)] + 1,
                                                            static_cast<std::ptrdiff_t>(values_.size()));
  const auto cell =
      std::min(static_cast<size_t>(std::upper_bound(first, last, u) - cdf_.begin() - 1), values_.size() - 1);
  const float width = cdf_[cell + 1] - cdf_[cell];
  const float inside = width > 0 ? (u - cdf_[cell]) / width : 0.5f;
  const float n = static_cast<float>(values_.size());
  const float x = std::min((static_cast<float>(cell) + inside) / n, kOneMinusEpsilon);
  return {x, static_cast<uint32_t>(cell)};
}

Piecewise1D::Sample Piecewise1D::sample(float u) const {
  const Point point = find(u);
  return {point.x, integral_ > 0 ? values_[point.cell] / integral_ : 1.0f, point.cell};
}

float Piecewise1D::pdf(float x) const {
  const auto cell = std::min(static_cast<size_t>(x * static_cast<float>(values_.size())), values_.size() - 1);
  return integral_ > 0 ? values_[cell] / integral_ : 1.0f;
}

Piecewise2D::Piecewise2D(std::span<const float> values, int width, int height) {
  std::vector<float> sums;
  for (int y = 0; y < height; ++y) {
    rows_.emplace_back(values.subspan(static_cast<size_t>(y) * static_cast<size_t>(width), static_cast<size_t>(width)));
    sums.push_back(rows_.back().integral());
  }
  marginal_ = Piecewise1D(sums);
}

Piecewise2D::Sample Piecewise2D::sample(Vec2 u) const {
  const auto v = marginal_.sample(u.y);
  const auto h = rows_[v.cell].sample(u.x);
  return {Vec2(h.x, v.x), h.pdf * v.pdf};
}

Vec2 Piecewise2D::find(Vec2 u) const {
  const auto v = marginal_.find(u.y);
  return {rows_[v.cell].find(u.x).x, v.x};
}

float Piecewise2D::pdf(Vec2 uv) const {
  const auto row = std::min(static_cast<size_t>(uv.y * static_cast<float>(rows_.size())), rows_.size() - 1);
  return rows_[row].pdf(uv.x) * marginal_.pdf(uv.y);
}

}  // namespace etendue
