#include "scene/compiled.h"

#include <chrono>
#include <unordered_map>

#include "base/hash.h"
#include "base/wide.h"
#include "light/light_points.h"
#include "scene/light_shapes.h"
#include "scene/pose.h"
#include "scene/shutter.h"

namespace etendue::scene {
namespace {

// Meshes that are used once stand in the top level while there is room: this many triangles are rebuilt within a frame.
constexpr size_t kTopLevelBudget = 200'000;

Vec3 barycentric(const std::vector<Vec3>& values, const Triangle& t, float u, float v) {
  return values[t[0]] * (1 - u - v) + values[t[1]] * u + values[t[2]] * v;
}

TexturePoint texture_point(const Mesh& mesh, uint32_t triangle, float u, float v) {
  const Triangle& t = mesh.triangles[triangle];
  const float w = 1 - u - v;
  TexturePoint point;
  for (size_t set = 0; set < 2; ++set)
    if (const auto& uvs = mesh.uvs[set]; !uvs.empty()) point.uv[set] = uvs[t[0]] * w + uvs[t[1]] * u + uvs[t[2]] * v;
  if (!mesh.colors.empty()) point.color = mesh.colors[t[0]] * w + mesh.colors[t[1]] * u + mesh.colors[t[2]] * v;
  return point;
}

// Flat triangles that rays have met, many at once.
struct Facets {
  static constexpr size_t kSize = 64;
  template <class T>
  using Array = std::array<T, kSize>;

  WideVec3<kSize> p0, p1, p2, wo;
  alignas(64) Array<float> u, v, winding;
  WideVec3<kSize> position, ng, x, y;
  alignas(64) Array<float> offset, facing;  // facing: the cosine between wo and the front

