#include "scene/solids.h"

#include <algorithm>
#include <cmath>
#include <tuple>

#include "scene/density_placement.h"
#include "scene/facet.h"

namespace etendue::scene {
namespace {

bool is_solid(const InstanceData& instance, const SurfaceMaterial& material) {
  return !instance.round && material.description.is_solid() && !material.description.unlit;
}

// Absorption that corresponds to KHR_materials_volume, 1/m. Colours are bounded below, so that it stays finite.
Rgb absorption_of_attenuation(const Material& m) {
  constexpr float kDarkest = 1e-30f;
  Rgb absorption(0);
  for (int c = 0; c < 3; ++c)
    if (std::isfinite(m.attenuation_distance))
      absorption[c] = -std::log(std::clamp(m.attenuation_color[c], kDarkest, 1.0f)) / m.attenuation_distance;
  return absorption;
}

// Whether stochastic opacity may let rays pass the surface.
bool may_pass_by_alpha(const InstanceData& instance, const SurfaceMaterial& material) {
  return material.has_alpha &&
         (material.description.alpha < 1 || material.base_color || !instance.mesh->colors.empty());
}

// Over the shutter interval. Vertices move in straight lines between motion steps.
Bounds bounds_over_time(const InstanceData& instance) {
  Bounds bounds;
  const Motion* motion = instance.motion.get();
  if (!motion) return bounds_of(*instance.mesh, instance.identity ? Mat4(1) : instance.to_world);
  for (const Mat4& to_world : motion->to_world) bounds.extend(bounds_of(*instance.mesh, to_world));
  for (const DeformedVertices& vertices : motion->vertices)
    for (const Vec3& p : vertices.positions) bounds.extend(p);
  return bounds;
}

float largest_offset(const InstanceData& instance, const Bounds& bounds) {
  const Vec3 farthest = glm::max(glm::abs(bounds.min), glm::abs(bounds.max));
  float largest = 0;
  for (uint32_t t = 0; t < instance.mesh->triangles.size(); ++t) {
    const Facet f = facet_of(instance, t, 0);
    largest = std::max(largest, offset_bound(farthest, f.p1 - f.p0, f.p2 - f.p0));
  }
  return largest;
}

float surface_area(const Bounds& bounds) {
  const Vec3 size = bounds.max - bounds.min;
  return 2 * (size.x * size.y + size.y * size.z + size.z * size.x);
}

bool bounds_overlap(const Solid& a, const Solid& b) {
  const Vec3 gap = glm::max(a.bounds.min - b.bounds.max, b.bounds.min - a.bounds.max);
  return max_component(gap) <= a.offset + b.offset;
}

bool contains(const Bounds& bounds, const Vec3& p) {
  return glm::all(glm::greaterThanEqual(p, bounds.min)) && glm::all(glm::lessThanEqual(p, bounds.max));
}

// Collects all boundaries of solids along a ray; nothing blocks the ray.
class BoundaryCollector final : public OpacityTest {
 public:
  explicit BoundaryCollector(const InstanceArray& instances) : instances_(instances) {}

  std::span<const Hit> trace(const Accel& accel, const Ray& ray, float time) {
    found().clear();
    Hit none;
    accel.intersect(ray, this, 0, none, time);
    return found();
  }

  bool blocks_ray(uint32_t instance, uint32_t triangle, float u, float v, uint32_t) const override {
    if (instances_[instance].solid != kNoSolid) found().push_back({instance, triangle, u, v, 0});
    return false;
  }

 private:
  static std::vector<Hit>& found() {
    static thread_local std::vector<Hit> hits;
    return hits;
  }

