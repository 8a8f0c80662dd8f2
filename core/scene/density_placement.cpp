#include "scene/density_placement.h"

namespace etendue::scene {
namespace {

Mat4 unit_cube_to(const Bounds& bounds) {
  const Vec3 extent = bounds.max - bounds.min;
  // The box of a flat boundary has no volume; its matrix must still be invertible.
  const Vec3 size = glm::max(extent, Vec3(std::max(1e-6f * max_component(extent), 1e-20f)));
  Mat4 to_box(1);
  for (int axis = 0; axis < 3; ++axis) to_box[axis][axis] = size[axis];
  to_box[3] = Vec4(bounds.min, 1);
  return to_box;
}

}  // namespace

Mat4 density_box(const InstanceArray& instances, uint32_t solid, const Mat4& world) {
  const Mat4 to_node = glm::inverse(world);
  Bounds bounds;
  for (const InstanceData& instance : instances)
    if (instance.solid == solid)
      bounds.extend(bounds_of(*instance.mesh, instance.identity ? to_node : to_node * instance.to_world));
  return glm::inverse(world * unit_cube_to(bounds));
}

Mat4 density_box(const Bounds& bounds) { return glm::inverse(unit_cube_to(bounds)); }

Result<std::shared_ptr<const HeterogeneousMedium>> place_density(const MediumDescription& medium, const Rgb& absorption,
                                                                 const Mat4& world_to_grid, bool moves) {
  if (moves)
    return usage_error(
        "its density varies and it moves while the shutter is open, which is not supported: set camera.shutter to 0");
  const auto& grid = medium.density->grid();
  if (!grid) return grid.error();
  return std::shared_ptr<const HeterogeneousMedium>(
      std::make_shared<HeterogeneousMedium>(medium, absorption, *grid, world_to_grid));
}

}  // namespace etendue::scene