  void set(size_t i, const InstanceData& instance, const Hit& hit, const Vec3& back) {
    const Mesh& mesh = *instance.mesh;
    const Triangle& t = mesh.triangles[hit.triangle];
    if (instance.identity) {
      p0.set(i, mesh.positions[t[0]]), p1.set(i, mesh.positions[t[1]]), p2.set(i, mesh.positions[t[2]]);
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
    u[i] = hit.u, v[i] = hit.v;
    // World-space triangles of a mirrored instance are turned; glTF wants the winding as it was.
    winding[i] = instance.mirrored ? -1.0f : 1.0f;
    wo.set(i, back);
  }

  // The corner of a facet that touches the shape.
  void set_round(size_t i, const RoundShape& shape, const Hit& hit) {
    const Facet f = shape.facet_at({hit.u, hit.v});
    p0.set(i, f.p0), p1.set(i, f.p1), p2.set(i, f.p2);
    u[i] = v[i] = 0, winding[i] = 1;
  }

  // Where an instance that moves is at that time.
  void move(size_t i, const InstanceData& instance, const Hit& hit, float time) {
    if (instance.round) return set_round(i, instance.round->placed(instance.motion->matrix_at(time)), hit);
    const Facet f = instance.motion->facet_at(*instance.mesh, instance.mesh->triangles[hit.triangle], time);
    p0.set(i, f.p0), p1.set(i, f.p1), p2.set(i, f.p2);
    winding[i] = f.winding;
  }

  void get(size_t i, SurfacePoint& point) const {
    point.position = position[i];
    point.ng = ng[i];
    point.shading.x = x[i], point.shading.y = y[i], point.shading.z = ng[i];
    point.offset = offset[i];
    point.front = facing[i] > 0;
  }
};

// How far float arithmetic may move a point off its triangle: intersection works with coordinates relative to the
// vertices, so the error grows with where the triangle is and with how large it is.
[[gnu::always_inline]] inline float offset_bound(const Vec3& position, const Vec3& e1, const Vec3& e2) {
  const float far = max_component(glm::abs(position));
  const float size = max_component(glm::abs(e1)) + max_component(glm::abs(e2));
  return 16 * 0x1p-24f * (far + 2 * size);
}

ETENDUE_WIDE void shape(Facets& f, size_t count) {
#pragma GCC ivdep
  for (size_t i = 0; i < whole_registers(count); ++i) {
    const Vec3 p0 = f.p0[i], e1 = f.p1[i] - p0, e2 = f.p2[i] - p0;
    const Vec3 position = p0 + e1 * f.u[i] + e2 * f.v[i];
    const Vec3 cross = glm::cross(e1, e2);
    const Vec3 ng = cross * (f.winding[i] / std::sqrt(length_squared(cross)));
    Frame frame;
    frame.build(ng);
    f.position.set(i, position), f.ng.set(i, ng), f.x.set(i, frame.x), f.y.set(i, frame.y);
    f.offset[i] = offset_bound(position, e1, e2);
    f.facing[i] = glm::dot(ng, f.wo[i]);
  }
}

// Whether the shading normal is another than the geometric one.
bool is_bent(const SurfacePoint& point) { return point.instance->smooth || point.material->framed; }

// A shading normal that looks away from the viewer would make the surface black: it is bent until it is barely seen.
constexpr float kBarely = 1e-3f;
float seen(const Vec3& normal, const Vec3& wo, float side) { return glm::dot(normal, wo) * side; }
Vec3 barely_seen(const Vec3& normal, const Vec3& wo, float side) {
  return glm::normalize(normal + wo * (side * (kBarely - seen(normal, wo, side))));
}

void make_seen(const Vec3& wo, SurfacePoint& point) {
  const float side = point.front ? 1.0f : -1.0f;
  if (seen(point.shading.z, wo, side) < kBarely)
    point.shading = Frame(barely_seen(point.shading.z, wo, side), point.shading.x, 1);
}

// Where a material asks for a direction and the mesh has no tangents: along its texture coordinates, or else around the
// object's upright axis. Any length; none where there is no such direction.
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

// The normal maps of the base and of its coat.
void bend_by_maps(const Vec3& wo, SurfacePoint& point) {
  const SurfaceMaterial& material = *point.material;
  const Frame unbent = point.shading;
  if (material.normal) {
    const Vec3 bent = normalize_or(unbent.to_world(material.normal_at(point.texture)), unbent.z);
    point.shading = Frame(bent, unbent.x, glm::dot(glm::cross(unbent.z, unbent.x), unbent.y));
  }
  make_seen(wo, point);
  if (!material.bent_coat) return;
  const float side = point.front ? 1.0f : -1.0f;
  Vec3 coat = normalize_or(unbent.to_world(material.coat_normal_at(point.texture)), unbent.z);
  if (seen(coat, wo, side) < kBarely) coat = barely_seen(coat, wo, side);
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
      finish(wo[first + i], hits[first + i], points[first + i]);
    }
    // Normals of what moves, once more: of what stands still nobody asks for a time.
    for (size_t i = 0; times && i < count; ++i)
      if (SurfacePoint& point = points[first + i]; point.instance->motion && is_bent(point))
        bend(wo[first + i], hits[first + i], times + first + i, point);
  }
}

// What is not the same for every flat triangle: textures, interpolated normals, normal maps.
void CompiledScene::finish(const Vec3& wo, const Hit& hit, SurfacePoint& point) const {
  const InstanceData& instance = (*instances_)[hit.instance];
  point.instance = &instance;
  point.material = &(*materials_)[instance.material];
  point.triangle = hit.triangle;
  if (instance.textured)
    point.texture = texture_point(*instance.mesh, hit.triangle, hit.u, hit.v);
  else
    point.texture.color = Vec4(1);
  if (is_bent(point)) bend(wo, hit, nullptr, point);
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
    const bool placed = motion || instance.identity;
    const Vec3 tangent_in_world = placed ? Vec3(tangent) : Mat3(instance.to_world) * Vec3(tangent);
    point.shading.build(ns, tangent_in_world, (tangent.w < 0 ? -1.0f : 1.0f) * (instance.mirrored ? -1.0f : 1.0f));
  } else if (point.material->directed) {
    point.shading.build(ns, direction_along(instance, t, ns), 1);
  } else {
    point.shading.build(ns);
  }
  if (point.material->bends)
    bend_by_maps(wo, point);
  else
    make_seen(wo, point);
}

Rgb CompiledScene::emitted(const SurfacePoint& point, const Vec3& direction) const {
  if (!point.material->shines || (!point.front && !point.material->description.double_sided)) return Rgb(0);
  const Rgb along_normal = point.material->emission_at(point.texture);
  return point.instance->focus == 0 ? along_normal : along_normal * point.beam(direction);
}

