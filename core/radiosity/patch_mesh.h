// Patches: the triangles of a scene, subdivided.                                  [Lang, sec. 10.1.3, eq. 10.25-10.31]
//
// A triangle is divided into k^2 congruent patches, and an adaptive mesh divides some of them into four, repeatedly. A Lambertian surface reflects on both sides, so a patch has two
// elements: element 2 p is the front side of patch p, element 2 p + 1 its back side. The radiosity equation has one
// unknown per element.
//
// Triangles without area and analytic shapes (sphere, disk and cylinder lights) have no patches. Neighbouring triangles
// can be divided differently (T-vertices), and so can those of an adaptive mesh (hanging nodes); that only affects linear
// reconstruction.
#pragma once
#include <vector>

#include "base/parameter.h"
#include "scene/compiled_scene.h"

namespace etendue::radiosity {

inline constexpr uint32_t kNoElement = 0xffffffffU;

enum class Meshing : uint8_t { area, uniform, quadtree, adaptive };

struct MeshSettings {
  Meshing meshing = Meshing::area;
  int patches = 2000;  // for Meshing::area: k is chosen such that the scene has about this many patches of similar area
  int steps = 4;       // for Meshing::uniform: k of every triangle
  // Meshing::quadtree is Meshing::area with powers of two for k, so that the patches of a triangle form a quadtree.
  // Meshing::adaptive starts with a part of the patches, of similar area; MeshRefinement divides them.
  friend bool operator==(const MeshSettings&, const MeshSettings&) = default;
};

struct Patch {
  Vec3 p0, p1, p2;  // in the order of the triangle's vertices
  Vec3 normal;      // unit, on the front side
  float area;       // m^2
  float offset;     // bound of the rounding error of points on the patch, m
  uint32_t instance, triangle;

  Vec3 point(Vec2 barycentric) const { return p0 + (p1 - p0) * barycentric.x + (p2 - p0) * barycentric.y; }
  friend bool operator==(const Patch&, const Patch&) = default;
};

struct MeshQuality {
  size_t triangles = 0;
  size_t degenerate = 0;             // triangles without area
  size_t shapes = 0;                 // analytic shapes
  double area = 0;                   // of all patches, one side, m^2
  double smallest = 0, largest = 0;  // area of a patch, m^2
  // Patches with shape quality 4 sqrt(3) area / (sum of squared edge lengths) below 0.1; 1 for an equilateral triangle.
  size_t slivers = 0;
  double longest_edge = 0;  // m
};

// The number of patches that a mesh with these settings has, at most if it is adaptive, without building it.
size_t count_patches(const scene::CompiledScene& scene, const MeshSettings& settings);

class PatchMesh {
 public:
  PatchMesh() = default;
  // For Meshing::adaptive: the mesh before it is refined.
  PatchMesh(const scene::CompiledScene& scene, const MeshSettings& settings);

  // The mesh with these patches divided into four congruent ones. `divided` is by patch. `parts_of`, which may be null,
  // receives for each new patch that of the old mesh which contains it.
  PatchMesh refined(const std::vector<char>& divided, std::vector<uint32_t>* parts_of = nullptr) const;

  const std::vector<Patch>& patches() const { return patches_; }
  size_t element_count() const { return 2 * patches_.size(); }
  const MeshQuality& quality() const { return quality_; }

  const Patch& patch_of(uint32_t element) const { return patches_[element / 2]; }
  // The normal on the side of the element.
  Vec3 normal_of(uint32_t element) const {
    return is_front(element) ? patch_of(element).normal : -patch_of(element).normal;
  }
  static bool is_front(uint32_t element) { return element % 2 == 0; }

  // A place on the mesh: the element and barycentric coordinates within its patch.
  struct Location {
    uint32_t element = kNoElement;
    Vec2 barycentric{0};
  };
  // `u` and `v` are the barycentric weights of vertices 1 and 2 of the triangle. Without element on triangles without
  // patches.
  Location locate(uint32_t instance, uint32_t triangle, float u, float v, bool front) const;
  // The element that a ray in this direction hits, or kNoElement.
  uint32_t element_at(const Hit& hit, const Vec3& direction) const;
  // Barycentric coordinates in the triangle of a point of the patch.
  Vec2 in_triangle(uint32_t patch, Vec2 barycentric) const;

  size_t memory() const;  // bytes
  // At most, while an adaptive mesh is refined: two meshes with their trees, and the orders of the patches.
  static constexpr size_t kBytesPerRefinedPatch = 2 * (sizeof(Patch) + 40) + 32;
  // Whether the patches are the same; shapes and lights may differ.
  friend bool operator==(const PatchMesh& a, const PatchMesh& b) { return a.patches_ == b.patches_; }

 private:
  struct Cell {          // of a triangle
    uint32_t first = 0;  // node
    uint32_t steps = 0;  // k; 0 if the triangle has no patches
  };
  // Of the quadtrees of an adaptive mesh. Their roots are the patches before it was refined.
  struct Node {
    uint32_t children = kNoElement;  // the first of four; none for a leaf
    uint32_t parent = kNoElement;
    uint32_t patch = kNoElement;  // of a leaf
  };
  void divide(const scene::InstanceData& instance, uint32_t index, uint32_t triangle, uint32_t steps);

  void measure_quality();

  std::vector<Patch> patches_;
  std::vector<Cell> cells_;
  std::vector<Node> nodes_;           // empty if no patch is divided: node and patch are the same then
  std::vector<uint32_t> leaves_;      // node, by patch
  std::vector<uint32_t> first_cell_;  // by instance
  MeshQuality quality_;
};

}  // namespace etendue::radiosity

template <>
struct etendue::Options<etendue::radiosity::Meshing> {
  static constexpr std::array<etendue::Option, 4> kOptions{{{"area", "Similar area"},
                                                            {"uniform", "Same for all triangles"},
                                                            {"quadtree", "Powers of two"},
                                                            {"adaptive", "Adaptive"}}};
};
