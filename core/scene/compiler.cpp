// Compiles a scene::Scene into a CompiledScene, reusing the unchanged parts of a previous one.
#include <chrono>
#include <unordered_map>
#include <unordered_set>

#include "light/placed_light.h"
#include "scene/compiled_scene.h"
#include "scene/density_placement.h"
#include "scene/emissive_triangles.h"
#include "scene/light_shapes.h"
#include "scene/mesh_accels.h"
#include "scene/moved_nodes.h"
#include "scene/pose.h"
#include "scene/shutter.h"
#include "scene/unchanged_lights.h"
#include "scene/unmoved_bounds.h"

namespace etendue::scene {
namespace {

// Meshes with a single instance are part of the top level, up to this total number of triangles: that many can be
// rebuilt within a frame.
constexpr size_t kTopLevelBudget = 200'000;
// After an edit that moves objects. Larger meshes become instances, so that further edits rebuild few triangles.
constexpr size_t kMovingTopLevelBudget = 10'000;

// From this number of instances, those that move get a structure of their own, because a top level of all takes longer
// than a frame; unless so many move that rays would take much longer.
constexpr size_t kManyInstances = 10'000, kMostMoved = 1000;

}  // namespace

// One compilation.
class Compiler {
 public:
  Compiler(std::shared_ptr<const Scene> scene, const Camera& camera, const CompiledScene* previous, int image_height)
      : scene_(std::move(scene)),
        previous_(previous),
        shutter_(*scene_, camera.shutter),
        result_(std::make_shared<CompiledScene>()) {
    result_->description_ = scene_;
    result_->camera_ = camera;
    if (image_height > 0) set_pixel_size(static_cast<float>(image_height));
  }

  std::shared_ptr<const CompiledScene> run() {
    const auto start = std::chrono::steady_clock::now();
    geometry();
    materials();
    solids();
    lights();
    result_->camera_motion_ = shutter_.motion_of(result_->camera_);
    start_media();
    result_->report_.seconds = std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
    return result_;
  }

 private:
  void set_pixel_size(float image_height) {
    const Camera& camera = result_->camera_;
    if (camera.projection == Projection::perspective)
      result_->pixel_angle_ = 2 * std::tan(0.5f * camera.yfov) / image_height;
    else
      result_->pixel_width_ = 2 * camera.ymag / image_height;
  }

  struct Placed {  // one primitive of one node
    std::shared_ptr<const Mesh> mesh;
    Mat4 to_world{1};
    uint32_t material, node;
    std::shared_ptr<const Motion> motion = nullptr;
    std::shared_ptr<const AnalyticShape> round = nullptr;
    float cosine_exponent = 0;
  };

  bool same_geometry() const {
    if (!previous_) return false;
    const Scene& old = previous_->description();
    if (!scene_->animations.empty() && previous_->camera().shutter != result_->camera_.shutter) return false;
    if (scene_.get() == &old) return true;  // an edit of the camera
    if (scene_->time != old.time || scene_->clip != old.clip || scene_->roots != old.roots ||
        scene_->skins != old.skins || scene_->animations != old.animations)
      return false;
    return scene_->nodes == old.nodes && scene_->meshes == old.meshes && same_surface_lights() &&
           scene_->materials.size() == old.materials.size();
  }

  // Area lights have geometry and a material each. Their materials follow those of the scene.
  bool same_surface_lights() const {
    const std::vector<Light>&a = scene_->lights, &b = previous_->description().lights;
    return a == b || (std::ranges::none_of(a, &Light::is_area_light) && std::ranges::none_of(b, &Light::is_area_light));
  }

  void geometry() {
    if (same_geometry()) {
      result_->accel_ = previous_->accel_;
      result_->instances_ = previous_->instances_;
      result_->mesh_accels_ = previous_->mesh_accels_;
      result_->first_instances_ = previous_->first_instances_;
      result_->bounds_ = previous_->bounds_;
      result_->moving_node_ = previous_->moving_node_;
      result_->triangles_ = previous_->triangles_;
      result_->geometry_memory_ = previous_->geometry_memory_;
      return;
    }
    const bool many = previous_ && previous_->first_instances_ && same_surface_lights() &&
                      scene_->materials.size() == previous_->description().materials.size();
    const auto moved = many ? moved_nodes(*scene_, previous_->description(), kMostMoved) : std::nullopt;
    if (moved && move_instances(*moved)) return;
    build(place());
    result_->report_.top_level_built = true;
  }