Rgb CompiledScene::textured_radiance_of(const LightSample& sample) const {
  const EmissiveTriangle& t = lights_->triangles()[sample.light];
  const InstanceData& instance = (*instances_)[t.instance];
  const SurfaceMaterial& material = (*materials_)[instance.material];
  return material.emission_at(texture_point(*instance.mesh, t.triangle, sample.barycentric.x, sample.barycentric.y));
}

bool CompiledScene::stops(uint32_t instance, uint32_t triangle, float u, float v, uint32_t ray_seed) const {
  const InstanceData& data = (*instances_)[instance];
  const SurfaceMaterial& material = (*materials_)[data.material];
  if (!material.transparent) return true;
  const float opacity = material.opacity_at(texture_point(*data.mesh, triangle, u, v));
  if (opacity >= 1) return true;
  return to_unit_float(hash_combine(hash_combine(ray_seed, instance), triangle)) < opacity;
}

std::string CompiledScene::moving() const {
  if (moving_node_ >= 0) {
    const std::string& name = description_->nodes[static_cast<size_t>(moving_node_)].name;
    return name.empty() ? "node " + std::to_string(moving_node_) : "node '" + name + "'";
  }
  return camera_motion_ ? "the camera" : "";
}

void CompiledScene::locate(const Emission& emission, Hit& hit, Vec3& side) const {
  const EmissiveTriangle& t = lights_->triangles()[emission.light];
  const Vec3 normal = lights_->normal_at(emission.light, emission.barycentric, emission.time);
  side = emission.back ? -normal : normal;
  hit.instance = t.instance, hit.triangle = t.triangle;
  hit.u = emission.barycentric.x, hit.v = emission.barycentric.y;
}

size_t CompiledScene::memory() const {
  size_t bytes = instances_->size() * sizeof(InstanceData) + materials_->size() * sizeof(SurfaceMaterial) +
                 lights_->triangles().size() * (sizeof(EmissiveTriangle) + 16);
  std::unordered_map<const void*, size_t> seen;
  for (const auto& instance : *instances_) seen[instance.mesh.get()] = instance.mesh->memory();
  for (const auto& texture : *textures_)
    if (texture.image) seen[texture.image.get()] = texture.image->memory();
  for (const auto& [_, size] : seen) bytes += size;
  return bytes;
}

// One compilation: what stays, what is built.
class Compiler {
 public:
  Compiler(std::shared_ptr<const Scene> scene, const Camera& camera, const CompiledScene* previous)
      : scene_(std::move(scene)),
        previous_(previous),
        shutter_(*scene_, camera.shutter),
        result_(std::make_shared<CompiledScene>()) {
    result_->description_ = scene_;
    result_->camera_ = camera;
  }

  std::shared_ptr<const CompiledScene> run() {
    const auto start = std::chrono::steady_clock::now();
    geometry();
    materials();
    lights();
    result_->camera_motion_ = shutter_.motion_of(result_->camera_);
    result_->report_.seconds = std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
    return result_;
  }

 private:
  struct Placed {  // one primitive of one node
    std::shared_ptr<const Mesh> mesh;
    Mat4 to_world{1};
    uint32_t material, node;
    std::shared_ptr<const Motion> motion = nullptr;
    std::shared_ptr<const RoundShape> round = nullptr;
    float focus = 0;
  };

  bool same_geometry() const {
    if (!previous_) return false;
    const Scene& old = previous_->description();
    if (!scene_->animations.empty() && previous_->camera().shutter != result_->camera_.shutter) return false;
    if (scene_->time != old.time || scene_->roots != old.roots || scene_->skins != old.skins ||
        scene_->animations != old.animations || scene_->meshes.size() != old.meshes.size() ||
        scene_->nodes.size() != old.nodes.size())
      return false;
    for (size_t i = 0; i < scene_->nodes.size(); ++i)
      if (!(scene_->nodes[i] == old.nodes[i])) return false;
    for (size_t i = 0; i < scene_->meshes.size(); ++i)
      if (!(scene_->meshes[i] == old.meshes[i])) return false;
    return same_surface_lights() && scene_->materials.size() == old.materials.size();
  }

  // Lights that are surfaces have a shape and a material each, after those of the scene.
  bool same_surface_lights() const {
    const std::vector<Light>&a = scene_->lights, &b = previous_->description().lights;
    const auto surface = [](const Light& light) { return light.is_surface(); };
    return a == b || (std::ranges::none_of(a, surface) && std::ranges::none_of(b, surface));
  }

