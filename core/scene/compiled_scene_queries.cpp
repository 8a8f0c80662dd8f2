#include "scene/compiled_scene.h"

#include <unordered_map>

#include "base/hash.h"
#include "base/vectorize.h"
#include "light/placed_light.h"
#include "scene/facet.h"
#include "scene/texture_point.h"

namespace etendue::scene {
namespace {

Vec3 barycentric(const std::vector<Vec3>& values, const Triangle& t, float u, float v) {
  return values[t[0]] * (1 - u - v) + values[t[1]] * u + values[t[2]] * v;
}

// The triangles of many hits as a structure of arrays, for vectorised computation.
struct Facets {
  static constexpr size_t kSize = 64;
  template <class T>
  using Array = std::array<T, kSize>;

  Vec3Lanes<kSize> p0, p1, p2, wo;
  alignas(64) Array<float> u, v, winding;
  Vec3Lanes<kSize> position, ng, x, y;
  alignas(64) Array<float> offset, facing;  // facing: cosine between wo and the front normal

  void set(size_t i, const InstanceData& instance, const Hit& hit, const Vec3& back) {
    const Mesh& mesh = *instance.mesh;
    const Triangle& t = mesh.triangles[hit.triangle];
    if (instance.identity) {
      p0.set(i, mesh.positions[t[0]]);
      p1.set(i, mesh.positions[t[1]]);
      p2.set(i, mesh.positions[t[2]]);
    } else if (instance.round) {
      set_round(i, *instance.round, hit);
      wo.set(i, back);
      return;
    } else {
      const Mat4& m = instance.to_world;
      p0.set(i, Vec3(m * Vec4(mesh.positions[t[0]], 1)));
      p1.set(i, Vec3(m * Vec4(mesh.positions[t[1]], 1)));
      p2.set(i, Vec3(m * Vec4(mesh.positions[t[2]], 1)));
    }
    u[i] = hit.u;
    v[i] = hit.v;
    // A mirrored transform reverses the winding of triangles; the front side of the mesh remains the front.
    winding[i] = instance.mirrored ? -1.0f : 1.0f;
    wo.set(i, back);
  }

  // A tangent facet of the shape whose first corner is the hit point.
  void set_round(size_t i, const AnalyticShape& shape, const Hit& hit) {
    const Facet f = shape.facet_at({hit.u, hit.v});
    p0.set(i, f.p0);
    p1.set(i, f.p1);
    p2.set(i, f.p2);
    u[i] = v[i] = 0;
    winding[i] = 1;
  }

  // The triangle of a moving instance at the given time.
  void move(size_t i, const InstanceData& instance, const Hit& hit, float time) {
    if (instance.round) return set_round(i, instance.round->placed(instance.motion->matrix_at(time)), hit);
    const Facet f = instance.motion->facet_at(*instance.mesh, instance.mesh->triangles[hit.triangle], time);
    p0.set(i, f.p0);
    p1.set(i, f.p1);
    p2.set(i, f.p2);
    winding[i] = f.winding;
  }

