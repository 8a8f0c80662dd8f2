// Compiles a scene::Scene into a CompiledScene, reusing the unchanged parts of a previous one.
#include <chrono>
#include <unordered_map>

#include "light/placed_light.h"
#include "scene/compiled_scene.h"
#include "scene/density_placement.h"
#include "scene/facet.h"
#include "scene/gltf/parallel_jobs.h"
#include "scene/light_shapes.h"
#include "scene/pose.h"
#include "scene/shutter.h"
#include "scene/texture_point.h"
#include "scene/unchanged_lights.h"

namespace etendue::scene {
namespace {

// Meshes with a single instance are part of the top level, up to this total number of triangles: that many can be
// rebuilt within a frame.
constexpr size_t kTopLevelBudget = 200'000;
// After an edit that moves objects. Larger meshes become instances, so that further edits rebuild few triangles.
constexpr size_t kMovingTopLevelBudget = 10'000;

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
        scene_->skins != old.skins || scene_->animations != old.animations ||
        scene_->meshes.size() != old.meshes.size() || scene_->nodes.size() != old.nodes.size())
      return false;
    for (size_t i = 0; i < scene_->nodes.size(); ++i)
      if (!(scene_->nodes[i] == old.nodes[i])) return false;
    for (size_t i = 0; i < scene_->meshes.size(); ++i)
      if (!(scene_->meshes[i] == old.meshes[i])) return false;
    return same_surface_lights() && scene_->materials.size() == old.materials.size();
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

  // The acceleration structures of meshes that the previous scene built.
  std::unordered_map<const Mesh*, std::shared_ptr<const MeshAccel>> previous_accels() const {
    std::unordered_map<const Mesh*, std::shared_ptr<const MeshAccel>> accels;
    if (previous_)
      for (const auto& accel : previous_->mesh_accels_)
        if (accel) accels[accel->mesh().get()] = accel;
    return accels;
  }

  // Whether an edit moved objects. The next edit probably moves them again.
  bool moves_objects() const {
    if (!previous_) return false;
    const Scene& old = previous_->description();
    if (scene_->time != old.time || scene_->clip != old.clip || scene_->nodes.size() != old.nodes.size()) return false;
    return !std::ranges::equal(scene_->nodes, old.nodes, {}, &Node::transform, &Node::transform);
  }