  void geometry() {
    if (same_geometry()) {
      result_->accel_ = previous_->accel_;
      result_->instances_ = previous_->instances_;
      result_->mesh_accels_ = previous_->mesh_accels_;
      result_->bounds_ = previous_->bounds_;
      result_->moving_node_ = previous_->moving_node_;
      result_->triangles_ = previous_->triangles_;
      return;
    }
    const std::vector<Placed> placed = place();
    build(placed);
    result_->report_.top_level_built = true;
  }

  void note_motion(uint32_t node) {
    if (result_->moving_node_ < 0) result_->moving_node_ = static_cast<int>(node);
  }

  std::vector<Placed> place() {
    std::vector<Placed> placed;
    const std::vector<Mat4> world = world_matrices(*scene_);
    for (const uint32_t node : reached_nodes()) {
      const Node& n = scene_->nodes[node];
      if (n.light >= 0) {
        if (shutter_.motion_of(static_cast<int>(node))) note_motion(node);
        place_light(node, world[node], placed);
      }
      if (n.mesh < 0) continue;
      for (const Primitive& primitive : scene_->meshes[static_cast<size_t>(n.mesh)].primitives) {
        if (primitive.mesh->triangles.empty()) continue;
        const auto material = static_cast<uint32_t>(primitive.material);
        if (const auto moving = shutter_.moving(static_cast<int>(node), primitive)) {
          const Mat4 to_world = moving->motion->deforms() ? Mat4(1) : world[node];
          placed.push_back({moving->mesh, to_world, material, node, moving->motion});
          note_motion(node);
          continue;
        }
        const PosedMesh posed = posed_mesh(*scene_, static_cast<int>(node), primitive, world);
        if (posed.mesh->triangles.empty()) continue;
        placed.push_back({posed.mesh, posed.in_world ? Mat4(1) : world[node], material, node});
      }
    }
    return placed;
  }

  void place_light(uint32_t node, const Mat4& world, std::vector<Placed>& placed) {
    const auto number = static_cast<uint32_t>(scene_->nodes[node].light);
    const Light& light = scene_->lights[number];
    if (!is_met_by_rays(light)) return;
    Placed p{stand_in(light), without_scale(world), first_light_material() + number, node};
    p.focus = light.focus;
    if (const auto motion = shutter_.motion_of(static_cast<int>(node))) p.motion = without_scale(*motion);
    if (light.type != LightType::quad) p.round = std::make_shared<const RoundShape>(shape_of(light).placed(p.to_world));
    placed.push_back(std::move(p));
  }
  uint32_t first_light_material() const { return static_cast<uint32_t>(scene_->materials.size()); }

  std::vector<uint32_t> reached_nodes() const {
    std::vector<uint32_t> order;
    std::vector<int> stack(scene_->roots.rbegin(), scene_->roots.rend());
    while (!stack.empty()) {
      const int node = stack.back();
      stack.pop_back();
      const Node& n = scene_->nodes[static_cast<size_t>(node)];
      if (!n.visible) continue;
      order.push_back(static_cast<uint32_t>(node));
      stack.insert(stack.end(), n.children.rbegin(), n.children.rend());
    }
    return order;
  }

  // The bottom levels that the previous scene built for the same meshes.
  std::unordered_map<const Mesh*, std::shared_ptr<const MeshAccel>> previous_accels() const {
    std::unordered_map<const Mesh*, std::shared_ptr<const MeshAccel>> accels;
    if (previous_)
      for (const auto& accel : previous_->mesh_accels_)
        if (accel) accels[accel->mesh().get()] = accel;
    return accels;
  }

