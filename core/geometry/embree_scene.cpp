#include "geometry/embree_scene.h"

#include <algorithm>
#include <atomic>

namespace etendue {
namespace {

std::atomic<int64_t>& memory_counter() {
  static std::atomic<int64_t> bytes{0};
  return bytes;
}

bool count_memory(void*, ssize_t bytes, bool) {
  memory_counter().fetch_add(bytes, std::memory_order_relaxed);
  return true;
}

void set_positions(RTCGeometry geometry, unsigned step, const std::vector<Vec3>& positions) {
  rtcSetSharedGeometryBuffer(geometry, RTC_BUFFER_TYPE_VERTEX, step, RTC_FORMAT_FLOAT3, positions.data(), 0,
                             sizeof(Vec3), positions.size());
}

}  // namespace

RTCDevice embree_device() {
  static const RTCDevice the_device = [] {
    const RTCDevice d = rtcNewDevice("set_affinity=0");
    rtcSetDeviceMemoryMonitorFunction(d, count_memory, nullptr);
    return d;
  }();
  return the_device;
}

RTCScene new_embree_scene() {
  const RTCScene scene = rtcNewScene(embree_device());
  rtcSetSceneFlags(scene, RTC_SCENE_FLAG_CONTEXT_FILTER_FUNCTION);
  return scene;
}

Bounds bounds_of(RTCScene scene) {
  RTCBounds b;
  rtcGetSceneBounds(scene, &b);
  if (!(b.lower_x <= b.upper_x)) return {};
  return {.min = Vec3(b.lower_x, b.lower_y, b.lower_z), .max = Vec3(b.upper_x, b.upper_y, b.upper_z)};
}

RTCGeometry triangle_geometry(const Mesh& mesh, const Motion* motion) {
  const RTCGeometry geometry = rtcNewGeometry(embree_device(), RTC_GEOMETRY_TYPE_TRIANGLE);
  if (motion) {
    rtcSetGeometryTimeStepCount(geometry, static_cast<unsigned>(motion->steps()));
    for (unsigned i = 0; i < motion->steps(); ++i) set_positions(geometry, i, motion->vertices[i].positions);
  } else {
    set_positions(geometry, 0, mesh.positions);
  }
  rtcSetSharedGeometryBuffer(geometry, RTC_BUFFER_TYPE_INDEX, 0, RTC_FORMAT_UINT3, mesh.triangles.data(), 0,
                             sizeof(Triangle), mesh.triangles.size());
  rtcCommitGeometry(geometry);
  return geometry;
}

RTCGeometry instance_geometry(RTCScene scene, const Mat4& to_world, const Motion* motion) {
  const RTCGeometry geometry = rtcNewGeometry(embree_device(), RTC_GEOMETRY_TYPE_INSTANCE);
  rtcSetGeometryInstancedScene(geometry, scene);
  const auto set_transform = [&](unsigned step, const Mat4& matrix) {
    rtcSetGeometryTransform(geometry, step, RTC_FORMAT_FLOAT4X4_COLUMN_MAJOR, &matrix[0][0]);
  };
  if (motion) {
    rtcSetGeometryTimeStepCount(geometry, static_cast<unsigned>(motion->steps()));
    for (unsigned i = 0; i < motion->steps(); ++i) set_transform(i, motion->to_world[i]);
  } else {
    set_transform(0, to_world);
  }
  rtcCommitGeometry(geometry);
  return geometry;
}

void attach(RTCScene scene, RTCGeometry geometry, uint32_t id) {
  rtcAttachGeometryByID(scene, geometry, id);
  rtcReleaseGeometry(geometry);
}

size_t embree_memory() {
  return static_cast<size_t>(std::max<int64_t>(0, memory_counter().load(std::memory_order_relaxed)));
}

}  // namespace etendue
