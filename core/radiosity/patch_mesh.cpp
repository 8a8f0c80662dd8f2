#include "radiosity/patch_mesh.h"

#include <algorithm>
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

// An adaptive mesh starts with the number of patches divided by this.
constexpr int kFirstPart = 2;

// The number k of steps along an edge for a triangle, 0 if it has no area.
class StepChoice {
 public:
  StepChoice(const scene::CompiledScene& scene, const MeshSettings& settings)
      : settings_(settings),
        patch_area_(settings.meshing != Meshing::uniform ? total_area(scene) / first_patches(settings) : 0) {}

  uint32_t operator()(const Facet& f) const {
    if (!has_area(f)) return 0;
    if (settings_.meshing == Meshing::uniform) return static_cast<uint32_t>(settings_.steps);
    const double steps = std::sqrt(area_of(f) / patch_area_);
    if (settings_.meshing == Meshing::quadtree)
      return static_cast<uint32_t>(std::exp2(std::max(0.0, std::round(std::log2(steps)))));
    return static_cast<uint32_t>(std::max(1.0, std::round(steps)));
  }

 private:
  static int first_patches(const MeshSettings& settings) {
    const int part = settings.meshing == Meshing::adaptive ? settings.patches / kFirstPart : settings.patches;
    return std::max(1, part);
  }

  MeshSettings settings_;
  double patch_area_;
};

// A place in one of the k^2 congruent parts of a triangle. Barycentric coordinates are the weights of vertices 1 and 2.
struct Part {
  uint32_t number;
  Vec2 barycentric;  // within the part
};

// The parts before row i. Row i lies between the weights i / k and (i + 1) / k of vertex 1.
uint32_t parts_before_row(uint32_t i, uint32_t k) { return 2 * k * i - i * i; }

Part part_at(Vec2 barycentric, uint32_t steps) {
  const Vec2 scaled = glm::max(barycentric, 0.0f) * static_cast<float>(steps);
  const uint32_t i = std::min(static_cast<uint32_t>(scaled.x), steps - 1);
  const uint32_t j = std::min(static_cast<uint32_t>(scaled.y), steps - 1 - i);
  const Vec2 in_square = scaled - Vec2(static_cast<float>(i), static_cast<float>(j));
  const bool upper = in_square.x + in_square.y > 1 && i + j + 1 < steps;
  return {parts_before_row(i, steps) + 2 * j + (upper ? 1 : 0),
          glm::clamp(upper ? 1.0f - in_square : in_square, 0.0f, 1.0f)};
}

// The inverse of part_at.
Vec2 in_whole(const Part& part, uint32_t steps) {
  uint32_t i = 0;
  while (parts_before_row(i + 1, steps) <= part.number) ++i;
  const uint32_t in_row = part.number - parts_before_row(i, steps);
  const Vec2 in_square = in_row % 2 == 0 ? part.barycentric : 1.0f - part.barycentric;
  return (Vec2(static_cast<float>(i), static_cast<float>(in_row / 2)) + in_square) / static_cast<float>(steps);
}

// Calls add(p0, p1, p2) for the parts of a triangle, in the order of their numbers.
template <class Add>
void for_each_part(const Vec3& origin, const Vec3& e1, const Vec3& e2, uint32_t steps, Add&& add) {
  const auto k = static_cast<float>(steps);
  const auto corner = [&](uint32_t i, uint32_t j) {
    return origin + e1 * (static_cast<float>(i) / k) + e2 * (static_cast<float>(j) / k);
  };
  for (uint32_t i = 0; i < steps; ++i)
    for (uint32_t j = 0; i + j < steps; ++j) {
      add(corner(i, j), corner(i + 1, j), corner(i, j + 1));
      if (i + j + 1 < steps) add(corner(i + 1, j + 1), corner(i, j + 1), corner(i + 1, j));
    }
}

constexpr uint32_t kChildSteps = 2, kChildren = 4;

}  // namespace

size_t count_patches(const scene::CompiledScene& scene, const MeshSettings& settings) {
  const StepChoice steps(scene, settings);
  size_t count = 0;
  for_each_triangle(scene, [&](uint32_t, uint32_t, const Facet& f) { count += sqr(size_t{steps(f)}); });
  return settings.meshing == Meshing::adaptive ? std::max(count, static_cast<size_t>(settings.patches)) : count;
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
  measure_quality();
}