  void build(const std::vector<Placed>& placed) {
    std::unordered_map<const Mesh*, int> uses;
    for (const auto& p : placed) ++uses[p.mesh.get()];
    auto accels = previous_accels();
    const auto kept = accels;

    auto instances = std::make_shared<std::vector<InstanceData>>();
    std::vector<AccelInstance> accel_instances;
    size_t budget = kTopLevelBudget;
    for (const auto& p : placed) {
      if (p.round) {
        add_round(p, *instances, accel_instances);
        continue;
      }
      InstanceData data;
      AccelInstance in_accel;
      const size_t triangles = p.mesh->triangles.size();
      result_->triangles_ += triangles;
      // What deforms is in world space at all times; what moves as it is has a matrix for each.
      const bool flat = p.motion ? p.motion->deforms()
                                 : uses[p.mesh.get()] == 1 && triangles <= budget && !kept.contains(p.mesh.get());
      data.mesh = p.mesh, data.motion = p.motion;
      data.mirrored = flat && p.motion ? p.motion->mirrored : glm::determinant(Mat3(p.to_world)) < 0;
      data.material = p.material, data.node = p.node, data.focus = p.focus;
      if (flat) {
        budget -= std::min(budget, triangles);
        data.mesh = in_world(p.mesh, p.to_world);
      } else {
        data.identity = p.to_world == Mat4(1);
        data.to_world = p.to_world;
        data.normal_to_world = glm::transpose(glm::inverse(Mat3(p.to_world)));
        auto& accel = accels[p.mesh.get()];
        if (accel && kept.contains(p.mesh.get())) {
          ++result_->report_.meshes_reused;
        } else if (!accel) {
          accel = std::make_shared<MeshAccel>(p.mesh);
          ++result_->report_.meshes_built;
        }
        in_accel.accel = accel;
        in_accel.to_world = p.to_world;
      }
      data.smooth = !data.mesh->normals.empty();
      data.textured = !data.mesh->uvs[0].empty() || !data.mesh->uvs[1].empty() || !data.mesh->colors.empty();
      in_accel.mesh = data.mesh, in_accel.motion = p.motion;
      result_->mesh_accels_.push_back(in_accel.accel);
      instances->push_back(std::move(data));
      accel_instances.push_back(std::move(in_accel));
    }
    result_->accel_ = std::make_shared<Accel>(accel_instances);
    result_->bounds_ = result_->accel_->bounds();
    result_->instances_ = std::move(instances);
  }

  void add_round(const Placed& p, std::vector<InstanceData>& instances, std::vector<AccelInstance>& accels) {
    InstanceData data;
    data.mesh = p.mesh, data.motion = p.motion, data.round = p.round;
    data.to_world = p.to_world, data.identity = false;
    data.material = p.material, data.node = p.node, data.focus = p.focus;
    instances.push_back(data);
    accels.push_back({p.mesh, nullptr, p.to_world, p.motion, p.round});
    result_->mesh_accels_.push_back(nullptr);
  }

  void materials() {
    CompiledScene& r = *result_;
    if (previous_ && previous_->description().materials == scene_->materials &&
        previous_->description().textures == scene_->textures && same_surface_lights()) {
      r.textures_ = previous_->textures_;
      r.materials_ = previous_->materials_;
      r.transparency_ = previous_->transparency_;
      return;
    }
    r.textures_ = previous_ && previous_->description().textures == scene_->textures
                      ? previous_->textures_
                      : std::make_shared<const std::vector<Texture>>(scene_->textures);
    auto compiled = std::make_shared<std::vector<SurfaceMaterial>>();
    for (const Material& m : scene_->materials) {
      compiled->emplace_back(m, *r.textures_);
      r.transparency_ = r.transparency_ || compiled->back().transparent;
    }
    if (std::ranges::any_of(scene_->lights, is_met_by_rays))
      for (const Light& light : scene_->lights) compiled->emplace_back(material_of(light), *r.textures_);
    r.materials_ = std::move(compiled);
    r.report_.materials_built = true;
  }

  // The light tables depend on where emitters are, on what they emit, and on the lights and the environment.
  bool same_lights() const {
    if (!previous_ || result_->report_.top_level_built) return false;
    const Scene& old = previous_->description();
    if (!(scene_->lights == old.lights) || !(scene_->environment == old.environment)) return false;
    if (!result_->report_.materials_built) return true;
    if (scene_->materials.size() != old.materials.size()) return false;
    for (size_t i = 0; i < scene_->materials.size(); ++i) {
      const Material &a = scene_->materials[i], &b = old.materials[i];
      if (!(a.emission == b.emission) || !(a.emission_texture == b.emission_texture) || a.unlit != b.unlit ||
          a.double_sided != b.double_sided)
        return false;
    }
    return true;
  }

