// Hierarchical radiosity: form factors between groups of patches instead of single ones.        [Hanrahan et al. 1991]
//
// Every triangle side is the root of a quadtree whose leaves are the elements of a mesh (Meshing::quadtree). Two nodes
// are linked if the form factor between them, which bounds the error of a link, is below a threshold; otherwise the one
// that appears larger is divided. Light is gathered over the links at all levels, pushed down to the leaves, reflected,
// and pulled up again as area-weighted means:
//
//   H_p  =  sum over links (p, q) of  F_pq B_q  +  H of the parent of p
//
// The irradiance of an element is divided by the sum of its form factors if no ray of a few leaves the scene, so that
// closed rooms lose no light, and if the sum exceeds 1.
//
// With k roots there are about k^2 links at the roots, and a number of further links in proportion to the number of
// elements, where a dense matrix has its square.
#pragma once
#include <array>
#include <optional>
#include <vector>

#include "base/warp.h"
#include "radiosity/closed_forms.h"
#include "radiosity/irradiance_field.h"
#include "radiosity/keep_going.h"
#include "radiosity/patch_mesh.h"

namespace etendue::radiosity {

struct HierarchySettings {
  double error = 0.02;  // largest form factor of a link between nodes that can be divided
  // The same for nodes that see each other partly, relative to `error`: shadows need finer links.
  double partly_visible = 0.25;
  int rays = 8;           // of the visibility of a link
  int closure_rays = 16;  // of an element, which find out whether light can leave the scene
  uint64_t seed = 0;
};

class Hierarchy {
 public:
  // The roots of a mesh with Meshing::quadtree. The links are not made yet.
  Hierarchy(const PatchMesh& mesh, const HierarchySettings& settings);

  // The tasks that make the links, in any order and in parallel. The number of rays; nothing if it was stopped.
  int tasks() const { return static_cast<int>(roots_.size()); }
  std::optional<uint64_t> run(const scene::CompiledScene& scene, int task, const KeepGoing* keep_going);
  // After all tasks.
  void finish();

  size_t nodes() const { return nodes_.size(); }
  size_t roots() const { return roots_.size(); }
  size_t links() const { return link_count_; }
  size_t memory() const;
  // The sum of the form factors of every element: over its links and those of the nodes above it.
  const std::vector<double>& closures() const { return closures_; }

  // The irradiance of every element from the radiosity of all elements.
  std::vector<Rgb> gather(const std::vector<Rgb>& radiosity) const;

 private:
  struct Node {
    Vec3 p0, p1, p2;  // in the order of the triangle's vertices
    float area;
    uint32_t parent, first_child;  // kNoElement: none; four children
    uint32_t element;              // of a leaf; of a node with children, one below it
  };
  struct Link {
    uint32_t to;
    float exchange;  // area times form factor
  };
  // The links that a task finds: from a node of its root to a node of a later one, and back.
  struct FoundLink {
    uint32_t from, to;
    float exchange;
  };
  struct LinkSearch;

  void divide(const PatchMesh& mesh, uint32_t node, uint32_t steps, uint32_t instance, uint32_t triangle, bool front,
              const std::array<Vec2, 3>& barycentric);
  bool refine(LinkSearch& search, uint32_t p, uint32_t q) const;
  double visibility(LinkSearch& search, uint32_t p, uint32_t q) const;
  double exchange(uint32_t p, uint32_t q, double to_q, double to_p) const;
  Polygon polygon_of_node(uint32_t node) const;
  void find_closed(LinkSearch& search, uint32_t node);
  std::vector<Rgb> gather_unscaled(const std::vector<Rgb>& radiosity) const;
  // A point of a node from uniform numbers.
  static Vec3 point_of(const Node& n, Vec2 u) {
    const Vec2 b = square_to_triangle(u);
    return n.p0 + (n.p1 - n.p0) * b.x + (n.p2 - n.p0) * b.y;
  }
  Vec3 normal_of(uint32_t node) const { return mesh_.normal_of(nodes_[node].element); }
  bool sees(uint32_t p, uint32_t q) const;

  const PatchMesh& mesh_;
  HierarchySettings settings_;
  std::vector<Node> nodes_;
  std::vector<uint32_t> roots_;
  std::vector<std::vector<FoundLink>> found_;  // by task
  std::vector<char> closed_;                   // by element: no ray has left the scene
  std::vector<double> closures_;               // by element
  std::vector<size_t> starts_;                 // by node, into links_
  std::vector<Link> links_;
  size_t link_count_ = 0;
};

// The Jacobi iteration with hierarchical form factors, from `direct` irradiance by element and `reflectance` by patch.
IrradianceField solve_hierarchically(const Hierarchy& hierarchy, const std::vector<Rgb>& reflectance,
                                     const std::vector<Rgb>& direct, const SolverSettings& settings);

}  // namespace etendue::radiosity