void PatchMesh::measure_quality() {
  quality_.area = quality_.largest = quality_.longest_edge = 0;
  quality_.slivers = 0;
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

PatchMesh PatchMesh::refined(const std::vector<char>& divided, std::vector<uint32_t>* parts_of) const {
  const auto count = static_cast<size_t>(std::ranges::count_if(divided, [](char d) { return d != 0; }));
  PatchMesh mesh;
  mesh.cells_ = cells_;
  mesh.first_cell_ = first_cell_;
  mesh.quality_ = quality_;
  mesh.nodes_.reserve(std::max(nodes_.size(), patches_.size()) + kChildren * count);
  mesh.nodes_ = nodes_;
  std::vector<uint32_t> leaves = leaves_;
  if (nodes_.empty())
    for (uint32_t p = 0; p < patches_.size(); ++p) {
      mesh.nodes_.push_back({.patch = p});
      leaves.push_back(p);
    }
  mesh.patches_.reserve(patches_.size() + (kChildren - 1) * count);
  mesh.leaves_.reserve(mesh.patches_.capacity());
  if (parts_of) parts_of->clear();
  const auto add = [&](uint32_t node, const Patch& patch, uint32_t old) {
    mesh.nodes_[node].patch = static_cast<uint32_t>(mesh.patches_.size());
    mesh.leaves_.push_back(node);
    mesh.patches_.push_back(patch);
    if (parts_of) parts_of->push_back(old);
  };
  for (uint32_t p = 0; p < patches_.size(); ++p) {
    const Patch& patch = patches_[p];
    if (!divided[p]) {
      add(leaves[p], patch, p);
      continue;
    }
    auto child = static_cast<uint32_t>(mesh.nodes_.size());
    mesh.nodes_[leaves[p]].children = child;
    mesh.nodes_[leaves[p]].patch = kNoElement;
    mesh.nodes_.resize(mesh.nodes_.size() + kChildren, {.parent = leaves[p]});
    for_each_part(patch.p0, patch.p1 - patch.p0, patch.p2 - patch.p0, kChildSteps,
                  [&](const Vec3& p0, const Vec3& p1, const Vec3& p2) {
                    Patch part = patch;
                    part.p0 = p0;
                    part.p1 = p1;
                    part.p2 = p2;
                    part.area = patch.area / kChildren;
                    add(child++, part, p);
                  });
  }
  mesh.measure_quality();
  return mesh;
}

void PatchMesh::divide(const scene::InstanceData& instance, uint32_t index, uint32_t triangle, uint32_t steps) {
  if (steps == 0) return;
  const Facet f = scene::facet_of(instance, triangle, 0);
  const Vec3 e1 = f.p1 - f.p0, e2 = f.p2 - f.p0, normal = scene::normal_of(f);
  const auto area = static_cast<float>(area_of(f) / sqr(static_cast<double>(steps)));
  for_each_part(f.p0, e1, e2, steps, [&](const Vec3& p0, const Vec3& p1, const Vec3& p2) {
    patches_.push_back({p0, p1, p2, normal, area, scene::offset_bound(p0, e1, e2), index, triangle});
  });
}

PatchMesh::Location PatchMesh::locate(uint32_t instance, uint32_t triangle, float u, float v, bool front) const {
  const Cell cell = cells_[first_cell_[instance] + triangle];
  if (cell.steps == 0) return {};
  Part part = part_at({u, v}, cell.steps);
  uint32_t node = cell.first + part.number;
  if (!nodes_.empty()) {
    while (nodes_[node].children != kNoElement) {
      part = part_at(part.barycentric, kChildSteps);
      node = nodes_[node].children + part.number;
    }
    node = nodes_[node].patch;
  }
  return {2 * node + (front ? 0 : 1), part.barycentric};
}

uint32_t PatchMesh::element_at(const Hit& hit, const Vec3& direction) const {
  const uint32_t front = locate(hit.instance, hit.triangle, hit.u, hit.v, true).element;
  if (front == kNoElement) return front;
  return front + (glm::dot(direction, patch_of(front).normal) < 0 ? 0 : 1);
}

Vec2 PatchMesh::in_triangle(uint32_t patch, Vec2 barycentric) const {
  const Patch& p = patches_[patch];
  const Cell cell = cells_[first_cell_[p.instance] + p.triangle];
  uint32_t node = patch;
  if (!nodes_.empty())
    for (node = leaves_[patch]; nodes_[node].parent != kNoElement; node = nodes_[node].parent)
      barycentric = in_whole({node - nodes_[nodes_[node].parent].children, barycentric}, kChildSteps);
  return in_whole({node - cell.first, barycentric}, cell.steps);
}

size_t PatchMesh::memory() const {
  return patches_.capacity() * sizeof(Patch) + cells_.capacity() * sizeof(Cell) + nodes_.capacity() * sizeof(Node) +
         (first_cell_.capacity() + leaves_.capacity()) * sizeof(uint32_t);
}

}  // namespace etendue::radiosity
