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

#include "geometry/mesh.h"
#include "geometry/ray.h"

namespace etendue {

struct Hit {
  static constexpr uint32_t kNone = 0xffffffffU;
  uint32_t instance = kNone, triangle = 0;
  float u = 0, v = 0;  // barycentric weights of vertices 1 and 2
  float t = kInfinity;

  explicit operator bool() const { return instance != kNone; }
};

// Decides whether a hit stops the ray; only scenes with transparency have one. Called from many threads.
class OpacityTest {
 public:
  virtual ~OpacityTest() = default;
  virtual bool stops(uint32_t instance, uint32_t triangle, float u, float v, uint32_t ray_seed) const = 0;
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
  std::shared_ptr<const MeshAccel> accel;  // null: the mesh stands in the top level, and is in world space
  Mat4 to_world{1};                        // of an instanced mesh
};

class Accel {
 public:
  // Instance i of `instances` is Hit::instance i.
  explicit Accel(std::span<const AccelInstance> instances);
  ~Accel();
  Accel(const Accel&) = delete;
  Accel& operator=(const Accel&) = delete;

  // The nearest hit in [tnear, tfar]. `ray_seed` drives stochastic opacity.
  void intersect(const Ray& ray, const OpacityTest* opacity, uint32_t ray_seed, Hit& hit) const;
  // Whether anything is hit in [tnear, tfar].
  bool occluded(const Ray& ray, const OpacityTest* opacity, uint32_t ray_seed) const;

  static constexpr int kPacket = 16;
  // Up to kPacket coherent rays at once: several times faster than one by one.
  void intersect(std::span<const Ray> rays, std::span<const uint32_t> seeds, const OpacityTest* opacity,
                 std::span<Hit> hits) const;

  Bounds bounds() const;

 private:
  RTCScene scene_;
  std::vector<AccelInstance> kept_;  // what Embree points to
};

// Bytes that Embree holds at the moment, all scenes together.
size_t embree_memory();

// Rays on this thread run with denormals flushed to zero, as Embree wants it.
void prepare_thread_for_rays();

}  // namespace etendue
