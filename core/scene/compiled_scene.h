// The scene that threads read: immutable, shared, compiled from a scene::Scene.
//
// Compiling reuses everything of the previous CompiledScene that an edit did not touch; `BuildReport` says what was
// built, and tests hold it to that: a camera or a material rebuilds no acceleration structure, a transform only the top
// level.
//
// Where the camera's shutter is open and something moves meanwhile, times say when: from 0 at the opening to 1 at the
// closing. They are only read of what moves.
#pragma once
#include <memory>
#include <vector>

#include "base/piecewise_constant.h"
#include "base/vectorize.h"
#include "camera/camera_ray.h"
#include "geometry/accel.h"
#include "light/sampling/light_table.h"
#include "material/surface_material.h"
#include "scene/build_report.h"
#include "scene/scene.h"

namespace etendue::scene {

struct InstanceData {
  std::shared_ptr<const Mesh> mesh;  // positions in world space where `to_world` is the identity
  Mat4 to_world{1};
  Mat3 normal_to_world{1};  // inverse transpose
  bool identity = true;
  bool smooth = false;    // has vertex normals
  bool textured = false;  // has texture coordinates or vertex colours
  bool mirrored = false;  // negative determinant: winding is turned, glTF 2.0, 3.7.4
  uint32_t material = 0;
  uint32_t node = 0;                  // the object that a user picks
  float cosine_exponent = 0;          // of what it emits, see Light
  uint32_t first_light = kNotALight;  // light number of its first triangle
  // How it moves, or null; all the rest is as it is at the opening. One that deforms is in world space then.
  std::shared_ptr<const Motion> motion = nullptr;
  // A light that is a sphere or a disk; the mesh is only as large as it then.
  std::shared_ptr<const AnalyticShape> round = nullptr;
  static constexpr uint32_t kNotALight = 0xffffffffU;
};

// A point on a surface, ready for shading.
struct SurfacePoint {
  Vec3 position{0};
  Vec3 ng{0, 0, 1};  // geometric normal, unit, on the front side
  Frame shading;     // z is the shading normal, on the front side
  TexturePoint texture;
  const InstanceData* instance = nullptr;
  const SurfaceMaterial* material = nullptr;
  uint32_t triangle = 0;
  float offset = 0;    // how far rounding may have put `position` off the surface, metres
  bool front = true;   // the side the ray came from
  Vec3 coat{0, 0, 1};  // normal of the clear coat in the shading frame, where it is another one

  // What a direction gets of the radiance that is emitted along the normal.
  float beam(const Vec3& direction) const {
    return instance->cosine_exponent == 0 ? 1 : std::pow(std::abs(glm::dot(ng, direction)), instance->cosine_exponent);
  }

  // A ray that leaves towards `direction` and does not hit the surface it starts on.
  void spawn(const Vec3& direction, Ray& ray) const {
    ray.origin = position + off_surface(direction);
    ray.tnear = 0;
    ray.direction = direction;
    ray.tfar = kInfinity;
  }

  // The segment towards what lies at `distance` along `direction`, short of it by more than rounding can have moved
  // either end; its direction is as long as it is.
  void spawn_segment(const Vec3& direction, float distance, Ray& ray) const {
    if (std::isinf(distance)) return spawn(direction, ray);
    const Vec3 off = off_surface(direction);
    ray.origin = position + off;
    ray.tnear = 0;
    ray.direction = direction * std::max(0.0f, distance * (1 - 1e-4f) - 2 * offset) - off;
    ray.tfar = 1;
  }

 private:
  Vec3 off_surface(const Vec3& direction) const { return ng * (glm::dot(direction, ng) >= 0 ? offset : -offset); }
};

class CompiledScene final : public OpacityTest {
 public:
  Hit intersect(const Ray& ray, uint32_t ray_seed, float time = 0) const {
    Hit hit;
    accel_->intersect(ray, opacity(), ray_seed, hit, time);
    return hit;
  }
  void intersect(RayPacket& packet, int count, bool coherent, const uint32_t* seeds) const {
    accel_->intersect(packet, count, coherent, opacity(), seeds);
  }
  void occluded(RayPacket& packet, int count, const uint32_t* seeds) const {
    accel_->occluded(packet, count, opacity(), seeds);
  }