  void get(size_t i, SurfacePoint& point) const {
    point.position = position[i];
    point.ng = ng[i];
    point.shading.x = x[i];
    point.shading.y = y[i];
    point.shading.z = ng[i];
    point.offset = offset[i];
    point.front = facing[i] > 0;
  }
};

// Computes positions, normals and frames.
ETENDUE_VECTORIZE void shape(Facets& f, size_t count) {
#pragma GCC ivdep
  for (size_t i = 0; i < padded_lanes(count); ++i) {
    const Vec3 p0 = f.p0[i], e1 = f.p1[i] - p0, e2 = f.p2[i] - p0;
    const Vec3 position = p0 + e1 * f.u[i] + e2 * f.v[i];
    const Vec3 cross = glm::cross(e1, e2);
    const Vec3 ng = cross * (f.winding[i] / std::sqrt(length_squared(cross)));
    Frame frame;
    frame.build(ng);
    f.position.set(i, position);
    f.ng.set(i, ng);
    f.x.set(i, frame.x);
    f.y.set(i, frame.y);
    f.offset[i] = offset_bound(position, e1, e2);
    f.facing[i] = glm::dot(ng, f.wo[i]);
  }
}

// Whether the shading frame differs from the geometric one.
bool has_own_shading_frame(const SurfacePoint& point) {
  return point.instance->smooth || point.material->needs_tangent_frame;
}

// A shading normal that faces away from the viewer would make the surface black. It is rotated towards the viewer until
// the cosine between them is kMinCosine.
constexpr float kMinCosine = 1e-3f;
float viewing_cosine(const Vec3& normal, const Vec3& wo, float side) { return glm::dot(normal, wo) * side; }
Vec3 towards_viewer(const Vec3& normal, const Vec3& wo, float side) {
  return glm::normalize(normal + wo * (side * (kMinCosine - viewing_cosine(normal, wo, side))));
}

void turn_towards_viewer(const Vec3& wo, SurfacePoint& point) {
  const float side = point.front ? 1.0f : -1.0f;
  if (viewing_cosine(point.shading.z, wo, side) < kMinCosine)
    point.shading = Frame(towards_viewer(point.shading.z, wo, side), point.shading.x, 1);
}

// The tangent direction of an anisotropic material on a mesh without tangents: along its texture coordinates if there
// are any, otherwise around the y axis of the object. Not normalised; zero where it is undefined.
Vec3 direction_along(const InstanceData& instance, const Triangle& t, const Vec3& normal) {
  const Mesh& mesh = *instance.mesh;
  const auto& uv = mesh.uvs[0];
  if (!uv.empty()) {
    const Vec2 a = uv[t[1]] - uv[t[0]], b = uv[t[2]] - uv[t[0]];
    const Vec3 e1 = mesh.positions[t[1]] - mesh.positions[t[0]], e2 = mesh.positions[t[2]] - mesh.positions[t[0]];
    const Vec3 along = (e1 * b.y - e2 * a.y) * (a.x * b.y - a.y * b.x < 0 ? -1.0f : 1.0f);
    if (length_squared(along) > 0) return instance.identity ? along : Mat3(instance.to_world) * along;
  }
  return glm::cross(instance.identity ? Vec3(0, 1, 0) : Vec3(instance.to_world[1]), normal);
}

// Applies the normal maps of the base and of the clear coat.
void apply_normal_maps(const Vec3& wo, SurfacePoint& point) {
  const SurfaceMaterial& material = *point.material;
  const Frame unmapped = point.shading;
  if (material.normal) {
    const Vec3 mapped = normalize_or(unmapped.to_world(material.normal_at(point.texture)), unmapped.z);
    point.shading = Frame(mapped, unmapped.x, glm::dot(glm::cross(unmapped.z, unmapped.x), unmapped.y));
  }
  turn_towards_viewer(wo, point);
  if (!material.has_coat_normal) return;
  const float side = point.front ? 1.0f : -1.0f;
  Vec3 coat = normalize_or(unmapped.to_world(material.coat_normal_at(point.texture)), unmapped.z);
  if (viewing_cosine(coat, wo, side) < kMinCosine) coat = towards_viewer(coat, wo, side);
  point.coat = point.shading.to_local(coat);
}

}  // namespace

void CompiledScene::surfaces(std::span<const Vec3> wo, std::span<const Hit> hits, SurfacePoint* points,
                             const float* times) const {
  for (size_t first = 0; first < hits.size(); first += Facets::kSize) {
    const size_t count = std::min(Facets::kSize, hits.size() - first);
    Facets facets;
    for (size_t i = 0; i < count; ++i)
      facets.set(i, (*instances_)[hits[first + i].instance], hits[first + i], wo[first + i]);
    for (size_t i = 0; times && i < count; ++i)
      if (const InstanceData& instance = (*instances_)[hits[first + i].instance]; instance.motion)
        facets.move(i, instance, hits[first + i], times[first + i]);
    shape(facets, count);
    for (size_t i = 0; i < count; ++i) {
      facets.get(i, points[first + i]);
      finish(hits[first + i], points[first + i]);
    }
    for (size_t i = 0; i < count; ++i)
      if (SurfacePoint& point = points[first + i]; has_own_shading_frame(point))
        bend(wo[first + i], hits[first + i], nullptr, point);
    // The loop above uses the normals at shutter opening; those of moving instances are computed again at their times.
    for (size_t i = 0; times && i < count; ++i)
      if (SurfacePoint& point = points[first + i]; point.instance->motion && has_own_shading_frame(point))
        bend(wo[first + i], hits[first + i], times + first + i, point);
  }
}

// The properties that depend on the instance, except for the shading frame.
void CompiledScene::finish(const Hit& hit, SurfacePoint& point) const {
  const InstanceData& instance = (*instances_)[hit.instance];
  point.instance = &instance;
  point.material = &(*materials_)[instance.material];
  point.triangle = hit.triangle;
  if (instance.textured) {
    point.texture = texture_point(*instance.mesh, hit.triangle, hit.u, hit.v);
    if (point.material->has_textures) point.material->prefetch_texels(point.texture);
    if (point.material->has_tiled_textures) set_footprints(hit, point);
  } else
    point.texture.color = Vec4(1);
}

// The distance along the path back to the camera is at least the length of its last segment, and at least the straight
// distance. The greater one therefore never blurs more than a pixel, unless optics magnify.
[[gnu::noinline]] void CompiledScene::set_footprints(const Hit& hit, SurfacePoint& point) const {
  const Mesh& mesh = *point.instance->mesh;
  const Triangle& t = mesh.triangles[hit.triangle];
  const Mat3 to_world(point.instance->to_world);
  const Vec3 e1 = to_world * (mesh.positions[t[1]] - mesh.positions[t[0]]);
  const Vec3 e2 = to_world * (mesh.positions[t[2]] - mesh.positions[t[0]]);
  const float area = glm::length(glm::cross(e1, e2));
  const float straight = glm::distance(point.position, Vec3(camera_.to_world[3]));
  const float distance = std::isfinite(hit.t) ? std::max(hit.t, straight) : straight;
  const float width = pixel_width_ + pixel_angle_ * distance;
  float smallest = kInfinity;
  for (const auto& uvs : mesh.uvs) {
    if (uvs.empty()) continue;
    const Vec2 a = uvs[t[1]] - uvs[t[0]], b = uvs[t[2]] - uvs[t[0]];
    smallest = std::min(smallest, std::sqrt(std::abs(a.x * b.y - a.y * b.x) / area));
  }
  point.texture.footprint = std::isfinite(smallest) ? width * smallest : 0;
}

void CompiledScene::bend(const Vec3& wo, const Hit& hit, const float* time, SurfacePoint& point) const {
  const InstanceData& instance = *point.instance;
  const Mesh& mesh = *instance.mesh;
  const Triangle& t = mesh.triangles[hit.triangle];
  const Motion* motion = time ? instance.motion.get() : nullptr;
  Vec3 ns = point.ng;
  if (!mesh.normals.empty())
    ns = normalize_or(motion ? motion->normal_at(mesh, t, hit.u, hit.v, *time)
                             : instance.normal_to_world * barycentric(mesh.normals, t, hit.u, hit.v),
                      point.ng);
  if (glm::dot(ns, point.ng) < 0) ns = -ns;
  if (!mesh.tangents.empty()) {
    const Vec4 tangent =
        motion ? motion->tangent_at(mesh, t, hit.u, hit.v, *time)
               : mesh.tangents[t[0]] * (1 - hit.u - hit.v) + mesh.tangents[t[1]] * hit.u + mesh.tangents[t[2]] * hit.v;
    const bool in_world_space = motion || instance.identity;
    const Vec3 tangent_in_world = in_world_space ? Vec3(tangent) : Mat3(instance.to_world) * Vec3(tangent);
    point.shading.build(ns, tangent_in_world, (tangent.w < 0 ? -1.0f : 1.0f) * (instance.mirrored ? -1.0f : 1.0f));
  } else if (point.material->is_anisotropic) {
    point.shading.build(ns, direction_along(instance, t, ns), 1);
  } else {
    point.shading.build(ns);
  }
  if (point.material->has_normal_map)
    apply_normal_maps(wo, point);
  else
    turn_towards_viewer(wo, point);
}

Rgb CompiledScene::emitted(const SurfacePoint& point, const Vec3& direction) const {
  if (!point.material->is_emissive || (!point.front && !point.material->description.double_sided)) return Rgb(0);
  const Rgb along_normal = point.material->emission_at(point.texture);
  return point.instance->cosine_exponent == 0 ? along_normal : along_normal * point.beam(direction);
}

Rgb CompiledScene::textured_radiance_of(const LightSample& sample) const {
  const AreaLightTriangle& t = lights_->triangles()[sample.light];
  const InstanceData& instance = (*instances_)[t.instance];
  const SurfaceMaterial& material = (*materials_)[instance.material];
  return material.emission_at(texture_point(*instance.mesh, t.triangle, sample.barycentric.x, sample.barycentric.y));
}

const EmissionSpectrum* CompiledScene::spectrum_of_light(const LightSample& sample) const {
  if (sample.kind == LightKind::environment) return lights_->environment().spectrum();
  const auto& triangles = lights_->triangles();
  if (sample.kind == LightKind::placed) return lights_->placed()[sample.light - triangles.size()].spectrum.get();
  const InstanceData& instance = (*instances_)[triangles[sample.light].instance];
  return (*materials_)[instance.material].description.emission_spectrum.spectrum.get();
}

std::string CompiledScene::emitter_with_spectrum() const {
  const auto named = [](const char* kind, const std::string& name) {
    return name.empty() ? std::string("a ") + kind : std::string(kind) + " '" + name + "'";
  };
  for (const Light& light : description_->lights)
    if (light.spectrum) return named("light", light.name);
  for (const Material& material : description_->materials)
    if (material.emission_spectrum && material.is_emissive()) return named("material", material.name);
  return description_->environment.spectrum && !description_->environment.black() ? "the environment" : "";
}

bool CompiledScene::blocks_ray(uint32_t instance, uint32_t triangle, float u, float v, uint32_t ray_seed) const {
  const InstanceData& data = (*instances_)[instance];
  const SurfaceMaterial& material = (*materials_)[data.material];
  if (!material.has_alpha) return true;
  const float opacity = material.opacity_at(texture_point(*data.mesh, triangle, u, v));
  if (opacity >= 1) return true;
  return to_unit_float(hash_combine(hash_combine(ray_seed, instance), triangle)) < opacity;
}

namespace {

// Stops rays at all boundaries of solids, and elsewhere by opacity.
class SolidOpacityTest final : public OpacityTest {
 public:
  explicit SolidOpacityTest(const CompiledScene& scene) : scene_(scene) {}
  bool blocks_ray(uint32_t instance, uint32_t triangle, float u, float v, uint32_t ray_seed) const override {
    return scene_.instances()[instance].solid != kNoSolid || scene_.blocks_ray(instance, triangle, u, v, ray_seed);
  }

