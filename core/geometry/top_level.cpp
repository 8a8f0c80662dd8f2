#include "geometry/top_level.h"

#include <cstring>

#include "geometry/cylinder_geometry.h"
#include "geometry/embree_scene.h"
#include "geometry/mesh_accel.h"

namespace etendue {
namespace {

RTCGeometry shape_geometry(const AccelInstance& instance) {
  const AnalyticShape& shape = *instance.shape;
  if (shape.kind == AnalyticShape::Kind::cylinder) return cylinder_geometry(embree_device(), instance);
  const bool disk = shape.kind == AnalyticShape::Kind::disk;
  const RTCGeometry geometry =
      rtcNewGeometry(embree_device(), disk ? RTC_GEOMETRY_TYPE_ORIENTED_DISC_POINT : RTC_GEOMETRY_TYPE_SPHERE_POINT);
  const size_t steps = instance.motion ? instance.motion->steps() : 1;
  rtcSetGeometryTimeStepCount(geometry, static_cast<unsigned>(steps));
  for (unsigned i = 0; i < steps; ++i) {
    const AnalyticShape placed = instance.motion ? shape.placed(instance.motion->to_world[i]) : shape;
    const auto store = [&](RTCBufferType type, RTCFormat format, const Vec4& value, size_t size) {
      std::memcpy(rtcSetNewGeometryBuffer(geometry, type, i, format, size, 1), &value, size);
    };
    store(RTC_BUFFER_TYPE_VERTEX, RTC_FORMAT_FLOAT4, Vec4(placed.centre, placed.radius), sizeof(Vec4));
    if (disk) store(RTC_BUFFER_TYPE_NORMAL, RTC_FORMAT_FLOAT3, Vec4(placed.frame.z, 0), sizeof(Vec3));
  }
  rtcCommitGeometry(geometry);
  return geometry;
}

}  // namespace

TopLevel::TopLevel(std::span<const AccelInstance> instances) : scene_(new_embree_scene()), size_(instances.size()) {
  for (uint32_t i = 0; i < instances.size(); ++i) add(i, instances[i]);
  commit_scene(scene_);
  bounds_ = bounds_of(scene_);
}

TopLevel::~TopLevel() { rtcReleaseScene(scene_); }

void TopLevel::add(uint32_t number, const AccelInstance& instance) {
  if (instance.shape) {
    shape_numbers_.resize(size_, kNone);
    shape_numbers_[number] = static_cast<uint32_t>(shapes_.size());
    attach(scene_, shape_geometry(shapes_.emplace_back(instance)), number);
    return;
  }
  if (instance.mesh->triangles.empty()) return;
  const Motion* motion = instance.motion.get();
  attach(scene_,
         instance.accel ? instance_geometry(instance.accel->scene(), instance.to_world, motion)
                        : triangle_geometry(*instance.mesh, motion),
         number);
  keep(instance);
}

void TopLevel::keep(const AccelInstance& instance) {
  const std::shared_ptr<const void> owner =
      instance.accel ? std::shared_ptr<const void>(instance.accel) : std::shared_ptr<const void>(instance.mesh);
  // Most instances of many follow one of the same mesh.
  if (kept_.empty() || kept_.back() != owner) kept_.push_back(owner);
  if (instance.motion) kept_.push_back(instance.motion);
}

Vec2 TopLevel::shape_coordinates(uint32_t geometry, const Vec3& point, float time) const {
  const AccelInstance& i = shapes_[shape_numbers_[geometry]];
  return i.motion ? i.shape->placed(i.motion->matrix_at(time)).uv_of(point) : i.shape->uv_of(point);
}

}  // namespace etendue
