#include "support/sphere_partition.h"

#include <array>

namespace etendue::test {
namespace {

constexpr double kQuarterPi = 0.78539816339744830962;
constexpr int kDeepestCell = 24;

}  // namespace

SpherePartition::SpherePartition(std::span<const Vec3> directions, size_t most_in_a_cell) : boxes_(2) {
  boxes_[1].upper = false;
  std::array<std::vector<Point>, 2> sides;
  for (const Vec3& w : directions) {
    const Point p = to_square(w);
    sides[p.upper ? 0 : 1].push_back(p);
  }
  for (size_t side = 0; side < 2; ++side) split(side, std::move(sides[side]), most_in_a_cell, 0);
}

void SpherePartition::split(size_t box, std::vector<Point> points, size_t most, int depth) {
  if (points.size() <= most || depth == kDeepestCell) {
    boxes_[box].leaf = leaves_.size();
    leaves_.push_back(box);
    return;
  }
  const size_t first = boxes_.size();
  boxes_[box].children = first;
  for (size_t k = 0; k < 4; ++k) boxes_.push_back(quarter_of(boxes_[box], k));
  std::array<std::vector<Point>, 4> parts;
  for (const Point& p : points) parts[quarter(boxes_[box], p)].push_back(p);
  for (size_t k = 0; k < 4; ++k) split(first + k, std::move(parts[k]), most, depth + 1);
}

size_t SpherePartition::cell_of(const Vec3& w) const {
  const Point p = to_square(w);
  size_t box = p.upper ? 0 : 1;
  while (boxes_[box].children > 0) box = boxes_[box].children + quarter(boxes_[box], p);
  return boxes_[box].leaf;
}

SpherePartition::Point SpherePartition::to_square(const Vec3& w) {
  const double x = w.x, y = w.y, z = std::abs(w.z);
  const double r = std::sqrt((x * x + y * y) / (1 + z));
  const bool wide = std::abs(x) > std::abs(y);
  const double along = wide ? std::copysign(r, x) : std::copysign(r, y);
  const double ratio = wide ? y / x : y == 0 ? 0 : x / y;
  const double across = along * std::atan(ratio) / kQuarterPi;
  return {wide ? along : across, wide ? across : along, w.z >= 0};
}

Vec3 SpherePartition::to_sphere(double x, double y, bool upper) {
  const bool wide = std::abs(x) > std::abs(y);
  const double r = wide ? x : y, other = wide ? y : x;
  const double angle = r == 0 ? 0 : kQuarterPi * other / r;
  const double scale = r * std::sqrt(std::max(0.0, 2 - r * r));
  const double c = scale * std::cos(angle), s = scale * std::sin(angle), z = 1 - r * r;
  return {static_cast<float>(wide ? c : s), static_cast<float>(wide ? s : c), static_cast<float>(upper ? z : -z)};
}

}  // namespace etendue::test
