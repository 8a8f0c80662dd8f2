#include "scene/start_media.h"

#include "light/placed_light.h"
#include "scene/facet.h"

namespace etendue::scene {
namespace {

bool overlap(const Bounds& a, const Bounds& b) {
  return glm::all(glm::lessThanEqual(a.min, b.max)) && glm::all(glm::lessThanEqual(b.min, a.max));
}

Bounds widened(Bounds bounds, float by) {
  bounds.min -= Vec3(by);
  bounds.max += Vec3(by);
  return bounds;
}

Bounds bounds_of_point(const Vec3& p) { return {p, p}; }

// At shutter opening.
Bounds bounds_of_emitter(const InstanceData& instance) {
  Bounds bounds;
  if (instance.round) {
    bounds = widened(bounds_of_point(instance.round->centre), instance.round->radius);
  } else {
    for (uint32_t t = 0; t < instance.mesh->triangles.size(); ++t) {
      const Facet f = facet_of(instance, t, 0);
      bounds.extend(f.p0), bounds.extend(f.p1), bounds.extend(f.p2);
    }
  }
  const Vec3 farthest = glm::max(glm::abs(bounds.min), glm::abs(bounds.max));
  return widened(bounds, offset_bound(farthest, bounds.max - bounds.min, Vec3(0)));
}

// Whether a triangle of the solid's boundary may intersect the bounds.
bool boundary_reaches(const InstanceArray& instances, uint32_t solid, float offset, const Bounds& bounds) {
  for (const InstanceData& instance : instances) {
    if (instance.solid != solid) continue;
    for (uint32_t t = 0; t < instance.mesh->triangles.size(); ++t) {
      const Facet f = facet_of(instance, t, 0);
      Bounds triangle;
      triangle.extend(f.p0), triangle.extend(f.p1), triangle.extend(f.p2);
      if (overlap(widened(triangle, offset), bounds)) return true;
    }
  }
  return false;
}

bool any_moves(const Solids& solids) {
  for (uint32_t i = 0; i < solids.size(); ++i)
    if (solids[i].is_moving) return true;
  return false;
}

// Whether the solids around a point of the bounds depend on the point or the time. `any` returns whether a solid may
// contain such a point.
bool surroundings_vary(const Solids& solids, const InstanceArray& instances, const Bounds& bounds, uint32_t own,
                       bool& any) {
  bool vary = false;
  any = false;
  for (uint32_t i = 0; i < solids.size() && !vary; ++i) {
    if (i == own || !overlap(widened(solids[i].bounds, solids[i].offset), bounds)) continue;
    any = true;
    vary = solids[i].is_moving || boundary_reaches(instances, i, solids[i].offset, bounds);
  }
  return vary;
}

}  // namespace

StartMedia::StartMedia(const Solids& solids, const InstanceArray& instances, const LightTable& lights,
                       const Camera& camera, bool camera_moves, const StartMedia* same_lights) {
  if (solids.empty()) return;
  if (same_lights)
    emitters_ = same_lights->emitters_, placed_ = same_lights->placed_;
  else
    find_lights(solids, instances, lights);
  find_camera(solids, instances, camera, camera_moves);
}

void StartMedia::find_lights(const Solids& solids, const InstanceArray& instances, const LightTable& lights) {
  const auto find = [&](const Bounds& bounds, uint32_t own, bool moves, const Vec3& point, Surroundings& found) {
    bool any = false;
    found.varies = surroundings_vary(solids, instances, bounds, own, any);
    found.varies = found.varies || moves;
    if (any && !found.varies) found.stack = solids.containing(instances, point, 0, own);
  };
  emitters_.resize(instances.size());
  for (size_t i = 0; i < instances.size(); ++i) {
    const InstanceData& instance = instances[i];
    if (instance.first_light == InstanceData::kNotALight) continue;
    const Vec3 point = instance.round ? instance.round->centre : facet_of(instance, 0, 0).p0;
    find(bounds_of_emitter(instance), instance.solid, instance.motion != nullptr, point, emitters_[i]);
  }
  placed_.resize(lights.placed().size());
  for (size_t i = 0; i < placed_.size(); ++i) {
    const PlacedLight& light = lights.placed()[i];
    if (light.is_infinite()) continue;
    // A point lies on one side of every boundary.
    placed_[i].varies = light.motion || any_moves(solids);
    if (!placed_[i].varies) placed_[i].stack = solids.containing(instances, light.place.position, 0);
  }
}

void StartMedia::find_camera(const Solids& solids, const InstanceArray& instances, const Camera& camera,
                             bool camera_moves) {
  const Vec3 position(camera.to_world[3]);
  const bool on_lens = camera.projection == Projection::perspective && camera.near_clip == 0 && !camera_moves;
  camera_.varies = !on_lens || any_moves(solids);
  if (!camera_.varies && camera.lens_radius > 0) {
    bool any = false;
    const Bounds lens = widened(bounds_of_point(position), camera.lens_radius);
    camera_.varies = surroundings_vary(solids, instances, lens, kNoSolid, any);
  }
  if (!camera_.varies) camera_.stack = solids.containing(instances, position, 0);
}

MediumStack StartMedia::at_camera(const Solids& solids, const InstanceArray& instances, const Ray& ray,
                                  float time) const {
  if (!camera_.varies) return camera_.stack;
  return solids.containing(instances, ray.origin + ray.direction * ray.tnear, time);
}

void StartMedia::find_at_light(const Solids& solids, const InstanceArray& instances, const LightTable& lights,
                               const Emission& emission, const SurfacePoint* point, const Vec3& origin,
                               MediumInterface& found) const {
  found.clear({});
  if (emitters_.empty() || emission.kind == LightKind::environment) return;
  const InstanceData* instance = point ? point->instance : nullptr;
  const uint32_t own = instance ? instance->solid : kNoSolid;
  const Surroundings& known =
      instance ? emitters_[instance->number] : placed_[emission.light - lights.triangles().size()];
  found.surrounding = known.varies ? solids.containing(instances, origin, emission.time, own) : known.stack;
  if (own != kNoSolid) found.add_boundary(own, true);
}

}  // namespace etendue::scene
