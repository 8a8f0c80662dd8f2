#include "geometry/cylinder_geometry.h"

#include <limits>
#include <optional>

#include "base/tsan_handoff.h"
#include "geometry/ray.h"

namespace etendue {
namespace {

const AccelInstance& cylinder_of(const void* user_pointer) { return *static_cast<const AccelInstance*>(user_pointer); }

AnalyticShape cylinder_at(const AccelInstance& instance, float time) {
  return instance.motion ? instance.shape->placed(instance.motion->matrix_at(time)) : *instance.shape;
}

// The nearest distance in [ray.tnear, ray.tfar] at which the ray meets the lateral surface.
std::optional<float> hit_distance(const AnalyticShape& cylinder, const Ray& ray) {
  const Vec3& axis = cylinder.frame.x;
  const Vec3 from = ray.origin - cylinder.centre;
  const float axial_from = glm::dot(from, axis), axial_step = glm::dot(ray.direction, axis);
  const Vec3 across_from = from - axial_from * axis, across_step = ray.direction - axial_step * axis;
  const float squared = length_squared(across_step);
  if (!(squared > 0)) return std::nullopt;
  // From the point of the ray nearest to the axis: the difference of squares stays precise far from the cylinder.
  const float middle = -glm::dot(across_from, across_step) / squared;
  const float rest = sqr(cylinder.radius) - length_squared(across_from + middle * across_step);
  if (!(rest >= 0)) return std::nullopt;
  const float half = std::sqrt(rest / squared);
  for (const float t : {middle - half, middle + half})
    if (t >= ray.tnear && t <= ray.tfar && std::abs(axial_from + t * axial_step) <= cylinder.half_length) return t;
  return std::nullopt;
}

Ray ray_at(RTCRayN* rays, unsigned count, unsigned i) {
  Ray ray;
  ray.origin = {RTCRayN_org_x(rays, count, i), RTCRayN_org_y(rays, count, i), RTCRayN_org_z(rays, count, i)};
  ray.direction = {RTCRayN_dir_x(rays, count, i), RTCRayN_dir_y(rays, count, i), RTCRayN_dir_z(rays, count, i)};
  ray.tnear = RTCRayN_tnear(rays, count, i);
  ray.tfar = RTCRayN_tfar(rays, count, i);
  return ray;
}

TsanHandoff g_commit_started, g_bounds_computed;

// Embree interpolates the bounds of two time steps linearly. A sphere around the centre contains every rotation.
void bound_cylinder(const RTCBoundsFunctionArguments* args) {
  g_commit_started.acquire();
  const AccelInstance& instance = cylinder_of(args->geometryUserPtr);
  AnalyticShape s = *instance.shape;
  Vec3 half;
  if (instance.motion) {
    s = s.placed(instance.motion->to_world[args->timeStep]);
    half = Vec3(std::sqrt(sqr(s.half_length) + sqr(s.radius)));
  } else {
    half = s.extent();
  }
  const Vec3 low = s.centre - half, high = s.centre + half;
  *args->bounds_o = {low.x, low.y, low.z, 0, high.x, high.y, high.z, 0};
  g_bounds_computed.release();
}

void intersect_cylinder(const RTCIntersectFunctionNArguments* args) {
  const AccelInstance& instance = cylinder_of(args->geometryUserPtr);
  RTCRayN* rays = RTCRayHitN_RayN(args->rayhit, args->N);
  RTCHitN* hits = RTCRayHitN_HitN(args->rayhit, args->N);
  for (unsigned i = 0; i < args->N; ++i) {
    if (args->valid[i] == 0) continue;
    const auto t = hit_distance(cylinder_at(instance, RTCRayN_time(rays, args->N, i)), ray_at(rays, args->N, i));
    if (!t) continue;
    RTCRayN_tfar(rays, args->N, i) = *t;
    RTCHitN_geomID(hits, args->N, i) = args->geomID;
    RTCHitN_primID(hits, args->N, i) = args->primID;
    RTCHitN_instID(hits, args->N, i, 0) = args->context->instID[0];
  }
}

void occlude_by_cylinder(const RTCOccludedFunctionNArguments* args) {
  const AccelInstance& instance = cylinder_of(args->geometryUserPtr);
  for (unsigned i = 0; i < args->N; ++i) {
    if (args->valid[i] == 0) continue;
    if (hit_distance(cylinder_at(instance, RTCRayN_time(args->ray, args->N, i)), ray_at(args->ray, args->N, i)))
      RTCRayN_tfar(args->ray, args->N, i) = -std::numeric_limits<float>::infinity();
  }
}

}  // namespace

RTCGeometry cylinder_geometry(RTCDevice device, const AccelInstance& instance) {
  const RTCGeometry geometry = rtcNewGeometry(device, RTC_GEOMETRY_TYPE_USER);
  rtcSetGeometryUserPrimitiveCount(geometry, 1);
  rtcSetGeometryUserData(geometry, const_cast<AccelInstance*>(&instance));
  rtcSetGeometryTimeStepCount(geometry, instance.motion ? static_cast<unsigned>(instance.motion->steps()) : 1);
  rtcSetGeometryBoundsFunction(geometry, bound_cylinder, nullptr);
  rtcSetGeometryIntersectFunction(geometry, intersect_cylinder);
  rtcSetGeometryOccludedFunction(geometry, occlude_by_cylinder);
  rtcCommitGeometry(geometry);
  return geometry;
}

void commit_scene(RTCScene scene) {
  g_commit_started.release();
  rtcCommitScene(scene);
  g_bounds_computed.acquire();
}

}  // namespace etendue