  // Reuses the geometry of the previous scene, with other places for some instances. Returns false if that is not
  // possible.
  bool move_instances(const std::vector<MovedNode>& nodes) {
    const auto instances = std::make_shared<InstanceArray>(*previous_->instances_);
    const std::span<const MovedInstance> moved_before = previous_->accel_->moved();
    std::vector<MovedInstance> moved(moved_before.begin(), moved_before.end());
    MeshAccels accels(previous_->mesh_accels_);
    for (const MovedNode& node : nodes) {
      const int mesh = scene_->nodes[node.node].mesh;
      if (mesh < 0) continue;
      uint32_t number = (*previous_->first_instances_)[node.node];
      for (const Primitive& primitive : scene_->meshes[static_cast<size_t>(mesh)].primitives) {
        if (primitive.mesh->triangles.empty()) continue;
        if (number == CompiledScene::kNoInstance ||
            !move_instance(node, primitive, number++, *instances, accels, moved))
          return false;
      }
    }
    if (moved.size() > kMostMoved) return false;
    result_->mesh_accels_ = accels.all();
    result_->report_.meshes_built = accels.built();
    result_->report_.instances_moved = static_cast<int>(moved.size());
    const Bounds others = bounds_of_unmoved(*previous_->accel_, *previous_->instances_, moved);
    result_->accel_ = std::make_shared<Accel>(*previous_->accel_, std::move(moved), others);
    result_->bounds_ = result_->accel_->bounds();
    result_->instances_ = instances;
    result_->first_instances_ = previous_->first_instances_;
    result_->triangles_ = previous_->triangles_;
    result_->geometry_memory_ = previous_->geometry_memory_;
    return true;
  }

  // Returns false for an instance whose place is not only in the acceleration structure.
  bool move_instance(const MovedNode& node, const Primitive& primitive, uint32_t number, InstanceArray& instances,
                     MeshAccels& accels, std::vector<MovedInstance>& moved) {
    const InstanceData& old = (*previous_->instances_)[number];
    if (old.motion || old.solid != kNoSolid || old.first_light != InstanceData::kNotALight) return false;
    auto place = std::ranges::find(moved, number, &MovedInstance::number);
    if (place == moved.end()) place = moved.insert(place, {.number = number, .accel = accels.get(primitive.mesh)});
    place->to_world = node.to_world;
    instances[number].mesh = primitive.mesh;
    set_place(instances[number], node.to_world);
    return true;
  }

