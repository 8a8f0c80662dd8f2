#include "geometry/accel.h"

#include <immintrin.h>

#include <array>
#include <cstring>

#include "geometry/moved_instances.h"
#include "geometry/top_level.h"

namespace etendue {
namespace {

// The context of a query; Embree requires its own context as the first member.
struct TraceContext {
  RTCIntersectContext embree;
  const OpacityTest* opacity;
  const uint32_t* seeds;
  const MovedInstances* hidden = nullptr;             // instances that the rays ignore, or null
  const std::vector<MovedInstance>* moved = nullptr;  // what instance ids are indices into; null: they are numbers

  void ignore_hidden(const MovedInstances& instances);
};

// The instance of a hit. Geometry ids of the top level are instance numbers, for instances and for meshes in the top
// level itself.
uint32_t instance_of(uint32_t inst_id, uint32_t geom_id) {
  return inst_id != RTC_INVALID_GEOMETRY_ID ? inst_id : geom_id;
}

// Rejects hits on hidden instances and those that the opacity test lets pass.
void filter_hits(const RTCFilterFunctionNArguments* args) {
  const auto* context = reinterpret_cast<const TraceContext*>(args->context);
  const unsigned n = args->N;
  for (unsigned i = 0; i < n; ++i) {
    if (args->valid[i] == 0) continue;
    const uint32_t instance = instance_of(RTCHitN_instID(args->hit, n, i, 0), RTCHitN_geomID(args->hit, n, i));
    const uint32_t ray = n == 1 ? 0 : RTCRayN_id(args->ray, n, i);
    if (context->hidden && context->hidden->is_hidden(instance)) {
      args->valid[i] = 0;
      continue;
    }
    if (!context->opacity) continue;
    const uint32_t number = context->moved ? (*context->moved)[instance].number : instance;
    if (!context->opacity->blocks_ray(number, RTCHitN_primID(args->hit, n, i), RTCHitN_u(args->hit, n, i),
                                      RTCHitN_v(args->hit, n, i), context->seeds[ray]))
      args->valid[i] = 0;
  }
}

void TraceContext::ignore_hidden(const MovedInstances& instances) {
  hidden = &instances;
  embree.filter = filter_hits;
}

TraceContext make_context(const OpacityTest* opacity, const uint32_t* seeds, bool coherent) {
  TraceContext context{};
  rtcInitIntersectContext(&context.embree);
  if (coherent) context.embree.flags = RTC_INTERSECT_CONTEXT_FLAG_COHERENT;
  if (opacity) context.embree.filter = filter_hits;
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

Accel::Accel(std::span<const AccelInstance> instances)
    : top_level_(std::make_shared<const TopLevel>(instances)), unmoved_(top_level_->bounds()), bounds_(unmoved_) {}

Accel::Accel(const Accel& other, std::vector<MovedInstance> moved, const Bounds& unmoved)
    : top_level_(other.top_level_),
      moved_(std::make_unique<const MovedInstances>(std::move(moved), top_level_->size())),
      unmoved_(unmoved),
      bounds_(unmoved) {
  bounds_.extend(moved_->bounds());
}

Accel::~Accel() = default;

std::span<const MovedInstance> Accel::moved() const {
  return moved_ ? std::span<const MovedInstance>(moved_->list()) : std::span<const MovedInstance>();
}

void Accel::intersect(const Ray& ray, const OpacityTest* opacity, uint32_t ray_seed, Hit& hit, float time) const {
  TraceContext context = make_context(opacity, &ray_seed, false);
  if (moved_) context.ignore_hidden(*moved_);
  RTCRayHit query;
  fill(query.ray, ray, time);
  query.hit.geomID = RTC_INVALID_GEOMETRY_ID;
  query.hit.instID[0] = RTC_INVALID_GEOMETRY_ID;
  rtcIntersect1(top_level_->scene(), &context.embree, &query);
  hit.instance =
      query.hit.geomID == RTC_INVALID_GEOMETRY_ID ? Hit::kNone : instance_of(query.hit.instID[0], query.hit.geomID);
  const bool on_shape = top_level_->has_shapes() && top_level_->is_shape(query.hit.instID[0], query.hit.geomID);
  bool on_moved = false;
  if (moved_) {
    query.hit.geomID = query.hit.instID[0] = RTC_INVALID_GEOMETRY_ID;
    TraceContext second = make_context(opacity, &ray_seed, false);
    second.moved = &moved_->list();
    rtcIntersect1(moved_->scene(), &second.embree, &query);
    on_moved = query.hit.geomID != RTC_INVALID_GEOMETRY_ID;
    if (on_moved) hit.instance = moved_->list()[query.hit.instID[0]].number;
  }
  hit.triangle = query.hit.primID;
  hit.u = query.hit.u;
  hit.v = query.hit.v;
  hit.t = query.ray.tfar;
  if (on_shape && !on_moved) {
    const Vec2 uv = top_level_->shape_coordinates(hit.instance, ray.origin + ray.direction * hit.t, time);
    hit.u = uv.x;
    hit.v = uv.y;
  }
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
  if (moved_) context.ignore_hidden(*moved_);
  rtcIntersect16(lanes.valid, top_level_->scene(), &context.embree, &packet.query_);
  if (moved_) intersect_moved(packet, count, coherent, opacity, seeds);
  if (!top_level_->has_shapes()) return;
  const RTCRay16& ray = packet.query_.ray;
  RTCHit16& hit = packet.query_.hit;
  for (int i = 0; i < count; ++i) {
    if (!top_level_->is_shape(hit.instID[0][i], hit.geomID[i])) continue;
    const Vec3 origin(ray.org_x[i], ray.org_y[i], ray.org_z[i]);
    const Vec3 point = origin + packet.direction(i) * ray.tfar[i];
    const Vec2 uv = top_level_->shape_coordinates(hit.geomID[i], point, ray.time[i]);
    hit.u[i] = uv.x;
    hit.v[i] = uv.y;
  }
}

// Rays that hit a moved instance before their hit so far get the hit there.
void Accel::intersect_moved(RayPacket& packet, int count, bool coherent, const OpacityTest* opacity,
                            const uint32_t* seeds) const {
  RTCHit16& hit = packet.query_.hit;
  unsigned geometry[RayPacket::kSize], instance[RayPacket::kSize];  // of the hits so far
  std::memcpy(geometry, hit.geomID, sizeof geometry);
  std::memcpy(instance, hit.instID[0], sizeof instance);
  std::memset(hit.geomID, 0xff, sizeof hit.geomID);
  std::memset(hit.instID, 0xff, sizeof hit.instID);
  TraceContext context = make_context(opacity, seeds, coherent);
  context.moved = &moved_->list();
  rtcIntersect16(first_lanes(count).valid, moved_->scene(), &context.embree, &packet.query_);
  for (int i = 0; i < count; ++i) {
    if (hit.geomID[i] != RTC_INVALID_GEOMETRY_ID) {
      hit.instID[0][i] = moved_->list()[hit.instID[0][i]].number;
    } else {
      hit.geomID[i] = geometry[i];
      hit.instID[0][i] = instance[i];
    }
  }
}

void Accel::occluded(RayPacket& packet, int count, const OpacityTest* opacity, const uint32_t* seeds) const {
  const LaneMask& lanes = first_lanes(count);
  TraceContext context = make_context(opacity, seeds, false);
  if (moved_) context.ignore_hidden(*moved_);
  rtcOccluded16(lanes.valid, top_level_->scene(), &context.embree, &packet.query_.ray);
  if (!moved_) return;
  // Embree skips the rays that are occluded already.
  TraceContext second = make_context(opacity, seeds, false);
  second.moved = &moved_->list();
  rtcOccluded16(lanes.valid, moved_->scene(), &second.embree, &packet.query_.ray);
}

// Sets the bits "flush to zero" and "denormals are zero" of the SSE control register.
void prepare_thread_for_rays() { _mm_setcsr(_mm_getcsr() | 0x8040U); }

}  // namespace etendue
