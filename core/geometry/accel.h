// Ray intersection with Embree
//
// Accel is the top-level structure over the instances of a scene, whose meshes have structures of their own (MeshAccel).
// Rebuilding it after a change of transforms costs time proportional to the number of instances. Small meshes
// that occur once are stored in the top level itself, in world space, because entering an instance costs time for every ray
// that hits its bounds.
//
// After a few of many instances have moved, an Accel can share the structure from before, in which rays ignore these
// instances, and trace each ray through a small structure of the moved ones as well. It is ready at once; rays take
// longer.
#pragma once
#include <embree3/rtcore.h>

#include <memory>
#include <span>
#include <vector>

#include "geometry/accel_instance.h"
#include "geometry/mesh_accel.h"
#include "geometry/ray.h"

namespace etendue {

class TopLevel;        // geometry/top_level.h
class MovedInstances;  // geometry/moved_instances.h

struct Hit {
  static constexpr uint32_t kNone = 0xffffffffU;
  uint32_t instance = kNone, triangle = 0;
  float u = 0, v = 0;  // barycentric weights of vertices 1 and 2, or the coordinates on an AnalyticShape
  float t = kInfinity;

  explicit operator bool() const { return instance != kNone; }
};

// Stochastic opacity. Only scenes with transparency have one. Called from several threads concurrently.
class OpacityTest {
 public:
  virtual ~OpacityTest() = default;
  // Whether this hit blocks a ray with this seed.
  virtual bool blocks_ray(uint32_t instance, uint32_t triangle, float u, float v, uint32_t ray_seed) const = 0;
};

// Sixteen rays and their hits in structure-of-arrays layout. Tracing a packet is faster than tracing single rays, and
// several times faster if the rays are coherent. Rays should be written some time before they are traced: reading
// values as a vector directly after they were stored one by one causes store-forwarding stalls.
class RayPacket {
 public:
  static constexpr int kSize = 16;

  RayPacket();

  void set(int lane, const Ray& ray) {
    RTCRay16& r = query_.ray;
    r.org_x[lane] = ray.origin.x;
    r.org_y[lane] = ray.origin.y;
    r.org_z[lane] = ray.origin.z;
    r.dir_x[lane] = ray.direction.x;
    r.dir_y[lane] = ray.direction.y;
    r.dir_z[lane] = ray.direction.z;
    r.tnear[lane] = ray.tnear;
    r.tfar[lane] = ray.tfar;
  }

  // The time of the ray, from 0 at the opening to 1 at the closing of the shutter; 0 by default.
  void set_time(int lane, float time) { query_.ray.time[lane] = time; }

  Vec3 direction(int lane) const { return {query_.ray.dir_x[lane], query_.ray.dir_y[lane], query_.ray.dir_z[lane]}; }

  // The hit of a ray after Accel::intersect.
  bool has_hit(int lane) const { return query_.hit.geomID[lane] != RTC_INVALID_GEOMETRY_ID; }
  [[gnu::always_inline]] void get(int lane, Hit& hit) const {
    const uint32_t instance = query_.hit.instID[0][lane];
    hit.instance = instance != RTC_INVALID_GEOMETRY_ID ? instance : query_.hit.geomID[lane];
    hit.triangle = query_.hit.primID[lane];
    hit.u = query_.hit.u[lane];
    hit.v = query_.hit.v[lane];
    hit.t = query_.ray.tfar[lane];
  }
  // The result for a ray after Accel::occluded.
  bool is_occluded(int lane) const { return query_.ray.tfar[lane] < 0; }

 private:
  friend class Accel;
  RTCRayHit16 query_;
};

class Accel {
 public:
  // Hits on instances[i] have Hit::instance == i. The meshes and shapes must not change afterwards.
  explicit Accel(std::span<const AccelInstance> instances);
  // The instances of `other`, those of the list at other places. It includes those of the list of `other`. `unmoved` are
  // the bounds of the instances that are not in the list. The time does not depend on their number.
  Accel(const Accel& other, std::vector<MovedInstance> moved, const Bounds& unmoved);
  ~Accel();
  Accel(const Accel&) = delete;
  Accel& operator=(const Accel&) = delete;

  // The nearest hit in [tnear, tfar]. `ray_seed` drives stochastic opacity.
  void intersect(const Ray& ray, const OpacityTest* opacity, uint32_t ray_seed, Hit& hit, float time = 0) const;

  // Intersects the first `count` rays of a packet; ray i has the seed seeds[i]. `coherent` states that the rays start
  // close together in similar directions.
  void intersect(RayPacket& packet, int count, bool coherent, const OpacityTest* opacity, const uint32_t* seeds) const;
  // Tests whether the first `count` rays of a packet hit anything in [tnear, tfar].
  void occluded(RayPacket& packet, int count, const OpacityTest* opacity, const uint32_t* seeds) const;

  const Bounds& bounds() const { return bounds_; }
  // The bounds of the instances that are not in the list of moved ones.
  const Bounds& unmoved_bounds() const { return unmoved_; }
  std::span<const MovedInstance> moved() const;

 private:
  void intersect_moved(RayPacket& packet, int count, bool coherent, const OpacityTest* opacity,
                       const uint32_t* seeds) const;

  std::shared_ptr<const TopLevel> top_level_;
  std::unique_ptr<const MovedInstances> moved_;  // null: none
  Bounds unmoved_, bounds_;
};

// Enables flush-to-zero for denormals on this thread, as Embree recommends. Call it on every thread that traces rays.
void prepare_thread_for_rays();

}  // namespace etendue