 private:
  const CompiledScene& scene_;
};

}  // namespace

Hit CompiledScene::intersect_solids(const Ray& ray, uint32_t ray_seed, float time) const {
  if (!solids_->any_has_alpha()) return intersect(ray, ray_seed, time);
  const SolidOpacityTest opacity(*this);
  Hit hit;
  accel_->intersect(ray, &opacity, ray_seed, hit, time);
  return hit;
}

void CompiledScene::intersect_solids(RayPacket& packet, int count, bool coherent, const uint32_t* seeds) const {
  if (!solids_->any_has_alpha()) return intersect(packet, count, coherent, seeds);
  const SolidOpacityTest opacity(*this);
  accel_->intersect(packet, count, coherent, &opacity, seeds);
}

std::string CompiledScene::moving() const {
  if (moving_node_ >= 0) {
    const std::string& name = description_->nodes[static_cast<size_t>(moving_node_)].name;
    return name.empty() ? "node " + std::to_string(moving_node_) : "node '" + name + "'";
  }
  return camera_motion_ ? "the camera" : "";
}

void CompiledScene::locate(const Emission& emission, Hit& hit, Vec3& side) const {
  const AreaLightTriangle& t = lights_->triangles()[emission.light];
  const Vec3 normal = lights_->normal_at(emission.light, emission.barycentric, emission.time);
  side = emission.back ? -normal : normal;
  hit.instance = t.instance;
  hit.triangle = t.triangle;
  hit.u = emission.barycentric.x;
  hit.v = emission.barycentric.y;
}

size_t CompiledScene::memory() const {
  size_t bytes = geometry_memory_ + emission_memory_ + materials_->size() * sizeof(SurfaceMaterial) +
                 lights_->triangles().size() * (sizeof(AreaLightTriangle) + 16);
  std::unordered_map<const void*, size_t> shared;  // each shared image counts once
  for (const auto& texture : *textures_)
    if (texture.image) shared[texture.image.get()] = texture.image->memory();
  for (const auto& [_, size] : shared) bytes += size;
  return bytes;
}

}  // namespace etendue::scene
