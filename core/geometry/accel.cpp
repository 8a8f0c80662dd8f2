#include "geometry/accel.h"

#include <immintrin.h>

#include <array>
#include <atomic>
#include <cstring>

#include "base/hash.h"
#include "geometry/cylinder_geometry.h"

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

// The Embree device of the process.
RTCDevice device() {
  static const RTCDevice the_device = [] {
    const RTCDevice d = rtcNewDevice("set_affinity=0");
    rtcSetDeviceMemoryMonitorFunction(d, count_memory, nullptr);
    return d;
  }();
  return the_device;
}

// All scenes support an opacity test per ray, so that a material can become transparent without a rebuild.
RTCScene new_scene() {
  const RTCScene scene = rtcNewScene(device());
  rtcSetSceneFlags(scene, RTC_SCENE_FLAG_CONTEXT_FILTER_FUNCTION);
  return scene;
}

void set_positions(RTCGeometry geometry, unsigned step, const std::vector<Vec3>& positions) {
  rtcSetSharedGeometryBuffer(geometry, RTC_BUFFER_TYPE_VERTEX, step, RTC_FORMAT_FLOAT3, positions.data(), 0,
                             sizeof(Vec3), positions.size());
}

// `motion` is null or the motion of a deforming mesh.
RTCGeometry triangle_geometry(const Mesh& mesh, const Motion* motion = nullptr) {
  const RTCGeometry geometry = rtcNewGeometry(device(), RTC_GEOMETRY_TYPE_TRIANGLE);
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

RTCGeometry instance_geometry(const AccelInstance& instance) {
  const RTCGeometry geometry = rtcNewGeometry(device(), RTC_GEOMETRY_TYPE_INSTANCE);
  rtcSetGeometryInstancedScene(geometry, instance.accel->scene());
  const auto set_transform = [&](unsigned step, const Mat4& to_world) {
    rtcSetGeometryTransform(geometry, step, RTC_FORMAT_FLOAT4X4_COLUMN_MAJOR, &to_world[0][0]);
  };
  if (instance.motion) {
    rtcSetGeometryTimeStepCount(geometry, static_cast<unsigned>(instance.motion->steps()));
    for (unsigned i = 0; i < instance.motion->steps(); ++i) set_transform(i, instance.motion->to_world[i]);
  } else {
    set_transform(0, instance.to_world);
  }
  rtcCommitGeometry(geometry);
  return geometry;
}

RTCGeometry shape_geometry(const AccelInstance& instance) {
  const AnalyticShape& shape = *instance.shape;
  if (shape.kind == AnalyticShape::Kind::cylinder) return cylinder_geometry(device(), instance);
  const bool disk = shape.kind == AnalyticShape::Kind::disk;
  const RTCGeometry geometry =
      rtcNewGeometry(device(), disk ? RTC_GEOMETRY_TYPE_ORIENTED_DISC_POINT : RTC_GEOMETRY_TYPE_SPHERE_POINT);
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

// The context of a query; Embree requires its own context as the first member.
struct TraceContext {
  RTCIntersectContext embree;
  const OpacityTest* opacity;
  const uint32_t* seeds;
};

// The instance of a hit. Geometry ids of the top level are instance numbers, for instances and for meshes in the top
// level itself.
uint32_t instance_of(uint32_t inst_id, uint32_t geom_id) {
  return inst_id != RTC_INVALID_GEOMETRY_ID ? inst_id : geom_id;
}

void test_opacity(const RTCFilterFunctionNArguments* args) {
  const auto* context = reinterpret_cast<const TraceContext*>(args->context);
  const unsigned n = args->N;
  for (unsigned i = 0; i < n; ++i) {
    if (args->valid[i] == 0) continue;
    const uint32_t instance = instance_of(RTCHitN_instID(args->hit, n, i, 0), RTCHitN_geomID(args->hit, n, i));
    const uint32_t ray = n == 1 ? 0 : RTCRayN_id(args->ray, n, i);
    if (!context->opacity->blocks_ray(instance, RTCHitN_primID(args->hit, n, i), RTCHitN_u(args->hit, n, i),
                                      RTCHitN_v(args->hit, n, i), context->seeds[ray]))
      args->valid[i] = 0;
  }
}

TraceContext make_context(const OpacityTest* opacity, const uint32_t* seeds, bool coherent) {
  TraceContext context{};
  rtcInitIntersectContext(&context.embree);
  if (coherent) context.embree.flags = RTC_INTERSECT_CONTEXT_FLAG_COHERENT;
  if (opacity) context.embree.filter = test_opacity;
  context.opacity = opacity;
  context.seeds = seeds;
  return context;
}

void fill(RTCRay& r, const Ray& ray, float time) {
  r.org_x = ray.origin.x;
  r.org_y = ray.origin.y;
  r.org_z = ray.origin.z;
  r.dir_x = ray.direction.x;
  r.dir_y = ray.direction.y;
  r.dir_z = ray.direction.z;
  r.tnear = ray.tnear;
  r.tfar = ray.tfar;
  r.time = time;
  r.mask = 0xffffffffU;
  r.id = 0;
  r.flags = 0;
}

static_assert(RTC_INVALID_GEOMETRY_ID == 0xffffffffU);

struct alignas(64) LaneMask {
  int valid[RayPacket::kSize];
};

// The mask of the first `count` lanes of a packet for Embree.
const LaneMask& first_lanes(int count) {
  static constexpr auto kMasks = [] {
    std::array<LaneMask, RayPacket::kSize + 1> masks{};
    for (int n = 0; n <= RayPacket::kSize; ++n)
      for (int i = 0; i < RayPacket::kSize; ++i) masks[static_cast<size_t>(n)].valid[i] = i < n ? -1 : 0;
    return masks;
  }();
  return kMasks[static_cast<size_t>(count)];
}

}  // namespace

MeshAccel::MeshAccel(std::shared_ptr<const Mesh> mesh) : mesh_(std::move(mesh)), scene_(new_scene()) {
  const RTCGeometry geometry = triangle_geometry(*mesh_);
  rtcAttachGeometryByID(scene_, geometry, 0);
  rtcReleaseGeometry(geometry);
  rtcCommitScene(scene_);
}

MeshAccel::~MeshAccel() { rtcReleaseScene(scene_); }

Accel::Accel(std::span<const AccelInstance> instances)
    : scene_(new_scene()), instances_(instances.begin(), instances.end()) {
  for (uint32_t i = 0; i < instances_.size(); ++i) {
    const AccelInstance& instance = instances_[i];
    if (!instance.shape && instance.mesh->triangles.empty()) continue;
    has_shapes_ = has_shapes_ || instance.shape;
    const RTCGeometry geometry = instance.shape   ? shape_geometry(instance)
                                 : instance.accel ? instance_geometry(instance)
                                                  : triangle_geometry(*instance.mesh, instance.motion.get());
    rtcAttachGeometryByID(scene_, geometry, i);
    rtcReleaseGeometry(geometry);
  }
  commit_scene(scene_);
}

Accel::~Accel() { rtcReleaseScene(scene_); }

void Accel::intersect(const Ray& ray, const OpacityTest* opacity, uint32_t ray_seed, Hit& hit, float time) const {
  TraceContext context = make_context(opacity, &ray_seed, false);
  RTCRayHit query;
  fill(query.ray, ray, time);
  query.hit.geomID = RTC_INVALID_GEOMETRY_ID;
  query.hit.instID[0] = RTC_INVALID_GEOMETRY_ID;
  rtcIntersect1(scene_, &context.embree, &query);
  hit.instance =
      query.hit.geomID == RTC_INVALID_GEOMETRY_ID ? Hit::kNone : instance_of(query.hit.instID[0], query.hit.geomID);
  hit.triangle = query.hit.primID;
  hit.u = query.hit.u;
  hit.v = query.hit.v;
  hit.t = query.ray.tfar;
  if (has_shapes_ && is_shape(query.hit.instID[0], query.hit.geomID)) {
    const Vec2 uv = shape_coordinates(query.hit.geomID, ray.origin + ray.direction * hit.t, time);
    hit.u = uv.x;
    hit.v = uv.y;
  }
}

Vec2 Accel::shape_coordinates(uint32_t instance, const Vec3& point, float time) const {
  const AccelInstance& i = instances_[instance];
  return i.motion ? i.shape->placed(i.motion->matrix_at(time)).uv_of(point) : i.shape->uv_of(point);
}

// Values that are equal for all rays are written once, since Embree does not change them.
RayPacket::RayPacket() : query_{} {
  for (int i = 0; i < kSize; ++i) {
    query_.ray.mask[i] = 0xffffffffU;
    query_.ray.id[i] = static_cast<unsigned>(i);
  }
}

void Accel::intersect(RayPacket& packet, int count, bool coherent, const OpacityTest* opacity,
                      const uint32_t* seeds) const {
  const LaneMask& lanes = first_lanes(count);
  std::memset(packet.query_.hit.geomID, 0xff, sizeof packet.query_.hit.geomID);
  std::memset(packet.query_.hit.instID, 0xff, sizeof packet.query_.hit.instID);
  TraceContext context = make_context(opacity, seeds, coherent);
  rtcIntersect16(lanes.valid, scene_, &context.embree, &packet.query_);
  if (!has_shapes_) return;
  const RTCRay16& ray = packet.query_.ray;
  RTCHit16& hit = packet.query_.hit;
  for (int i = 0; i < count; ++i) {
    if (!is_shape(hit.instID[0][i], hit.geomID[i])) continue;
    const Vec3 origin(ray.org_x[i], ray.org_y[i], ray.org_z[i]);
    const Vec2 uv = shape_coordinates(hit.geomID[i], origin + packet.direction(i) * ray.tfar[i], ray.time[i]);
    hit.u[i] = uv.x;
    hit.v[i] = uv.y;
  }
}

void Accel::occluded(RayPacket& packet, int count, const OpacityTest* opacity, const uint32_t* seeds) const {
  const LaneMask& lanes = first_lanes(count);
  TraceContext context = make_context(opacity, seeds, false);
  rtcOccluded16(lanes.valid, scene_, &context.embree, &packet.query_.ray);
}

Bounds Accel::bounds() const {
  RTCBounds b;
  rtcGetSceneBounds(scene_, &b);
  Bounds result;
  if (b.lower_x <= b.upper_x) {
    result.min = Vec3(b.lower_x, b.lower_y, b.lower_z);
    result.max = Vec3(b.upper_x, b.upper_y, b.upper_z);
  }
  return result;
}

size_t embree_memory() {
  return static_cast<size_t>(std::max<int64_t>(0, memory_counter().load(std::memory_order_relaxed)));
}

// Sets the bits "flush to zero" and "denormals are zero" of the SSE control register.
void prepare_thread_for_rays() { _mm_setcsr(_mm_getcsr() | 0x8040U); }

}  // namespace etendue