  const InstanceArray& instances_;
};

// Hits on the boundary of one solid: those of positive orientation minus those of negative orientation.
struct BoundaryCount {
  uint32_t solid;
  int sum;
  Hit hit;
};

void count_boundary(std::vector<BoundaryCount>& counts, uint32_t solid, const Hit& hit, bool positive) {
  auto at = std::ranges::find(counts, solid, &BoundaryCount::solid);
  if (at == counts.end()) at = counts.insert(at, {solid, 0, hit});
  at->sum += positive ? 1 : -1;
}

}  // namespace

Rgb Solid::transmittance_of_medium(float distance) const {
  if (!is_black(medium.extinction)) return medium.transmittance(distance);
  HomogeneousMedium absorbing;
  absorbing.extinction = absorption;
  const Rgb own = absorbing.transmittance(distance);
  return std::isfinite(attenuation_distance) ? own * attenuation(distance) : own;
}

Solids::Solids(InstanceArray& instances, const std::vector<SurfaceMaterial>& materials,
               std::shared_ptr<const Accel> accel, std::shared_ptr<const AtmosphereMedium> atmosphere,
               const std::vector<Mat4>& world)
    : accel_(std::move(accel)), atmosphere_(std::move(atmosphere)), scatters_(atmosphere_ != nullptr) {
  assign_priorities(instances, materials);
  set_media(instances, materials, world);
}

void Solids::assign_priorities(InstanceArray& instances, const std::vector<SurfaceMaterial>& materials) {
  const auto same_inside = [&](const Solid& a, const Solid& b) {
    return a.index == b.index && a.attenuation_color == b.attenuation_color &&
           a.attenuation_distance == b.attenuation_distance && a.has_surface == b.has_surface &&
           a.priority == b.priority &&
           materials[a.material].description.medium == materials[b.material].description.medium;
  };
  std::vector<Solid> all;
  for (InstanceData& instance : instances) {
    instance.solid = kNoSolid;
    const SurfaceMaterial& material = materials[instance.material];
    if (!is_solid(instance, material)) continue;
    Solid inside;
    inside.node = instance.node, inside.material = instance.material;
    inside.index = material.description.inside_index();
    inside.eta = inside.index.index_d;
    inside.absorbs = material.absorbs_inside;
    inside.attenuation_color = material.description.attenuation_color;
    inside.attenuation_distance = material.description.attenuation_distance;
    inside.absorption = material.description.medium.absorption;
    const Rgb attenuation = absorption_of_attenuation(material.description);
    inside.absorption_spectrum = material.description.medium.spectra(attenuation).absorption;
    if (material.description.medium.is_volume())
      inside.medium = HomogeneousMedium(material.description.medium, attenuation);
    inside.has_surface = !material.description.boundary_only || material.is_emissive;
    inside.priority = material.description.medium_priority;
    // The primitives of a node are adjacent.
    size_t at = all.size();
    for (size_t i = all.size(); i > 0 && all[i - 1].node == instance.node; --i)
      if (same_inside(all[i - 1], inside)) at = i - 1;
    if (at == all.size()) all.push_back(inside);
    Solid& solid = all[at];
    solid.bounds.extend(bounds_over_time(instance));
    solid.is_emissive = solid.is_emissive || material.is_emissive;
    solid.has_alpha = solid.has_alpha || may_pass_by_alpha(instance, material);
    solid.is_moving = solid.is_moving || instance.motion;
    instance.solid = static_cast<uint32_t>(at);
  }
  for (const InstanceData& instance : instances)
    if (instance.solid != kNoSolid)
      all[instance.solid].offset =
          std::max(all[instance.solid].offset, largest_offset(instance, all[instance.solid].bounds));
  std::swap(all, solids_);
  find_overlaps();
  std::swap(all, solids_);

  std::vector<uint32_t> order;
  for (uint32_t i = 0; i < all.size(); ++i)
    if (all[i].absorbs || all[i].may_overlap || !all[i].has_surface || atmosphere_) order.push_back(i);
  std::ranges::stable_sort(order, [&](uint32_t a, uint32_t b) {
    const auto key = [](const Solid& s) { return std::tuple(-s.priority, !s.has_surface, surface_area(s.bounds)); };
    return key(all[a]) < key(all[b]);
  });
  std::vector<uint32_t> numbers(all.size(), kNoSolid);
  for (const uint32_t i : order) {
    numbers[i] = static_cast<uint32_t>(solids_.size());
    solids_.push_back(all[i]);
    any_has_alpha_ = any_has_alpha_ || all[i].has_alpha;
    any_without_surface_ = any_without_surface_ || !all[i].has_surface;
    if (all[i].may_overlap) may_overlap_ = true, offset_ = std::max(offset_, all[i].offset);
  }
  for (InstanceData& instance : instances)
    if (instance.solid != kNoSolid) instance.solid = numbers[instance.solid];
}

void Solids::set_media(const InstanceArray& instances, const std::vector<SurfaceMaterial>& materials,
                       const std::vector<Mat4>& world) {
  for (uint32_t i = 0; i < solids_.size(); ++i) {
    Solid& solid = solids_[i];
    const Material& material = materials[solid.material].description;
    if (material.medium.is_heterogeneous() && solid.node < world.size()) {
      const auto placed = place_density(material.medium, absorption_of_attenuation(material),
                                        density_box(instances, i, world[solid.node]), solid.is_moving);
      if (placed)
        solid.heterogeneous = *placed;
      else if (medium_error_.empty())
        medium_error_ = "material '" + material.name + "': " + placed.error().message;
    }
    scatters_ = scatters_ || solid.is_volume();
    any_heterogeneous_ = any_heterogeneous_ || material.medium.is_heterogeneous();
    any_medium_emits_ = any_medium_emits_ || solid.medium.emits();
  }
  if (any_medium_emits_ || (atmosphere_ && atmosphere_->medium.emits())) find_emitters();
  if (!atmosphere_) return;
  any_heterogeneous_ = any_heterogeneous_ || atmosphere_->heterogeneous;
  any_medium_emits_ = any_medium_emits_ || atmosphere_->medium.emits();
  if (!atmosphere_->error.empty()) medium_error_ = "atmosphere: " + atmosphere_->error;
}

void Solids::find_emitters() {
  std::vector<EmitterBox> boxes, boxes_with_surface;
  for (const Solid& solid : solids_) {
    if (!solid.medium.emits()) continue;
    (solid.has_surface ? boxes_with_surface : boxes)
        .push_back(solid.heterogeneous ? emitter_box(*solid.heterogeneous)
                                       : emitter_box(solid.medium, solid.bounds.min, solid.bounds.max));
  }
  if (atmosphere_ && atmosphere_->medium.emits() && std::isfinite(atmosphere_->radius)) {
    const Vec3 half(atmosphere_->radius);
    boxes.push_back(atmosphere_->heterogeneous
                        ? emitter_box(*atmosphere_->heterogeneous)
                        : emitter_box(atmosphere_->medium, atmosphere_->centre - half, atmosphere_->centre + half));
  }
  emitters_ = MediumEmitters(boxes);
  boxes.insert(boxes.end(), boxes_with_surface.begin(), boxes_with_surface.end());
  emission_points_ = MediumEmitters(boxes);
}

Rgb Solids::emission_at(const MediumStack& stack, const Vec3& position) const {
  const auto emission_of = [&](const HomogeneousMedium& medium, const HeterogeneousMedium* heterogeneous) {
    if (!heterogeneous) return medium.emission;
    const Vec3 p = heterogeneous->in_grid(position);
    return heterogeneous->emitted(p, heterogeneous->grid->density(p));
  };
  if (const Solid* solid = find(stack.top())) return emission_of(solid->medium, solid->heterogeneous.get());
  if (!atmosphere_ || !(glm::distance(position, atmosphere_->centre) < atmosphere_->radius)) return Rgb(0);
  return emission_of(atmosphere_->medium, atmosphere_->heterogeneous.get());
}

// Sweeps along the x axis.
void Solids::find_overlaps() {
  std::vector<Solid*> order;
  for (Solid& solid : solids_) order.push_back(&solid);
  std::ranges::sort(order, [](const Solid* a, const Solid* b) { return a->bounds.min.x < b->bounds.min.x; });
  float largest = 0;
  for (const Solid& solid : solids_) largest = std::max(largest, solid.offset);
  for (size_t i = 0; i < order.size(); ++i)
    for (size_t j = i + 1; j < order.size() && order[j]->bounds.min.x <= order[i]->bounds.max.x + 2 * largest; ++j)
      if (!(order[i]->may_overlap && order[j]->may_overlap) && bounds_overlap(*order[i], *order[j]))
        order[i]->may_overlap = order[j]->may_overlap = true;
}

MediumStack Solids::containing(const InstanceArray& instances, const Vec3& point, float time, uint32_t except) const {
  MediumStack stack;
  bool any = false;
  for (uint32_t i = 0; i < solids_.size() && !any; ++i) any = i != except && contains(solids_[i].bounds, point);
  if (!any) return stack;

  BoundaryCollector collector(instances);
  static thread_local std::vector<BoundaryCount> counts;  // light paths that start in media call this function
  // A ray that starts inside a closed boundary leaves it once more than it enters it.
  const auto containing_by_ray = [&](const Vec3& direction) {
    Ray ray;
    ray.origin = point;
    ray.direction = direction;
    counts.clear();
    for (const Hit& hit : collector.trace(*accel_, ray, time)) {
      const InstanceData& instance = instances[hit.instance];
      const bool leaves = glm::dot(normal_of(facet_of(instance, hit.triangle, time)), direction) > 0;
      if (instance.solid != except) count_boundary(counts, instance.solid, hit, leaves);
    }
    MediumStack inside;
    for (const BoundaryCount& c : counts)
      if (c.sum > 0) inside.insert(c.solid);
    return inside;
  };
  const MediumStack first = containing_by_ray(glm::normalize(Vec3(0.36f, 0.86f, 0.35f)));
  const MediumStack second = containing_by_ray(glm::normalize(Vec3(-0.71f, -0.23f, 0.66f)));
  if (first == second) return first;
  const MediumStack third = containing_by_ray(glm::normalize(Vec3(0.28f, -0.57f, -0.77f)));
  for (const uint32_t solid : first.solids())
    if (second.contains(solid) || third.contains(solid)) stack.insert(solid);
  for (const uint32_t solid : second.solids())
    if (third.contains(solid)) stack.insert(solid);
  return stack;
}

bool Solids::find_interface(const InstanceArray& instances, const MediumStack& stack, float time, Hit& hit,
                            MediumInterface& interface) const {
  const uint32_t hit_solid = instances[hit.instance].solid;
  interface.clear(stack);
  interface.add_boundary(hit_solid, true);
  if (!solids_[hit_solid].may_overlap) return solids_[hit_solid].has_surface;
  add_coincident(instances, time, hit, interface);
  bool is_emissive = false, has_surface = false;
  for (size_t i = 0; i < interface.count; ++i) {
    const Solid& solid = solids_[interface.boundaries[i]];
    is_emissive = is_emissive || solid.is_emissive;
    has_surface = has_surface || solid.has_surface;
  }
  return is_emissive || (has_surface && interface.top(true) != interface.top(false));
}

// Finds boundaries within rounding errors of the hit by a short ray across the surface. Opposite boundaries of one
// solid cancel: they enclose a part without thickness.
void Solids::add_coincident(const InstanceArray& instances, float time, Hit& hit, MediumInterface& interface) const {
  const uint32_t hit_solid = instances[hit.instance].solid;
  const Facet facet = facet_of(instances[hit.instance], hit.triangle, time);
  const Vec3 e1 = facet.p1 - facet.p0, e2 = facet.p2 - facet.p0, normal = normal_of(facet);
  const Vec3 position = facet.p0 + e1 * hit.u + e2 * hit.v;
  const float error = offset_bound(position, e1, e2), reach = error + offset_;
  interface.offset = error;
  Ray short_ray;
  short_ray.origin = position + normal * reach;
  short_ray.direction = -normal;
  short_ray.tfar = 2 * reach;

  static thread_local std::vector<BoundaryCount> counts;
  counts.clear();
  BoundaryCollector collector(instances);
  for (const Hit& other : collector.trace(*accel_, short_ray, time)) {
    const uint32_t solid = instances[other.instance].solid;
    if (solid == hit_solid) continue;
    const Facet f = facet_of(instances[other.instance], other.triangle, time);
    const float error_of_other = offset_bound(position, f.p1 - f.p0, f.p2 - f.p0);
    if (std::abs(glm::dot(normal_of(f), position - f.p0)) > error + error_of_other) continue;
    interface.offset = std::max(interface.offset, error_of_other);
    count_boundary(counts, solid, other, glm::dot(normal_of(f), normal) > 0);
  }
  if (counts.empty()) return;

  std::ranges::sort(counts, {}, &BoundaryCount::solid);
  const auto precedes = [&](uint32_t a, uint32_t b) {
    const auto key = [&](uint32_t i) { return std::tuple(!solids_[i].is_emissive, !solids_[i].has_surface, i); };
    return key(a) < key(b);
  };
  uint32_t chosen = hit_solid;
  bool flipped = false;
  for (const BoundaryCount& c : counts) {
    if (c.sum == 0 || interface.count == MediumInterface::kMaxBoundaries) continue;
    interface.add_boundary(c.solid, c.sum > 0);
    if (!precedes(c.solid, chosen)) continue;
    chosen = c.solid;
    flipped = c.sum < 0;
    hit = {c.hit.instance, c.hit.triangle, c.hit.u, c.hit.v, hit.t};
  }
  if (flipped) interface.flip();
}

}  // namespace etendue::scene
