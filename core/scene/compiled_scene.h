// The scene that rendering threads read: immutable, shared, compiled from a scene::Scene.
//
// Compilation reuses all parts of the previous CompiledScene that an edit did not change, and BuildReport lists what
// was rebuilt. A camera or material edit rebuilds no acceleration structure; a transform rebuilds the top level only, and
// not even that if few of many instances move.
//
// With motion blur, times run from 0 when the shutter opens to 1 when it closes. They affect moving instances only.
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
#include "scene/solids.h"
#include "scene/start_media.h"

namespace etendue::scene {

// Which triangles of a mesh are lights, where textured emission is black on others.
struct EmittingTriangles {
  std::vector<uint32_t> numbers;  // per triangle: its number among those that emit, or InstanceData::kNotALight
  uint32_t count = 0;             // of triangles that emit
};

struct InstanceData {
  std::shared_ptr<const Mesh> mesh;  // in world space if `to_world` is the identity
  Mat4 to_world{1};
  Mat3 normal_to_world{1};  // inverse transpose
  bool identity = true;
  bool smooth = false;    // has vertex normals
  bool textured = false;  // has texture coordinates or vertex colours
  bool mirrored = false;  // negative determinant, which reverses the winding [glTF 2.0, sec. 3.7.4]
  uint32_t material = 0;
  uint32_t number = 0;                // index among the instances of the scene
  uint32_t node = 0;                  // the object that picking selects
  float cosine_exponent = 0;          // cosine exponent of its emission, see Light
  uint32_t first_light = kNotALight;  // light index of its first triangle that emits
  uint32_t solid = kNoSolid;          // number of the solid that it bounds
  // The motion, or null. All other members hold at shutter opening. A mesh that deforms is in world space.
  std::shared_ptr<const Motion> motion = nullptr;
  // The analytic shape of a sphere or disk light; the mesh only has its extent then.
  std::shared_ptr<const AnalyticShape> round = nullptr;
  // Null if it is no area light, or if all of its triangles are lights.
  std::shared_ptr<const EmittingTriangles> emitting = nullptr;
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
  float offset = 0;    // bound of the rounding error of `position`, metres
  bool front = true;   // the ray arrived at the front side
  Vec3 coat{0, 0, 1};  // normal of the clear coat in the shading frame
  // The media on both sides, null for a vacuum. Set only by transport models with media.
  const Solid* outside = nullptr;
  const Solid* inside = nullptr;
  // The point lies in a scattering medium, not on a surface. It has no instance; its geometric normal is arbitrary.
  bool in_volume = false;

  // Emitted radiance towards `direction`, relative to the radiance along the normal.
  float beam(const Vec3& direction) const {
    return instance->cosine_exponent == 0 ? 1 : std::pow(std::abs(glm::dot(ng, direction)), instance->cosine_exponent);
  }

  // A ray from this point towards `direction`, offset so that it does not hit the surface it starts on.
  void spawn(const Vec3& direction, Ray& ray) const {
    ray.origin = position + off_surface(direction);
    ray.tnear = 0;
    ray.direction = direction;
    ray.tfar = kInfinity;
  }

  // The segment to a point at `distance` along `direction`. It ends before that point by more than the rounding error
  // of both ends. The length of ray.direction is that of the segment.
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

  // The same, but rays stop at all boundaries of solids. The caller tests their opacity with `blocks_ray`.
  Hit intersect_solids(const Ray& ray, uint32_t ray_seed, float time) const;
  void intersect_solids(RayPacket& packet, int count, bool coherent, const uint32_t* seeds) const;

  // The surface points of hits. wo[i] is the reverse direction of the ray of hits[i], and times[i] its time; without
  // `times` all are at shutter opening.
  void surfaces(std::span<const Vec3> wo, std::span<const Hit> hits, SurfacePoint* points,
                const float* times = nullptr) const;

  // Radiance that the surface emits towards `direction` on the side where the ray arrived. Single-sided materials emit
  // from their front only.
  Rgb emitted(const SurfacePoint& point, const Vec3& direction) const;
  // Radiance from a sampled light towards its receiver, including emission textures.
  Rgb radiance_of(const LightSample& sample) const {
    return sample.textured ? textured_radiance_of(sample) : sample.radiance;
  }
  // The spectrum of a sampled light or of a surface; null if its colour determines it.
  const EmissionSpectrum* emission_spectrum(const LightSample& sample) const {
    return emission_spectra_ ? spectrum_of_light(sample) : nullptr;
  }
  static const EmissionSpectrum* emission_spectrum(const SurfacePoint& point) {
    return point.material->description.emission_spectrum.spectrum.get();
  }
  // The hit that corresponds to an emitted ray's origin on a triangle. `side` is the normal of the emitting side.
  void locate(const Emission& emission, Hit& hit, Vec3& side) const;
  // Emission along the ray, without the factor SurfacePoint::beam: radiance, or the quantity that Emission::radiance
  // documents. `point` is the origin on a triangle; it is read only if the emission is textured.
  Rgb emitted(const Emission& emission, const SurfacePoint* point) const {
    return emission.textured ? point->material->emission_at(point->texture) : emission.radiance;
  }
  // The index of the light that this point lies on, or InstanceData::kNotALight.
  uint32_t light_at(const SurfacePoint& point) const {
    const InstanceData& instance = *point.instance;
    if (instance.first_light == InstanceData::kNotALight) return InstanceData::kNotALight;
    if (!instance.emitting) return instance.first_light + point.triangle;  // a sphere or disk counts as one triangle
    const uint32_t number = instance.emitting->numbers[point.triangle];
    return number == InstanceData::kNotALight ? number : instance.first_light + number;
  }