  void build(const std::vector<Placed>& placed) {
    std::unordered_map<const Mesh*, int> uses;
    for (const auto& p : placed) ++uses[p.mesh.get()];
    auto accels = previous_accels();
    const auto reusable = accels;

    auto instances = std::make_shared<std::vector<InstanceData>>();
    std::vector<AccelInstance> accel_instances;
    size_t budget = moves_objects() ? kMovingTopLevelBudget : kTopLevelBudget;
    for (const auto& p : placed) {
      if (p.round) {
        add_round(p, *instances, accel_instances);
        continue;
      }
      InstanceData data;
      AccelInstance in_accel;
      const size_t triangles = p.mesh->triangles.size();
      result_->triangles_ += triangles;
      // A mesh that deforms is in world space at all times. Rigid motion is a sequence of matrices of an instance.
      const bool in_top_level =
          p.motion ? p.motion->deforms()
                   : uses[p.mesh.get()] == 1 && triangles <= budget && !reusable.contains(p.mesh.get());
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
        data.identity = p.to_world == Mat4(1);
        data.to_world = p.to_world;
        data.normal_to_world = glm::transpose(glm::inverse(Mat3(p.to_world)));
        auto& accel = accels[p.mesh.get()];
        if (accel && reusable.contains(p.mesh.get())) {
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
      in_accel.mesh = data.mesh;
      in_accel.motion = p.motion;
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
    data.mesh = p.mesh;
    data.motion = p.motion;
    data.round = p.round;
    data.to_world = p.to_world;
    data.identity = false;
    data.material = p.material;
    data.node = p.node;
    data.cosine_exponent = p.cosine_exponent;
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

  // Solids depend on the positions of their boundaries and on some parameters of their materials.
  bool same_solids() const {
    if (!previous_ || result_->report_.top_level_built) return false;
    if (!(scene_->atmosphere == previous_->description().atmosphere)) return false;
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
    auto instances = std::make_shared<std::vector<InstanceData>>(*result_->instances_);
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
    if (!result_->report_.top_level_built) return true;
    const Bounds &a = result_->bounds_, &b = previous_->bounds_;
    return a.min == b.min && a.max == b.max && same_light_places(*scene_, old) &&
           same_emitters(*result_->instances_, *previous_->instances_, *result_->materials_);
  }

  // Reuses the light table of the previous scene.
  void keep_lights() {
    result_->lights_ = previous_->lights_;
    if (!result_->report_.top_level_built) return;
    auto instances = std::make_shared<std::vector<InstanceData>>(*result_->instances_);
    for (size_t i = 0; i < instances->size(); ++i) {
      (*instances)[i].first_light = (*previous_->instances_)[i].first_light;
      (*instances)[i].emitting = (*previous_->instances_)[i].emitting;
    }
    result_->instances_ = std::move(instances);
  }

  void lights() {
    result_->emission_spectra_ = !result_->emitter_with_spectrum().empty();
    if (same_lights()) return keep_lights();
    auto instances = std::make_shared<std::vector<InstanceData>>(*result_->instances_);
    std::vector<AreaLightTriangle> triangles;
    std::vector<MovingEmitter> moving;
    std::vector<AnalyticAreaLight> round_lights;
    for (uint32_t i = 0; i < instances->size(); ++i) {
      InstanceData& instance = (*instances)[i];
      const SurfaceMaterial& material = (*result_->materials_)[instance.material];
      instance.first_light = InstanceData::kNotALight;
      if (!is_area_light(material)) continue;
      instance.first_light = static_cast<uint32_t>(triangles.size());
      if (instance.round) {
        triangles.push_back(emissive_round(instance, material, i, round_lights));
        continue;
      }
      if (emits_as_before(instance, i)) {
        const InstanceData& old = (*previous_->instances_)[i];
        const std::span<const AreaLightTriangle> known = previous_emission(old);
        instance.emitting = old.emitting;
        if (same_surface(instance, old)) {
          triangles.insert(triangles.end(), known.begin(), known.end());
          continue;
        }
        add_moved(instance, material, i, known, triangles);
      } else {
        instance.emitting = add_emissive(instance, material, i, triangles);
      }
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

  // Calls job(i) for all i below `count`, on all threads.
  static void for_each_triangle(size_t count, const std::function<void(size_t)>& job) {
    constexpr size_t kTrianglesOfAJob = 2048;
    const auto range = [&](size_t number) {
      const size_t begin = number * kTrianglesOfAJob;
      for (size_t t = begin; t < std::min(begin + kTrianglesOfAJob, count); ++t) job(t);
    };
    gltf::run_jobs((count + kTrianglesOfAJob - 1) / kTrianglesOfAJob, range, [](float) { return true; });
  }

  // Appends the lights of an instance that emits as before at another place. `known` are those of the previous scene.
  static void add_moved(const InstanceData& instance, const SurfaceMaterial& material, uint32_t i,
                        std::span<const AreaLightTriangle> known, std::vector<AreaLightTriangle>& triangles) {
    const size_t first = triangles.size();
    triangles.resize(first + known.size());
    for_each_triangle(known.size(), [&](size_t t) {
      triangles[first + t] = emissive(instance, material, i, known[t].triangle, &known[t].radiance);
    });
  }

  // Appends the lights of an instance. Triangles on which an emission texture is black at all points of its mean are left
  // out; the result states which, and is null if there are none.
  static std::shared_ptr<const EmittingTriangles> add_emissive(const InstanceData& instance,
                                                               const SurfaceMaterial& material, uint32_t i,
                                                               std::vector<AreaLightTriangle>& triangles) {
    const size_t count = instance.mesh->triangles.size(), first = triangles.size();
    triangles.resize(first + count);
    for_each_triangle(count, [&](size_t t) {
      triangles[first + t] = emissive(instance, material, i, static_cast<uint32_t>(t), nullptr);
    });
    const auto is_dark = [](const AreaLightTriangle& t) { return is_black(t.radiance); };
    const auto begin = triangles.begin() + static_cast<std::ptrdiff_t>(first);
    if (!material.emission || std::none_of(begin, triangles.end(), is_dark)) return nullptr;
    triangles.erase(std::remove_if(begin, triangles.end(), is_dark), triangles.end());
    auto emitting = std::make_shared<EmittingTriangles>();
    emitting->numbers.assign(count, InstanceData::kNotALight);
    for (size_t t = first; t < triangles.size(); ++t) emitting->numbers[triangles[t].triangle] = emitting->count++;
    return emitting;
  }

  // `known_mean` is the mean of textured emission; null if it is to be computed.
  static AreaLightTriangle emissive(const InstanceData& instance, const SurfaceMaterial& material, uint32_t i,
                                    uint32_t t, const Rgb* known_mean) {
    const Mesh& mesh = *instance.mesh;
    AreaLightTriangle e;
    e.instance = i;
    e.triangle = t;
    e.radiance = material.description.emission;
    e.double_sided = material.description.double_sided;
    e.moving = instance.motion != nullptr;
    e.cosine_exponent = instance.cosine_exponent;
    e.set_triangle(facet_of(instance, t, 0.5f));
    e.textured = static_cast<bool>(material.emission);
    if (material.emission && known_mean) {
      e.radiance = *known_mean;
    } else if (material.emission) {
      // The mean over seven points of the triangle.
      Rgb sum(0);
      constexpr float kPoints[7][2] = {{1 / 3.f, 1 / 3.f}, {.8f, .1f},  {.1f, .8f}, {.1f, .1f},
                                       {.45f, .45f},       {.45f, .1f}, {.1f, .45f}};
      for (const auto& b : kPoints) sum += material.emission_at(texture_point(mesh, t, b[0], b[1]));
      e.radiance = sum / 7;
    }
    return e;
  }

  static AreaLightTriangle emissive_round(const InstanceData& instance, const SurfaceMaterial& material, uint32_t i,
                                          std::vector<AnalyticAreaLight>& round_lights) {
    AnalyticAreaLight round{*instance.round, instance.motion};
    if (round.motion) round.shape = round.at(0.5f);
    AreaLightTriangle e;
    e.instance = i;
    e.cosine_exponent = instance.cosine_exponent;
    e.radiance = material.description.emission;
    e.double_sided = material.description.double_sided;
    e.set_shape(static_cast<int>(round_lights.size()), round.shape);
    round_lights.push_back(std::move(round));
    return e;
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
