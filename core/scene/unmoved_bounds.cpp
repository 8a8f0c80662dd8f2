#include "scene/unmoved_bounds.h"

#include <algorithm>
#include <unordered_map>

#include "scene/compiled_scene.h"

namespace etendue::scene {
namespace {

// Strictly, by more than rounding errors.
bool is_inside(const Bounds& inner, const Bounds& outer) {
  const Vec3 margin(1e-4f * outer.radius());
  return glm::all(glm::greaterThan(inner.min, outer.min + margin)) &&
         glm::all(glm::lessThan(inner.max, outer.max - margin));
}

// The bounds of a transformed box, as Embree computes those of an instance.
Bounds transformed(const Bounds& box, const Mat4& m) {
  const Vec3 centre(m * Vec4(box.center(), 1)), half = 0.5f * (box.max - box.min);
  const Vec3 extent = glm::abs(Vec3(m[0])) * half.x + glm::abs(Vec3(m[1])) * half.y + glm::abs(Vec3(m[2])) * half.z;
  return {centre - extent, centre + extent};
}

bool is_listed(std::span<const MovedInstance> moved, uint32_t number) {
  return std::ranges::find(moved, number, &MovedInstance::number) != moved.end();
}

Bounds bounds_of_others(const InstanceArray& instances, std::span<const MovedInstance> moved) {
  std::vector<bool> skipped(instances.size());
  for (const MovedInstance& m : moved) skipped[m.number] = true;
  std::unordered_map<const Mesh*, Bounds> boxes;
  const Mesh* last = nullptr;
  Bounds box, all;
  for (const InstanceData& instance : instances) {
    if (skipped[instance.number]) continue;
    if (instance.mesh.get() != last) {
      last = instance.mesh.get();
      const auto [known, is_new] = boxes.try_emplace(last);
      if (is_new) known->second = bounds_of(*last, Mat4(1));
      box = known->second;
    }
    all.extend(instance.identity ? box : transformed(box, instance.to_world));
  }
  return all;
}

}  // namespace

Bounds bounds_of_unmoved(const Accel& accel, const InstanceArray& instances, std::span<const MovedInstance> moved) {
  const Bounds& before = accel.unmoved_bounds();
  const bool is_unchanged = std::ranges::all_of(moved, [&](const MovedInstance& m) {
    const InstanceData& old = instances[m.number];
    return is_listed(accel.moved(), m.number) || is_inside(bounds_of(*old.mesh, old.to_world), before);
  });
  return is_unchanged ? before : bounds_of_others(instances, moved);
}

}  // namespace etendue::scene