  // Whether the scenes differ at most in the camera.
  bool same_light(const CompiledScene& other) const {
    return accel_ == other.accel_ && instances_ == other.instances_ && materials_ == other.materials_ &&
           textures_ == other.textures_ && lights_ == other.lights_;
  }

  const LightTable& lights() const { return *lights_; }
  // Empty if paths need no medium state.
  const Solids& solids() const { return *solids_; }
  // See Solids::scatters.
  bool scatters() const { return solids_->scatters(); }
  // Whether the atmosphere has no end, so that no light from infinity arrives.
  bool atmosphere_is_unbounded() const {
    return solids_->atmosphere() && !std::isfinite(solids_->atmosphere()->radius);
  }
  // See Solids::find_interface.
  bool find_interface(const MediumStack& stack, float time, Hit& hit, MediumInterface& interface) const {
    return solids_->find_interface(*instances_, stack, time, hit, interface);
  }
  // The solids that contain the start of a camera ray.
  MediumStack media_at_camera(const Ray& ray, float time) const {
    return start_media_->at_camera(*solids_, *instances_, ray, time);
  }
  // The solids around the start of a ray that leaves a light. For area lights `point` is the surface point, and
  // `origin` is offset from it to the side on which the ray leaves; otherwise `point` is null.
  void find_media_at_light(const Emission& emission, const SurfacePoint* point, const Vec3& origin,
                           MediumInterface& interface) const {
    start_media_->find_at_light(*solids_, *instances_, *lights_, emission, point, origin, interface);
  }

  const Camera& camera() const { return camera_; }
  const InstanceArray& instances() const { return *instances_; }
  const std::vector<SurfaceMaterial>& materials() const { return *materials_; }
  const Scene& description() const { return *description_; }
  const BuildReport& report() const { return report_; }
  const Bounds& bounds() const { return bounds_; }
  size_t triangle_count() const { return triangles_; }
  bool has_transparency() const { return transparency_; }
  // The first emitter with a spectrum, for messages: "light 'Bulb'". Empty if there is none.
  std::string emitter_with_spectrum() const;
  // Whether a material scatters light below its surface.
  bool has_subsurface() const { return subsurface_; }
  // The first moving object while the shutter is open, for messages: "node 'Wheel'". Empty if nothing moves.
  std::string moving() const;
  // The motion of the camera, or null.
  const std::shared_ptr<const CameraMotion>& camera_motion() const { return camera_motion_; }
  size_t memory() const;  // bytes of arrays, excluding Embree's structures

  bool blocks_ray(uint32_t instance, uint32_t triangle, float u, float v, uint32_t ray_seed) const override;

 private:
  friend class Compiler;
  Rgb textured_radiance_of(const LightSample& sample) const;
  const EmissionSpectrum* spectrum_of_light(const LightSample& sample) const;
  void finish(const Hit& hit, SurfacePoint& point) const;
  // Sets TexturePoint::footprint.
  void set_footprints(const Hit& hit, SurfacePoint& point) const;
  // Sets the shading frame. `time` is null for shutter opening.
  void bend(const Vec3& wo, const Hit& hit, const float* time, SurfacePoint& point) const;
  const OpacityTest* opacity() const { return transparency_ ? this : nullptr; }

  std::shared_ptr<const Scene> description_;
  std::shared_ptr<const Accel> accel_;
  std::shared_ptr<const InstanceArray> instances_;
  std::shared_ptr<const std::vector<SurfaceMaterial>> materials_;
  std::shared_ptr<const std::vector<Texture>> textures_;
  std::shared_ptr<const LightTable> lights_;
  std::shared_ptr<const Solids> solids_;
  std::shared_ptr<const StartMedia> start_media_;
  std::vector<std::shared_ptr<const MeshAccel>> mesh_accels_;  // of the meshes that are not part of the top level
  // By node: its first instance, or kNoInstance. Null if the scene has few instances.
  std::shared_ptr<const std::vector<uint32_t>> first_instances_;
  static constexpr uint32_t kNoInstance = 0xffffffffU;
  Camera camera_;
  std::shared_ptr<const CameraMotion> camera_motion_;
  int moving_node_ = -1;  // the first node that moves a mesh or a light
  Bounds bounds_;
  BuildReport report_;
  size_t triangles_ = 0;
  size_t geometry_memory_ = 0, emission_memory_ = 0;  // bytes of instances with their meshes, and of EmittingTriangles
  bool transparency_ = false, subsurface_ = false, emission_spectra_ = false;
  // The width of a pixel in the centre of the image: metres, and metres per metre of distance from the camera. Zero if
  // the resolution is unknown.
  float pixel_width_ = 0, pixel_angle_ = 0;
};

// Compiles a scene for a camera, which is an argument of its own because it changes most often. `previous` may be null.
// `image_height` is the height of the image in pixels, for the mip levels of tiled textures; 0 selects level 0.
std::shared_ptr<const CompiledScene> compile(std::shared_ptr<const Scene> scene, const Camera& camera,
                                             const std::shared_ptr<const CompiledScene>& previous,
                                             int image_height = 0);

}  // namespace etendue::scene
