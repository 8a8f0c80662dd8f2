#include "medium/density_grid.h"

#include <cassert>

namespace etendue {
namespace {

// Coarse cells along the longest axis. More of them bound the density more tightly, and more are passed by each ray.
constexpr int kCoarseCells = 32;

}  // namespace

DensityGrid::DensityGrid(GridValues values) : values_(std::move(values)) {
  const GridSize& n = values_.nodes;
  assert(n[0] >= 2 && n[1] >= 2 && n[2] >= 2);
  assert(values_.density.size() == static_cast<size_t>(n[0]) * static_cast<size_t>(n[1]) * static_cast<size_t>(n[2]));
  voxels_ = Vec3(n[0] - 1, n[1] - 1, n[2] - 1);
  find_cells();
  for (const Cell& cell : cells_) highest_ = std::max(highest_, cell.highest);
}

size_t DensityGrid::memory() const {
  return (values_.density.size() + values_.temperature.size()) * sizeof(float) + cells_.size() * sizeof(Cell);
}

float DensityGrid::interpolated(const std::vector<float>& values, const Vec3& p) const {
  const Vec3 at = glm::clamp(p, Vec3(0), Vec3(1)) * voxels_;
  const GridSize& n = values_.nodes;
  const int x = std::min(static_cast<int>(at.x), n[0] - 2), y = std::min(static_cast<int>(at.y), n[1] - 2),
            z = std::min(static_cast<int>(at.z), n[2] - 2);
  const float fx = at.x - static_cast<float>(x), fy = at.y - static_cast<float>(y), fz = at.z - static_cast<float>(z);
  const auto row = static_cast<size_t>(n[0]), slice = row * static_cast<size_t>(n[1]);
  const float* v = &values[static_cast<size_t>(x) + row * static_cast<size_t>(y) + slice * static_cast<size_t>(z)];
  const auto mix = [](float a, float b, float t) { return a + (b - a) * t; };
  const float low = mix(mix(v[0], v[1], fx), mix(v[row], v[row + 1], fx), fy);
  v += slice;
  const float high = mix(mix(v[0], v[1], fx), mix(v[row], v[row + 1], fx), fy);
  return std::max(mix(low, high, fz), 0.0f);
}

float DensityGrid::temperature(const Vec3& p) const {
  if (values_.temperature.empty()) return highest_ > 0 ? std::min(density(p) / highest_, 1.0f) : 0;
  return interpolated(values_.temperature, p);
}

void DensityGrid::find_cells() {
  const GridSize& n = values_.nodes;
  const int longest = std::max({n[0], n[1], n[2]}) - 1;
  const int step = std::max(1, (longest + kCoarseCells - 1) / kCoarseCells);  // voxels along a side
  for (size_t axis = 0; axis < 3; ++axis) cell_counts_[axis] = (n[axis] - 1 + step - 1) / step;
  cells_per_unit_ = voxels_ / static_cast<float>(step);
  const auto index = [](const GridSize& counts, int x, int y, int z) {
    return static_cast<size_t>(x) +
           static_cast<size_t>(counts[0]) *
               (static_cast<size_t>(y) + static_cast<size_t>(counts[1]) * static_cast<size_t>(z));
  };
  cells_.reserve(static_cast<size_t>(cell_counts_[0]) * static_cast<size_t>(cell_counts_[1]) *
                 static_cast<size_t>(cell_counts_[2]));
  for (int cz = 0; cz < cell_counts_[2]; ++cz)
    for (int cy = 0; cy < cell_counts_[1]; ++cy)
      for (int cx = 0; cx < cell_counts_[0]; ++cx) {
        const int end[] = {std::min((cx + 1) * step, n[0] - 1), std::min((cy + 1) * step, n[1] - 1),
                           std::min((cz + 1) * step, n[2] - 1)};
        Cell cell{kInfinity, 0, 0};
        // Nodes on a side of the cell have half the weight in its mean.
        const auto weight = [&](int at, int first, int last) { return at == first || at == last ? 0.5f : 1.0f; };
        float sum = 0, weights = 0;
        for (int z = cz * step; z <= end[2]; ++z)
          for (int y = cy * step; y <= end[1]; ++y)
            for (int x = cx * step; x <= end[0]; ++x) {
              const float value = values_.density[index(n, x, y, z)];
              const float w =
                  weight(x, cx * step, end[0]) * weight(y, cy * step, end[1]) * weight(z, cz * step, end[2]);
              cell.lowest = std::min(cell.lowest, value);
              cell.highest = std::max(cell.highest, value);
              sum += w * value;
              weights += w;
            }
        cell.mean = sum / weights;
        cells_.push_back(cell);
      }
}

GridRay DensityGrid::clipped(GridRay ray) {
  for (int axis = 0; axis < 3; ++axis) {
    if (ray.direction[axis] == 0) {
      if (ray.origin[axis] < 0 || ray.origin[axis] > 1) ray.to = ray.from;
      continue;
    }
    float near = -ray.origin[axis] / ray.direction[axis], far = (1 - ray.origin[axis]) / ray.direction[axis];
    if (near > far) std::swap(near, far);
    ray.from = std::max(ray.from, near);
    ray.to = std::min(ray.to, far);
  }
  return ray;
}

double DensityGrid::integral(const GridRay& ray) const {
  // Gauss-Legendre quadrature with two points is exact for cubic polynomials.
  constexpr float kPoint = 0.21132486540518712f;
  const GridSize voxels{values_.nodes[0] - 1, values_.nodes[1] - 1, values_.nodes[2] - 1};
  double sum = 0;
  traverse(ray, voxels_, voxels, [&](float from, float to, size_t) {
    const float length = to - from;
    sum += 0.5 * static_cast<double>(length) *
           (static_cast<double>(density(ray.at(from + kPoint * length))) +
            static_cast<double>(density(ray.at(to - kPoint * length))));
    return true;
  });
  return sum;
}

}  // namespace etendue