  void lights() {
    if (same_lights()) {
      result_->lights_ = previous_->lights_;
      return;
    }
    auto instances = std::make_shared<std::vector<InstanceData>>(*result_->instances_);
    std::vector<EmissiveTriangle> triangles;
    std::vector<MovingEmitter> movers;
    std::vector<RoundLight> rounds;
    for (uint32_t i = 0; i < instances->size(); ++i) {
      InstanceData& instance = (*instances)[i];
      const SurfaceMaterial& material = (*result_->materials_)[instance.material];
      instance.first_light = InstanceData::kNotALight;
      if (!material.description.emits() || material.description.unlit) continue;
      instance.first_light = static_cast<uint32_t>(triangles.size());
      if (instance.round) {
        triangles.push_back(emissive_round(instance, material, i, rounds));
        continue;
      }
      for (uint32_t t = 0; t < instance.mesh->triangles.size(); ++t)
        triangles.push_back(emissive(instance, material, i, t));
      if (!instance.motion) continue;
      movers.resize(instances->size());
      movers[i] = {instance.mesh, instance.motion};
    }
    result_->instances_ = std::move(instances);
    result_->lights_ = std::make_shared<LightTable>(std::move(triangles), placed_lights(), scene_->environment,
                                                    result_->bounds_, std::move(movers), std::move(rounds));
    result_->report_.lights_built = true;
  }

  static EmissiveTriangle emissive(const InstanceData& instance, const SurfaceMaterial& material, uint32_t i,
                                   uint32_t t) {
    const Mesh& mesh = *instance.mesh;
    EmissiveTriangle e;
    e.instance = i, e.triangle = t;
    e.radiance = material.description.emission, e.double_sided = material.description.double_sided;
    e.moving = instance.motion != nullptr, e.focus = instance.focus;
    e.place(e.moving ? instance.motion->facet_at(mesh, mesh.triangles[t], 0.5f) : facet(instance, mesh.triangles[t]));
    if (material.emission) {
      Rgb sum(0);
      constexpr float kPoints[7][2] = {{1 / 3.f, 1 / 3.f}, {.8f, .1f},  {.1f, .8f}, {.1f, .1f},
                                       {.45f, .45f},       {.45f, .1f}, {.1f, .45f}};
      for (const auto& b : kPoints) sum += material.emission_at(texture_point(mesh, t, b[0], b[1]));
      e.radiance = sum / 7, e.textured = true;
    }
    return e;
  }

  static EmissiveTriangle emissive_round(const InstanceData& instance, const SurfaceMaterial& material, uint32_t i,
                                         std::vector<RoundLight>& rounds) {
    RoundLight round{*instance.round, instance.motion};
    if (round.motion) round.shape = round.at(0.5f);
    EmissiveTriangle e;
    e.instance = i, e.focus = instance.focus;
    e.radiance = material.description.emission, e.double_sided = material.description.double_sided;
    e.place_round(static_cast<int>(rounds.size()), round.shape);
    rounds.push_back(std::move(round));
    return e;
  }

  static Facet facet(const InstanceData& instance, const Triangle& t) {
    const auto corner = [&](size_t k) {
      const Vec3& p = instance.mesh->positions[t[k]];
      return instance.identity ? p : Vec3(instance.to_world * Vec4(p, 1));
    };
    return {corner(0), corner(1), corner(2), instance.mirrored ? -1.0f : 1.0f};
  }

  std::vector<PlacedLight> placed_lights() {
    std::vector<PlacedLight> placed;
    const std::vector<Mat4> world = world_matrices(*scene_);
    for (const uint32_t node : reached_nodes()) {
      const Node& n = scene_->nodes[node];
      if (n.light < 0) continue;
      const Light& described = scene_->lights[static_cast<size_t>(n.light)];
      if (described.is_surface()) {
        if (described.points > 0) {
          const auto points = points_of(described, world[node], shutter_.motion_of(static_cast<int>(node)));
          placed.insert(placed.end(), points.begin(), points.end());
        }
        continue;
      }
      PlacedLight& light = placed.emplace_back(described);
      light.motion = shutter_.motion_of(static_cast<int>(node));
      light.place = LightPlace(light.motion ? light.motion->matrix_at(0.5f) : world[node]);
    }
    return placed;
  }

  std::shared_ptr<const Scene> scene_;
  const CompiledScene* previous_;
  Shutter shutter_;
  std::shared_ptr<CompiledScene> result_;
};

std::shared_ptr<const CompiledScene> compile(std::shared_ptr<const Scene> scene, const Camera& camera,
                                             const std::shared_ptr<const CompiledScene>& previous) {
  return Compiler(std::move(scene), camera, previous.get()).run();
}

}  // namespace etendue::scene