  // Where rays hit, one point for each; wo[i] points back along the ray of hits[i], which was at times[i]. Without
  // times all is as it was at the opening.
  void surfaces(std::span<const Vec3> wo, std::span<const Hit> hits, SurfacePoint* points,
                const float* times = nullptr) const;

  // Radiance that the surface sends there, on the side the ray came from; single-sided materials shine from their front
  // only.
  Rgb emitted(const SurfacePoint& point, const Vec3& direction) const;
  // What a sampled light sends to its receiver, textures included.
  Rgb radiance_of(const LightSample& sample) const {
    return sample.textured ? textured_radiance_of(sample) : sample.radiance;
  }
  // Where a ray leaves a triangle, for `surfaces`; `side` is the normal of the side that it leaves.
  void locate(const Emission& emission, Hit& hit, Vec3& side) const;
  // What leaves the light along the ray, before SurfacePoint::beam: radiance, and the other quantities where
  // Emission::radiance names them. `point` is that of a triangle.
  Rgb emitted(const Emission& emission, const SurfacePoint* point) const {
    return emission.textured ? point->material->emission_at(point->texture) : emission.radiance;
  }
  // The number of the light that this point lies on, or InstanceData::kNotALight.
  uint32_t light_at(const SurfacePoint& point) const {
    const uint32_t first = point.instance->first_light;
    return first == InstanceData::kNotALight ? first : first + point.triangle;  // a round shape is its number 0
  }

  // Whether light travels here as it does there: nothing but the camera differs.
  bool same_light(const CompiledScene& other) const {
    return accel_ == other.accel_ && instances_ == other.instances_ && materials_ == other.materials_ &&
           textures_ == other.textures_ && lights_ == other.lights_;
  }

  const LightTable& lights() const { return *lights_; }
  const Camera& camera() const { return camera_; }
  const std::vector<InstanceData>& instances() const { return *instances_; }
  const std::vector<SurfaceMaterial>& materials() const { return *materials_; }
  const Scene& description() const { return *description_; }
  const BuildReport& report() const { return report_; }
  const Bounds& bounds() const { return bounds_; }
  size_t triangle_count() const { return triangles_; }
  bool has_transparency() const { return transparency_; }
  // What moves while the shutter is open, the first of several: "node 'Wheel'"; empty if all stands still.
  std::string moving() const;
  // How the camera moves, or null.
  const std::shared_ptr<const CameraMotion>& camera_motion() const { return camera_motion_; }
  size_t memory() const;  // bytes of arrays, without Embree's

  bool blocks_ray(uint32_t instance, uint32_t triangle, float u, float v, uint32_t ray_seed) const override;

 private:
  friend class Compiler;
  Rgb textured_radiance_of(const LightSample& sample) const;
  void finish(const Vec3& wo, const Hit& hit, SurfacePoint& point) const;
  // `time` is null for the opening.
  void bend(const Vec3& wo, const Hit& hit, const float* time, SurfacePoint& point) const;
  const OpacityTest* opacity() const { return transparency_ ? this : nullptr; }

  std::shared_ptr<const Scene> description_;
  std::shared_ptr<const Accel> accel_;
  std::shared_ptr<const std::vector<InstanceData>> instances_;
  std::shared_ptr<const std::vector<SurfaceMaterial>> materials_;
  std::shared_ptr<const std::vector<Texture>> textures_;
  std::shared_ptr<const LightTable> lights_;
  std::vector<std::shared_ptr<const MeshAccel>>
      mesh_accels_;  // one per instance, null where it stands in the top level
  Camera camera_;
  std::shared_ptr<const CameraMotion> camera_motion_;
  int moving_node_ = -1;  // the first that moves a mesh or a light
  Bounds bounds_;
  BuildReport report_;
  size_t triangles_ = 0;
  bool transparency_ = false;
};

// `previous` may be null. The camera is given apart because it moves apart.
std::shared_ptr<const CompiledScene> compile(std::shared_ptr<const Scene> scene, const Camera& camera,
                                             const std::shared_ptr<const CompiledScene>& previous);

}  // namespace etendue::scene
