#include "scene/moved_nodes.h"

#include <algorithm>

#include "scene/coordinate_range.h"
#include "scene/pose.h"

namespace etendue::scene {
namespace {

bool same_apart_from_nodes(const Scene& a, const Scene& b) {
  return a.animations.empty() && b.animations.empty() && a.skins == b.skins && a.roots == b.roots &&
         a.meshes == b.meshes && a.nodes.size() == b.nodes.size();
}

bool differs_in_transform_only(const Node& a, const Node& b) {
  Node moved = a;
  moved.transform = b.transform;
  return moved == b;
}

class MovedNodes {
 public:
  MovedNodes(const Scene& scene, size_t most) : scene_(scene), most_(most) {}

  // Adds a node with its visible descendants. Returns false if they are too many, or if one of them cannot be moved.
  bool add(uint32_t node) {
    if (!is_shown(node)) return true;
    return add(node, parent_matrix(node));
  }

  std::vector<MovedNode> take() { return std::move(moved_); }

 private:
  bool is_root(uint32_t node) const {
    return scene_.nodes[node].parent < 0 ||
           std::ranges::find(scene_.roots, static_cast<int>(node)) != scene_.roots.end();
  }

  bool is_shown(uint32_t node) const {
    while (scene_.nodes[node].visible && !is_root(node)) node = static_cast<uint32_t>(scene_.nodes[node].parent);
    return scene_.nodes[node].visible;
  }

  // The product has the order of world_matrices, so that its rounding is the same.
  Mat4 parent_matrix(uint32_t node) const {
    std::vector<uint32_t> ancestors;
    while (!is_root(node)) ancestors.push_back(node = static_cast<uint32_t>(scene_.nodes[node].parent));
    Mat4 matrix(1);
    for (size_t i = ancestors.size(); i-- > 0;) matrix = matrix * scene_.nodes[ancestors[i]].transform.to_matrix();
    return matrix;
  }

  static bool is_rigid(const MeshGroup& mesh) {
    return std::ranges::none_of(mesh.primitives, [](const Primitive& p) { return p.deformation != nullptr; });
  }

  bool add(uint32_t index, const Mat4& parent) {
    const Node& node = scene_.nodes[index];
    if (!node.visible) return true;
    const Mat4 to_world = parent * node.transform.to_matrix();
    if (moved_.size() == most_ || !is_within_range(to_world) || is_singular(to_world)) return false;
    if (node.light >= 0 || node.portal != Vec2(0)) return false;
    if (node.mesh >= 0 && !is_rigid(scene_.meshes[static_cast<size_t>(node.mesh)])) return false;
    moved_.push_back({index, to_world});
    return std::ranges::all_of(node.children, [&](int child) { return add(static_cast<uint32_t>(child), to_world); });
  }

  const Scene& scene_;
  size_t most_;
  std::vector<MovedNode> moved_;
};

}  // namespace

std::optional<std::vector<MovedNode>> moved_nodes(const Scene& now, const Scene& old, size_t most) {
  if (!same_apart_from_nodes(now, old)) return std::nullopt;
  MovedNodes moved(now, most);
  const bool complete = now.nodes.unshared_agree(old.nodes, [&](size_t i) {
    if (now.nodes[i] == old.nodes[i]) return false;
    return !differs_in_transform_only(now.nodes[i], old.nodes[i]) || !moved.add(static_cast<uint32_t>(i));
  });
  if (!complete) return std::nullopt;
  return moved.take();
}

}  // namespace etendue::scene
