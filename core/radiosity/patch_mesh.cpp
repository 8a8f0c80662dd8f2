#include "radiosity/patch_mesh.h"

#include <cmath>

#include "scene/facet.h"

namespace etendue::radiosity {
namespace {

double area_of(const Facet& f) { return 0.5 * static_cast<double>(glm::length(glm::cross(f.p1 - f.p0, f.p2 - f.p0))); }

double squared_edges(const Vec3& p0, const Vec3& p1, const Vec3& p2) {
  return static_cast<double>(length_squared(p1 - p0)) + static_cast<double>(length_squared(p2 - p1)) +
         static_cast<double>(length_squared(p0 - p2));
}

// Whether the area of a triangle is a number that rounding errors do not dominate.
bool has_area(const Facet& f) {
  const double area = area_of(f), edges = squared_edges(f.p0, f.p1, f.p2);
  return std::isfinite(edges) && area > 1e-7 * edges && area > 0 && std::isfinite(1 / static_cast<float>(area));
}

// Calls visit(instance index, triangle, facet) for all triangles that are intersected as triangles.
template <class Visit>
void for_each_triangle(const scene::CompiledScene& scene, Visit&& visit) {
  const auto& instances = scene.instances();
  for (uint32_t i = 0; i < instances.size(); ++i) {
    if (instances[i].round) continue;
    for (uint32_t t = 0; t < instances[i].mesh->triangles.size(); ++t) visit(i, t, scene::facet_of(instances[i], t, 0));
  }
}

double total_area(const scene::CompiledScene& scene) {
  double sum = 0;
  for_each_triangle(scene, [&](uint32_t, uint32_t, const Facet& f) { sum += has_area(f) ? area_of(f) : 0; });
  return sum;
}

// The number k of steps along an edge for a triangle, 0 if it has no area.
class StepChoice {
 public:
  StepChoice(const scene::CompiledScene& scene, const MeshSettings& settings)
      : settings_(settings),
        patch_area_(settings.meshing != Meshing::uniform ? total_area(scene) / std::max(1, settings.patches) : 0) {}

  uint32_t operator()(const Facet& f) const {
    if (!has_area(f)) return 0;
    if (settings_.meshing == Meshing::uniform) return static_cast<uint32_t>(settings_.steps);
    const double steps = std::sqrt(area_of(f) / patch_area_);
    if (settings_.meshing == Meshing::quadtree)
      return static_cast<uint32_t>(std::exp2(std::max(0.0, std::round(std::log2(steps)))));
    return static_cast<uint32_t>(std::max(1.0, std::round(steps)));
  }