  static void set_place(InstanceData& instance, const Mat4& to_world) {
    instance.to_world = to_world;
    instance.normal_to_world = glm::transpose(glm::inverse(Mat3(to_world)));
    instance.identity = to_world == Mat4(1);
    instance.mirrored = glm::determinant(Mat3(to_world)) < 0;
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
    const auto surface = light.model->area_light(light.color);
    if (!surface || !surface->hit_by_rays) return;
    Placed p{mesh_of(*surface), without_scale(world), first_light_material() + number, node};
    p.cosine_exponent = surface->cosine_exponent;
    if (const auto motion = shutter_.motion_of(static_cast<int>(node))) p.motion = without_scale(*motion);
    p.round = analytic_shape_of(*surface, p.to_world);
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

  // Whether an edit moved objects. The next edit probably moves them again.
  bool moves_objects() const {
    if (!previous_) return false;
    const Scene& old = previous_->description();
    if (scene_->time != old.time || scene_->clip != old.clip || scene_->nodes.size() != old.nodes.size()) return false;
    return !scene_->nodes.unshared_agree(
        old.nodes, [&](size_t i) { return !(scene_->nodes[i].transform == old.nodes[i].transform); });
  }

  void build(const std::vector<Placed>& placed) {
    std::unordered_map<const Mesh*, int> uses;
    for (const auto& p : placed) ++uses[p.mesh.get()];
    MeshAccels accels(previous_ ? previous_->mesh_accels_ : MeshAccels::List());

    auto instances = std::make_shared<InstanceArray>();
    std::vector<AccelInstance> accel_instances;
    accel_instances.reserve(placed.size());
    size_t budget = moves_objects() ? kMovingTopLevelBudget : kTopLevelBudget;
    for (const auto& p : placed) {
      const auto number = static_cast<uint32_t>(instances->size());
      InstanceData& data = instances->emplace_back();
      data.number = number;
      if (p.round) {
        add_round(p, data, accel_instances);
        continue;
      }
      AccelInstance in_accel;
      const size_t triangles = p.mesh->triangles.size();
      result_->triangles_ += triangles;
      // A mesh that deforms is in world space at all times. Rigid motion is a sequence of matrices of an instance.
      const bool in_top_level = p.motion
                                    ? p.motion->deforms()
                                    : uses[p.mesh.get()] == 1 && triangles <= budget && !accels.is_from_before(*p.mesh);
      data.mesh = p.mesh;
      data.motion = p.motion;
      data.mirrored = in_top_level && p.motion ? p.motion->mirrored : glm::determinant(Mat3(p.to_world)) < 0;
      data.material = p.material;
      data.node = p.node;
      data.cosine_exponent = p.cosine_exponent;
      if (in_top_level) {
        budget -= std::min(budget, triangles);
        data.mesh = in_world(p.mesh, p.to_world);
      } else {
        set_place(data, p.to_world);
        in_accel.accel = accels.get(p.mesh);
        in_accel.to_world = p.to_world;
      }
      data.smooth = !data.mesh->normals.empty();
      data.textured = !data.mesh->uvs[0].empty() || !data.mesh->uvs[1].empty() || !data.mesh->colors.empty();
      in_accel.mesh = data.mesh;
      in_accel.motion = p.motion;
      accel_instances.push_back(std::move(in_accel));
    }
    result_->mesh_accels_ = accels.used();
    result_->report_.meshes_built = accels.built();
    result_->report_.meshes_reused = accels.reused();
    result_->accel_ = std::make_shared<Accel>(accel_instances);
    result_->bounds_ = result_->accel_->bounds();
    result_->instances_ = std::move(instances);
    result_->geometry_memory_ = memory_of(*result_->instances_);
    if (placed.size() >= kManyInstances) result_->first_instances_ = first_instances();
  }

  // Meshes that several instances share count once.
  static size_t memory_of(const InstanceArray& instances) {
    size_t bytes = instances.size() * sizeof(InstanceData);
    std::unordered_set<const Mesh*> counted;
    const Mesh* last = nullptr;
    for (const InstanceData& instance : instances) {
      // Most instances of many follow one of the same mesh.
      if (instance.mesh.get() == last) continue;
      last = instance.mesh.get();
      if (counted.insert(last).second) bytes += last->memory();
    }
    return bytes;
  }

  std::shared_ptr<const std::vector<uint32_t>> first_instances() const {
    auto first = std::make_shared<std::vector<uint32_t>>(scene_->nodes.size(), CompiledScene::kNoInstance);
    for (const InstanceData& instance : *result_->instances_)
      (*first)[instance.node] = std::min((*first)[instance.node], instance.number);
    return first;
  }

  static void add_round(const Placed& p, InstanceData& data, std::vector<AccelInstance>& accels) {
    data.mesh = p.mesh;
    data.motion = p.motion;
    data.round = p.round;
    data.to_world = p.to_world;
    data.identity = false;
    data.material = p.material;
    data.node = p.node;
    data.cosine_exponent = p.cosine_exponent;
    accels.push_back({p.mesh, nullptr, p.to_world, p.motion, p.round});
  }

  void materials() {
    CompiledScene& r = *result_;
    if (previous_ && previous_->description().materials == scene_->materials &&
        previous_->description().textures == scene_->textures && same_surface_lights()) {
      r.textures_ = previous_->textures_;
      r.materials_ = previous_->materials_;
      r.transparency_ = previous_->transparency_;
      r.subsurface_ = previous_->subsurface_;
      return;
    }
    r.textures_ = previous_ && previous_->description().textures == scene_->textures
                      ? previous_->textures_
                      : std::make_shared<const std::vector<Texture>>(scene_->textures);
    auto compiled = std::make_shared<std::vector<SurfaceMaterial>>();
    for (const Material& m : scene_->materials) {
      compiled->emplace_back(m, *r.textures_);
      r.transparency_ = r.transparency_ || compiled->back().has_alpha;
      r.subsurface_ = r.subsurface_ || compiled->back().has_subsurface;
    }
    if (std::ranges::any_of(scene_->lights, is_hit_by_rays))
      for (const Light& light : scene_->lights) compiled->emplace_back(material_of(light), *r.textures_);
    r.materials_ = std::move(compiled);
    r.report_.materials_built = true;
  }

  bool same_bounds() const {
    return result_->bounds_.min == previous_->bounds_.min && result_->bounds_.max == previous_->bounds_.max;
  }

  // Solids depend on the positions of their boundaries and on some parameters of their materials.
  bool same_solids() const {
    if (!previous_ || result_->report_.top_level_built) return false;
    if (!(scene_->atmosphere == previous_->description().atmosphere)) return false;
    if (!scene_->atmosphere.medium.is_clear() && !same_bounds()) return false;  // its centre is that of the bounds
    if (!result_->report_.materials_built) return true;
    const std::vector<SurfaceMaterial>&a = *result_->materials_, &b = *previous_->materials_;
    return std::ranges::equal(a, b, [](const SurfaceMaterial& x, const SurfaceMaterial& y) {
      const Material &m = x.description, &n = y.description;
      return m.is_solid() == n.is_solid() &&
             (!m.is_solid() ||
              (m.model == n.model && m.ior == n.ior && m.dispersion == n.dispersion && m.glass == n.glass &&
               m.unlit == n.unlit && m.alpha == n.alpha && m.attenuation_color == n.attenuation_color &&
               m.attenuation_distance == n.attenuation_distance && m.medium == n.medium &&
               m.boundary_only == n.boundary_only && m.medium_priority == n.medium_priority &&
               x.is_emissive == y.is_emissive && x.has_alpha == y.has_alpha &&
               bool{x.base_color} == bool{y.base_color}));
    });
  }

  std::shared_ptr<const AtmosphereMedium> atmosphere() const {
    const Atmosphere& from = scene_->atmosphere;
    if (from.medium.is_clear()) return nullptr;
    AtmosphereMedium made;
    made.medium = HomogeneousMedium(from.medium);
    made.radius = from.radius;
    const Bounds& bounds = result_->bounds_;
    if (bounds.min.x <= bounds.max.x) made.centre = 0.5f * (bounds.min + bounds.max);
    if (from.medium.is_heterogeneous()) place_density_in(made);
    return std::make_shared<const AtmosphereMedium>(std::move(made));
  }

  // The density fills the cube around the sphere of the atmosphere.
  void place_density_in(AtmosphereMedium& atmosphere) const {
    if (!std::isfinite(atmosphere.radius)) {
      atmosphere.error = "its density varies, which needs a bounded medium: set atmosphere.radius";
      return;
    }
    const Bounds cube{atmosphere.centre - Vec3(atmosphere.radius), atmosphere.centre + Vec3(atmosphere.radius)};
    auto placed = place_density(scene_->atmosphere.medium, Rgb(0), density_box(cube), false);
    if (placed)
      atmosphere.heterogeneous = *placed;
    else
      atmosphere.error = placed.error().message;
  }

  void solids() {
    if (same_solids()) {
      result_->solids_ = previous_->solids_;
      return;
    }
    const auto atmosphere = this->atmosphere();
    if (!atmosphere && std::ranges::none_of(*result_->instances_, [&](const InstanceData& i) {
          return i.solid != kNoSolid || (*result_->materials_)[i.material].description.is_solid();
        })) {
      result_->solids_ = std::make_shared<Solids>();
      return;
    }
    auto instances = std::make_shared<InstanceArray>(*result_->instances_);
    result_->solids_ = std::make_shared<Solids>(*instances, *result_->materials_, result_->accel_, atmosphere,
                                                world_matrices(*scene_));
    result_->instances_ = std::move(instances);
  }

  // The solids that contain the camera and the lights.
  void start_media() {
    const CompiledScene& r = *result_;
    const bool same = previous_ && r.solids_ == previous_->solids_;
    const std::shared_ptr<const StartMedia> before = same ? previous_->start_media_ : nullptr;
    result_->start_media_ =
        std::make_shared<StartMedia>(*r.solids_, *r.instances_, *r.lights_, r.camera_, r.camera_motion_ != nullptr,
                                     same && r.lights_ == previous_->lights_ ? before.get() : nullptr);
  }

  // The light table depends on the positions and emission of surfaces, the lights and the environment.
  bool same_lights() const {
    if (!previous_) return false;
    const Scene& old = previous_->description();
    if (!(scene_->lights == old.lights) || !(scene_->environment == old.environment)) return false;
    if (!(scene_->atmosphere == old.atmosphere)) return false;
    if (result_->report_.top_level_built && portals() != previous_->lights_->portals().all()) return false;
    if (result_->report_.materials_built && !same_emission(*scene_, old)) return false;
    if (!same_bounds()) return false;
    if (!result_->report_.top_level_built) return true;  // moved instances do not emit light
    return same_light_places(*scene_, old) &&
           same_emitters(*result_->instances_, *previous_->instances_, *result_->materials_);
  }

  // Reuses the light table of the previous scene.
  void keep_lights() {
    result_->lights_ = previous_->lights_;
    result_->emission_memory_ = previous_->emission_memory_;
    if (!result_->report_.top_level_built) return;
    auto instances = std::make_shared<InstanceArray>(*result_->instances_);
    for (size_t i = 0; i < instances->size(); ++i) {
      const InstanceData& old = (*previous_->instances_)[i];
      set_lights(*instances, i, old.first_light, old.emitting);
    }
    result_->instances_ = std::move(instances);
  }

  void lights() {
    result_->emission_spectra_ = !result_->emitter_with_spectrum().empty();
    if (same_lights()) return keep_lights();
    const auto instances = std::make_shared<InstanceArray>(*result_->instances_);
    std::vector<AreaLightTriangle> triangles;
    std::vector<MovingEmitter> moving;
    std::vector<AnalyticAreaLight> round_lights;
    for (uint32_t i = 0; i < instances->size(); ++i) {
      const InstanceData& instance = std::as_const(*instances)[i];
      const SurfaceMaterial& material = (*result_->materials_)[instance.material];
      if (!is_area_light(material)) {
        set_lights(*instances, i, InstanceData::kNotALight, instance.emitting);
        continue;
      }
      const auto first = static_cast<uint32_t>(triangles.size());
      if (instance.round) {
        triangles.push_back(emissive_round(instance, material, round_lights));
        set_lights(*instances, i, first, instance.emitting);
        continue;
      }
      std::shared_ptr<const EmittingTriangles> emitting;
      if (emits_as_before(instance, i)) {
        const InstanceData& old = (*previous_->instances_)[i];
        emitting = old.emitting;
        add_emission_as_before(instance, old, material, triangles);
      } else {
        emitting = add_emissive(instance, material, triangles);
      }
      if (emitting) result_->emission_memory_ += emitting->numbers.size() * sizeof(uint32_t);
      set_lights(*instances, i, first, emitting);
      if (!instance.motion) continue;
      moving.resize(instances->size());
      moving[i] = {instance.mesh, instance.motion};
    }
    result_->instances_ = std::move(instances);
    result_->lights_ =
        std::make_shared<LightTable>(std::move(triangles), placed_lights(), environment_map(), bounds_with_atmosphere(),
                                     std::move(moving), std::move(round_lights), portals());
    result_->report_.lights_built = true;
  }

  // Writes only what changes, because that copies a block of the array.
  static void set_lights(InstanceArray& instances, size_t i, uint32_t first,
                         const std::shared_ptr<const EmittingTriangles>& emitting) {
    const InstanceData& now = std::as_const(instances)[i];
    if (now.first_light == first && now.emitting == emitting) return;
    instances[i].first_light = first;
    instances[i].emitting = emitting;
  }

  // Adds the lights of an instance of which emits_as_before is true.
  void add_emission_as_before(const InstanceData& instance, const InstanceData& old, const SurfaceMaterial& material,
                              std::vector<AreaLightTriangle>& triangles) const {
    const std::span<const AreaLightTriangle> known = previous_emission(old);
    if (same_surface(instance, old))
      triangles.insert(triangles.end(), known.begin(), known.end());
    else
      add_moved(instance, material, known, triangles);
  }

  std::shared_ptr<const EnvironmentMap> environment_map() const {
    if (previous_ && previous_->description().environment == scene_->environment)
      return previous_->lights_->shared_environment();
    return std::make_shared<const EnvironmentMap>(scene_->environment);
  }

  // The bounds of the scene or, if the sphere of the atmosphere is larger, those of a cube that it circumscribes. Light
  // from infinity has to enter through this sphere.
  Bounds bounds_with_atmosphere() const {
    const Bounds& bounds = result_->bounds_;
    const Atmosphere& atmosphere = scene_->atmosphere;
    if (atmosphere.medium.is_clear() || !std::isfinite(atmosphere.radius) || bounds.empty()) return bounds;
    if (atmosphere.radius <= bounds.radius()) return bounds;
    const Vec3 half(atmosphere.radius / std::sqrt(3.0f));
    return {bounds.center() - half, bounds.center() + half};
  }

  // Whether the same instance of the previous scene emits the same radiance: an edit that moves it does not change the
  // means over its texture.
  bool emits_as_before(const InstanceData& instance, uint32_t i) const {
    if (!previous_ || previous_->materials_ != result_->materials_ || i >= previous_->instances_->size()) return false;
    const InstanceData& old = (*previous_->instances_)[i];
    if (old.first_light == InstanceData::kNotALight || old.round || old.material != instance.material) return false;
    return same_parametrization(*instance.mesh, *old.mesh);
  }

  // The lights of an instance of the previous scene.
  std::span<const AreaLightTriangle> previous_emission(const InstanceData& old) const {
    const size_t count = old.emitting ? old.emitting->count : old.mesh->triangles.size();
    return std::span(previous_->lights_->triangles()).subspan(old.first_light, count);
  }

  // At the time of the scene: a portal that moves guides to where it is then.
  std::vector<EnvironmentPortal> portals() const {
    std::vector<EnvironmentPortal> portals;
    std::vector<Mat4> world;
    for (const uint32_t node : reached_nodes()) {
      const Vec2& size = scene_->nodes[node].portal;
      if (!(size.x > 0 && size.y > 0)) continue;
      if (world.empty()) world = world_matrices(*scene_);
      const Mat4 place = without_scale(world[node]);
      portals.push_back({.centre = Vec3(place[3]),
                         .half_x = 0.5f * size.x * Vec3(place[0]),
                         .half_y = 0.5f * size.y * Vec3(place[1]),
                         .normal = -Vec3(place[2])});
    }
    return portals;
  }

  std::vector<PlacedLight> placed_lights() {
    std::vector<PlacedLight> placed;
    const std::vector<Mat4> world = world_matrices(*scene_);
    for (const uint32_t node : reached_nodes()) {
      const Node& n = scene_->nodes[node];
      if (n.light < 0) continue;
      const Light& light = scene_->lights[static_cast<size_t>(n.light)];
      const size_t first = placed.size();
      light.model->place(light.name, light.emitted_color(), world[node], shutter_.motion_of(static_cast<int>(node)),
                         placed);
      for (size_t i = first; i < placed.size(); ++i) placed[i].spectrum = light.spectrum.spectrum;
    }
    return placed;
  }

  std::shared_ptr<const Scene> scene_;
  const CompiledScene* previous_;
  Shutter shutter_;
  std::shared_ptr<CompiledScene> result_;
};

std::shared_ptr<const CompiledScene> compile(std::shared_ptr<const Scene> scene, const Camera& camera,
                                             const std::shared_ptr<const CompiledScene>& previous, int image_height) {
  return Compiler(std::move(scene), camera, previous.get(), image_height).run();
}

}  // namespace etendue::scene
