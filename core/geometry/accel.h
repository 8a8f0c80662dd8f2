// Ray intersection: Embree behind a plain interface.
//
// A MeshAccel is built once for a mesh and kept for as long as the mesh lives. An Accel is the top level over the
// instances of one scene: building it anew after a transform costs what the instances cost, never what the meshes cost.
// Small meshes that are used once stand in the top level itself, in world space, because an instance costs every ray
// that meets it.
#pragma once
#include <embree3/rtcore.h>

#include <memory>
#include <span>
#include <vector>

#include "geometry/analytic_shape.h"
#include "geometry/motion.h"
#include "geometry/ray.h"

namespace etendue {

struct Hit {
  static constexpr uint32_t kNone = 0xffffffffU;
  uint32_t instance = kNone, triangle = 0;
  float u = 0, v = 0;  // barycentric weights of vertices 1 and 2; of a round shape its own (round_shape.h)
  float t = kInfinity;

  explicit operator bool() const { return instance != kNone; }
};

// Decides whether a hit stops the ray; only scenes with transparency have one. Called from many threads.
class OpacityTest {
 public:
  virtual ~OpacityTest() = default;
  virtual bool blocks_ray(uint32_t instance, uint32_t triangle, float u, float v, uint32_t ray_seed) const = 0;
};

// Sixteen rays and what they hit, as Embree takes them: number by number. Tracing them together is faster than one by
// one, several times so if they are coherent. Write rays well before they are traced: numbers that were just written
// stall the processor when they are read back sixteen at once.
class RayPacket {
 public:
  static constexpr int kSize = 16;

  RayPacket();

  void set(int lane, const Ray& ray) {
    RTCRay16& r = query_.ray;
    r.org_x[lane] = ray.origin.x, r.org_y[lane] = ray.origin.y, r.org_z[lane] = ray.origin.z;
    r.dir_x[lane] = ray.direction.x, r.dir_y[lane] = ray.direction.y, r.dir_z[lane] = ray.direction.z;
    r.tnear[lane] = ray.tnear, r.tfar[lane] = ray.tfar;
  }

  // When the ray is, from 0 at the shutter's opening to 1 at its closing; what stands still is the same at all times.
  void set_time(int lane, float time) { query_.ray.time[lane] = time; }

  Vec3 direction(int lane) const { return {query_.ray.dir_x[lane], query_.ray.dir_y[lane], query_.ray.dir_z[lane]}; }

  // After Accel::intersect.
  bool has_hit(int lane) const { return query_.hit.geomID[lane] != RTC_INVALID_GEOMETRY_ID; }
  [[gnu::always_inline]] void get(int lane, Hit& hit) const {
    // Top-level geometry ids are instance numbers, whether the hit lies in an instance or in the top level itself.
    const uint32_t in_instance = query_.hit.instID[0][lane];
    hit.instance = in_instance != RTC_INVALID_GEOMETRY_ID ? in_instance : query_.hit.geomID[lane];
    hit.triangle = query_.hit.primID[lane];
    hit.u = query_.hit.u[lane], hit.v = query_.hit.v[lane], hit.t = query_.ray.tfar[lane];
  }
  // After Accel::occluded.
  bool is_occluded(int lane) const { return query_.ray.tfar[lane] < 0; }

 private:
  friend class Accel;
  RTCRayHit16 query_;
};

class MeshAccel {
 public:
  explicit MeshAccel(std::shared_ptr<const Mesh> mesh);
  ~MeshAccel();
  MeshAccel(const MeshAccel&) = delete;
  MeshAccel& operator=(const MeshAccel&) = delete;

  RTCScene scene() const { return scene_; }
  const std::shared_ptr<const Mesh>& mesh() const { return mesh_; }

 private:
  std::shared_ptr<const Mesh> mesh_;
  RTCScene scene_;
};

struct AccelInstance {
  std::shared_ptr<const Mesh> mesh;
  std::shared_ptr<const MeshAccel> accel;          // null: the mesh stands in the top level, and is in world space
  Mat4 to_world{1};                                // of an instanced mesh
  std::shared_ptr<const Motion> motion = nullptr;  // null: it stands still; a mesh that deforms stands in the top level
  std::shared_ptr<const AnalyticShape> round = nullptr;  // instead of the mesh; placed where it stands still
};

class Accel {
 public:
  // Instance i of `instances` is Hit::instance i. What moves is where it is at the time of each ray.
  explicit Accel(std::span<const AccelInstance> instances);
  ~Accel();
  Accel(const Accel&) = delete;
  Accel& operator=(const Accel&) = delete;

  // The nearest hit in [tnear, tfar]. `ray_seed` drives stochastic opacity.
  void intersect(const Ray& ray, const OpacityTest* opacity, uint32_t ray_seed, Hit& hit, float time = 0) const;

  // The same for the first `count` rays of a packet; ray i has seeds[i]. `coherent`: they start close together and go
  // about the same way.
  void intersect(RayPacket& packet, int count, bool coherent, const OpacityTest* opacity, const uint32_t* seeds) const;
  // Whether anything is hit in [tnear, tfar].
  void occluded(RayPacket& packet, int count, const OpacityTest* opacity, const uint32_t* seeds) const;

  Bounds bounds() const;

 private:
  // Of a hit on a round shape, whose place Embree does not tell: its u and v.
  Vec2 place_on_round(uint32_t instance, const Vec3& point, float time) const;
  bool is_round(uint32_t in_instance, uint32_t geometry) const {
    return in_instance == 0xffffffffU && geometry < kept_.size() && kept_[geometry].round;
  }

  RTCScene scene_;
  std::vector<AccelInstance> kept_;  // what Embree points to
  bool any_round_ = false;
};

// Bytes that Embree holds at the moment, all scenes together.
size_t embree_memory();

// Rays on this thread run with denormals flushed to zero, as Embree wants it.
void prepare_thread_for_rays();

}  // namespace etendue