 private:
  MeshSettings settings_;
  double patch_area_;
};

// The patches before row i of a triangle with k steps. Row i lies between the weights i / k and (i + 1) / k of vertex 1.
uint32_t patches_before_row(uint32_t i, uint32_t k) { return 2 * k * i - i * i; }

}  // namespace

size_t count_patches(const scene::CompiledScene& scene, const MeshSettings& settings) {
  const StepChoice steps(scene, settings);
  size_t count = 0;
  for_each_triangle(scene, [&](uint32_t, uint32_t, const Facet& f) { count += sqr(size_t{steps(f)}); });
  return count;
}

PatchMesh::PatchMesh(const scene::CompiledScene& scene, const MeshSettings& settings) {
  const StepChoice steps(scene, settings);
  const auto& instances = scene.instances();
  size_t cells = 0;
  for (const auto& instance : instances) {
    first_cell_.push_back(static_cast<uint32_t>(cells));
    cells += instance.round ? 1 : instance.mesh->triangles.size();
    quality_.shapes += instance.round ? 1 : 0;
  }
  cells_.resize(cells);
  size_t count = 0;
  for_each_triangle(scene, [&](uint32_t, uint32_t, const Facet& f) { count += sqr(size_t{steps(f)}); });
  patches_.reserve(count);
  for_each_triangle(scene, [&](uint32_t i, uint32_t t, const Facet& f) {
    const uint32_t k = steps(f);
    ++quality_.triangles;
    quality_.degenerate += k == 0 ? 1 : 0;
    cells_[first_cell_[i] + t] = {static_cast<uint32_t>(patches_.size()), k};
    divide(instances[i], i, t, k);
  });
  quality_.smallest = patches_.empty() ? 0 : HUGE_VAL;
  for (const Patch& p : patches_) {
    const double area = p.area, edges = squared_edges(p.p0, p.p1, p.p2);
    quality_.area += area;
    quality_.smallest = std::min(quality_.smallest, area);
    quality_.largest = std::max(quality_.largest, area);
    quality_.slivers += 4 * std::sqrt(3.0) * area < 0.1 * edges ? 1 : 0;
    for (const float edge : {glm::distance(p.p0, p.p1), glm::distance(p.p1, p.p2), glm::distance(p.p2, p.p0)})
      quality_.longest_edge = std::max(quality_.longest_edge, static_cast<double>(edge));
  }
}

void PatchMesh::divide(const scene::InstanceData& instance, uint32_t index, uint32_t triangle, uint32_t steps) {
  if (steps == 0) return;
  const Facet f = scene::facet_of(instance, triangle, 0);
  const Vec3 e1 = f.p1 - f.p0, e2 = f.p2 - f.p0, normal = scene::normal_of(f);
  const float k = static_cast<float>(steps);
  const auto area = static_cast<float>(area_of(f) / sqr(static_cast<double>(steps)));
  const auto corner = [&](uint32_t i, uint32_t j) {
    return f.p0 + e1 * (static_cast<float>(i) / k) + e2 * (static_cast<float>(j) / k);
  };
  const auto add = [&](const Vec3& p0, const Vec3& p1, const Vec3& p2) {
    patches_.push_back({p0, p1, p2, normal, area, scene::offset_bound(p0, e1, e2), index, triangle});
  };
  for (uint32_t i = 0; i < steps; ++i)
    for (uint32_t j = 0; i + j < steps; ++j) {
      add(corner(i, j), corner(i + 1, j), corner(i, j + 1));
      if (i + j + 1 < steps) add(corner(i + 1, j + 1), corner(i, j + 1), corner(i + 1, j));
    }
}

PatchMesh::Location PatchMesh::locate(uint32_t instance, uint32_t triangle, float u, float v, bool front) const {
  const Cell cell = cells_[first_cell_[instance] + triangle];
  if (cell.steps == 0) return {};
  const float k = static_cast<float>(cell.steps), x = std::max(u, 0.0f) * k, y = std::max(v, 0.0f) * k;
  const uint32_t i = std::min(static_cast<uint32_t>(x), cell.steps - 1);
  const uint32_t j = std::min(static_cast<uint32_t>(y), cell.steps - 1 - i);
  const Vec2 in_square(x - static_cast<float>(i), y - static_cast<float>(j));
  const bool upper = in_square.x + in_square.y > 1 && i + j + 1 < cell.steps;
  const uint32_t patch = cell.first + patches_before_row(i, cell.steps) + 2 * j + (upper ? 1 : 0);
  return {2 * patch + (front ? 0 : 1), glm::clamp(upper ? 1.0f - in_square : in_square, 0.0f, 1.0f)};
}

uint32_t PatchMesh::element_at(const Hit& hit, const Vec3& direction) const {
  const uint32_t front = locate(hit.instance, hit.triangle, hit.u, hit.v, true).element;
  if (front == kNoElement) return front;
  return front + (glm::dot(direction, patch_of(front).normal) < 0 ? 0 : 1);
}

Vec2 PatchMesh::in_triangle(uint32_t patch, Vec2 barycentric) const {
  const Patch& p = patches_[patch];
  const Cell cell = cells_[first_cell_[p.instance] + p.triangle];
  const uint32_t k = cell.steps, n = patch - cell.first;
  uint32_t i = 0;
  while (patches_before_row(i + 1, k) <= n) ++i;
  const uint32_t in_row = n - patches_before_row(i, k);
  const Vec2 in_square = in_row % 2 == 0 ? barycentric : 1.0f - barycentric;
  return (Vec2(static_cast<float>(i), static_cast<float>(in_row / 2)) + in_square) / static_cast<float>(k);
}

size_t PatchMesh::memory() const {
  return patches_.capacity() * sizeof(Patch) + cells_.capacity() * sizeof(Cell) +
         first_cell_.capacity() * sizeof(uint32_t);
}

}  // namespace etendue::radiosity
