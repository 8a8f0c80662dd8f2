#include "medium/medium_emitters.h"

#include <algorithm>
#include <numeric>

namespace etendue {
namespace {

// The extent of a cell along an axis, in the unit cube.
struct CellExtent {
  float from, to;
};

CellExtent extent_of(int cell, float cells_per_unit) {
  return {static_cast<float>(cell) / cells_per_unit, std::min(static_cast<float>(cell + 1) / cells_per_unit, 1.0f)};
}

std::array<int, 3> position_of(uint32_t cell, const GridSize& cells) {
  const auto n = static_cast<int>(cell);
  return {n % cells[0], n / cells[0] % cells[1], n / cells[0] / cells[1]};
}

float volume_of(uint32_t cell, const GridSize& cells, const Vec3& cells_per_unit) {
  const auto at = position_of(cell, cells);
  float volume = 1;
  for (int axis = 0; axis < 3; ++axis) {
    const CellExtent extent = extent_of(at[static_cast<size_t>(axis)], cells_per_unit[axis]);
    volume *= extent.to - extent.from;
  }
  return volume;
}

// Of the unit cube, m^3.
float volume_of_box(const Mat4& world_to_box) { return 1 / std::abs(glm::determinant(Mat3(world_to_box))); }

}  // namespace

EmitterBox emitter_box(const HeterogeneousMedium& medium) {
  const DensityGrid& grid = *medium.grid;
  EmitterBox box{medium.world_to_grid, grid.cell_counts(), grid.cells_per_unit(), {}};
  const GridSize& n = box.cells;
  box.power.resize(static_cast<size_t>(n[0]) * static_cast<size_t>(n[1]) * static_cast<size_t>(n[2]));
  const GridSize voxels{grid.nodes()[0] - 1, grid.nodes()[1] - 1, grid.nodes()[2] - 1};
  const Vec3 size(voxels[0], voxels[1], voxels[2]);
  const float voxel_volume = volume_of_box(medium.world_to_grid) / (size.x * size.y * size.z);
  for (int z = 0; z < voxels[2]; ++z)
    for (int y = 0; y < voxels[1]; ++y)
      for (int x = 0; x < voxels[0]; ++x) {
        const Vec3 centre = (Vec3(x, y, z) + 0.5f) / size;
        const float density = grid.density(centre);
        if (!(density > 0)) continue;
        const Vec3 at = centre * box.cells_per_unit;
        const auto cell = static_cast<size_t>(static_cast<int>(at.x) +
                                              n[0] * (static_cast<int>(at.y) + n[1] * static_cast<int>(at.z)));
        box.power[cell] += average(medium.emitted(centre, density)) * voxel_volume;
      }
  return box;
}

EmitterBox emitter_box(const HomogeneousMedium& medium, const Vec3& lowest, const Vec3& highest) {
  EmitterBox box;
  const Vec3 size = highest - lowest;
  Mat4 box_to_world(1);
  for (int axis = 0; axis < 3; ++axis) box_to_world[axis][axis] = size[axis];
  box_to_world[3] = Vec4(lowest, 1);
  box.world_to_box = glm::inverse(box_to_world);
  box.power = {average(medium.emission) * size.x * size.y * size.z};
  return box;
}

MediumEmitters::MediumEmitters(std::span<const EmitterBox> boxes) {
  std::vector<float> powers;
  for (const EmitterBox& box : boxes) {
    const float power = std::accumulate(box.power.begin(), box.power.end(), 0.0f);
    if (!(power > 0) || !std::isfinite(power) || !std::isfinite(volume_of_box(box.world_to_box))) continue;
    power_ += 4 * kPi * power;
    boxes_.push_back({box.world_to_box,
                      glm::inverse(box.world_to_box),
                      box.cells,
                      box.cells_per_unit,
                      {},
                      static_cast<uint32_t>(powers.size())});
    powers.insert(powers.end(), box.power.begin(), box.power.end());
  }
  if (boxes_.empty()) return;
  cells_ = AliasTable(powers);
  for (Box& box : boxes_) {
    const auto count = static_cast<uint32_t>(box.cells[0] * box.cells[1] * box.cells[2]);
    const float volume = volume_of_box(box.world_to_box);
    for (uint32_t cell = 0; cell < count; ++cell)
      box.density.push_back(cells_.probability(box.first_cell + cell) /
                            (volume_of(cell, box.cells, box.cells_per_unit) * volume));
  }
}

Vec3 MediumEmitters::point_in_cell(float choice, const Vec3& position) const {
  const uint32_t number = cells_.sample(choice).index;
  const Box& box = *(std::ranges::upper_bound(boxes_, number, {}, &Box::first_cell) - 1);
  const auto cell = position_of(number - box.first_cell, box.cells);
  Vec3 point;
  for (int axis = 0; axis < 3; ++axis) {
    const CellExtent extent = extent_of(cell[static_cast<size_t>(axis)], box.cells_per_unit[axis]);
    point[axis] = extent.from + (extent.to - extent.from) * position[axis];
  }
  return Vec3(box.box_to_world * Vec4(point, 1));
}

MediumEmitters::Point MediumEmitters::sample_point(float choice, const Vec3& position) const {
  Point point{point_in_cell(choice, position), 0};
  for (const Box& box : boxes_) {
    const Vec3 at = Vec3(box.world_to_box * Vec4(point.position, 1)) * box.cells_per_unit;
    size_t cell = 0;
    bool is_inside = true;
    for (int axis = 2; axis >= 0; --axis) {
      const int count = box.cells[static_cast<size_t>(axis)];
      is_inside = is_inside && at[axis] >= 0 && at[axis] <= box.cells_per_unit[axis];
      const auto number = std::clamp(at[axis], 0.0f, static_cast<float>(count - 1));
      cell = cell * static_cast<size_t>(count) + static_cast<size_t>(number);
    }
    if (is_inside) point.pdf += box.density[cell];
  }
  return point;
}

MediumEmitters::Sample MediumEmitters::sample(const Vec3& from, float choice, const Vec3& position) const {
  const Vec3 to_point = point_in_cell(choice, position) - from;
  const float squared = glm::dot(to_point, to_point);
  if (!(squared > 0)) return {};
  const Vec3 direction = to_point / std::sqrt(squared);
  return {direction, pdf(from, direction)};
}

float MediumEmitters::pdf(const Vec3& from, const Vec3& direction) const {
  float sum = 0;
  for (const Box& box : boxes_) {
    const GridRay ray = DensityGrid::clipped(
        {Vec3(box.world_to_box * Vec4(from, 1)), Vec3(box.world_to_box * Vec4(direction, 0)), 0, kInfinity});
    DensityGrid::traverse(ray, box.cells_per_unit, box.cells, [&](float near, float far, size_t cell) {
      // The integral of t^2.
      sum += box.density[cell] * (far - near) * (far * far + far * near + near * near) * (1.0f / 3);
      return true;
    });
  }
  return sum;
}

}  // namespace etendue
