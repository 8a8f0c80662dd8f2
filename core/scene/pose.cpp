#include "scene/pose.h"

#include <algorithm>
#include <set>

#include "scene/animation.h"
#include "scene/coordinate_range.h"

namespace etendue::scene {
namespace {

// Edits of single components leave quaternions that are not normalised.
Vec4 unit(const Vec4& q) {
  const float squared = glm::dot(q, q);
  const bool is_unit = std::abs(squared - 1) < 1e-5f;
  return is_unit || !(squared > 0) ? q : q / std::sqrt(squared);
}

Mat4 rotation_matrix(const Vec4& rotation) {
  const Vec4 q = unit(rotation);
  const float x = q.x, y = q.y, z = q.z, w = q.w;
  Mat4 m(1);
  m[0] = Vec4(1 - 2 * (y * y + z * z), 2 * (x * y + z * w), 2 * (x * z - y * w), 0);
  m[1] = Vec4(2 * (x * y - z * w), 1 - 2 * (x * x + z * z), 2 * (y * z + x * w), 0);
  m[2] = Vec4(2 * (x * z + y * w), 2 * (y * z - x * w), 1 - 2 * (x * x + y * y), 0);
  return m;
}

// Channels of morph weights change nothing.
void apply_channel(const AnimationChannel& channel, float time, Transform& t) {
  if (channel.path == AnimatedPath::weights) return;
  std::array<float, 4> v{};
  sample_channel(channel, time, v);
  t.matrix.reset();
  if (channel.path == AnimatedPath::translation) t.translation = Vec3(v[0], v[1], v[2]);
  if (channel.path == AnimatedPath::rotation) t.rotation = Vec4(v[0], v[1], v[2], v[3]);
  if (channel.path == AnimatedPath::scale) t.scale = Vec3(v[0], v[1], v[2]);
}

std::vector<Transform> animated_transforms(const Scene& scene, float time) {
  std::vector<Transform> transforms;
  transforms.reserve(scene.nodes.size());
  for (const Node& node : scene.nodes) transforms.push_back(node.transform);
  for_each_channel(scene, [&](const AnimationChannel& channel) {
    apply_channel(channel, time, transforms[static_cast<size_t>(channel.node)]);
  });
  return transforms;
}

std::vector<float> morph_weights(const Scene& scene, int node, float time) {
  const Node& n = scene.nodes[static_cast<size_t>(node)];
  std::vector<float> weights = n.weights;
  if (weights.empty() && n.mesh >= 0) weights = scene.meshes[static_cast<size_t>(n.mesh)].weights;
  for_each_channel(scene, [&](const AnimationChannel& channel) {
    if (channel.node != node || channel.path != AnimatedPath::weights) return;
    weights.resize(channel.components);
    sample_channel(channel, time, weights);
  });
  return weights;
}

// The nodes that a root reaches, parents before children; `only_visible` excludes hidden nodes and their descendants.
std::vector<int> reached_nodes(const Scene& scene, bool only_visible) {
  std::vector<int> order;
  std::vector<int> stack(scene.roots.rbegin(), scene.roots.rend());
  while (!stack.empty()) {
    const int node = stack.back();
    stack.pop_back();
    const Node& n = scene.nodes[static_cast<size_t>(node)];
    if (only_visible && !n.visible) continue;
    order.push_back(node);
    stack.insert(stack.end(), n.children.rbegin(), n.children.rend());
  }
  return order;
}

template <class T>
void add_weighted(std::vector<T>& values, const std::vector<Vec3>& displacements, float weight) {
  for (size_t i = 0; i < values.size() && i < displacements.size(); ++i)
    for (int c = 0; c < 3; ++c) values[i][c] += weight * displacements[i][c];
}

void morph(Mesh& mesh, const Deformation& d, const std::vector<float>& weights) {
  for (size_t t = 0; t < d.targets.size() && t < weights.size(); ++t) {
    if (weights[t] == 0) continue;
    add_weighted(mesh.positions, d.targets[t].positions, weights[t]);
    add_weighted(mesh.normals, d.targets[t].normals, weights[t]);
    add_weighted(mesh.tangents, d.targets[t].tangents, weights[t]);
  }
  for (Vec3& n : mesh.normals) n = normalize_or(n, Vec3(0, 1, 0));
}

void skin_mesh(Mesh& mesh, const Deformation& d, const Skin& skin, const std::vector<Mat4>& world) {
  std::vector<Mat4> joints;
  for (size_t j = 0; j < skin.joints.size(); ++j)
    joints.push_back(world[static_cast<size_t>(skin.joints[j])] * skin.inverse_bind[j]);
  const size_t n = mesh.positions.size();
  for (size_t i = 0; i < n; ++i) {
    Mat4 m(0);
    float total = 0;
    for (size_t set = 0; set < d.joint_sets; ++set)
      for (size_t k = 0; k < 4; ++k) {
        const float w = d.weights[set * n + i][static_cast<int>(k)];
        const size_t joint = d.joints[set * n + i][k];
        if (w == 0 || joint >= joints.size()) continue;
        m += joints[joint] * w;
        total += w;
      }
    if (!(total > 0)) continue;
    m /= total;
    mesh.positions[i] = Vec3(m * Vec4(mesh.positions[i], 1));
    if (!mesh.normals.empty()) {
      const Mat3 linear(m);
      const bool invertible = std::abs(glm::determinant(linear)) > 0;
      mesh.normals[i] =
          normalize_or((invertible ? glm::transpose(glm::inverse(linear)) : linear) * mesh.normals[i], mesh.normals[i]);
    }
    if (!mesh.tangents.empty()) mesh.tangents[i] = Vec4(Mat3(m) * Vec3(mesh.tangents[i]), mesh.tangents[i].w);
  }
}

bool all_within_range(const Mesh& mesh, const Mat4& to_world) {
  return std::ranges::all_of(mesh.positions,
                             [&](const Vec3& p) { return is_within_range(Vec3(to_world * Vec4(p, 1))); });
}

std::string joined_names(const std::vector<Camera>& cameras) {
  std::string names;
  for (size_t i = 0; i < cameras.size(); ++i)
    names += (i ? ", " : "") + std::to_string(i) + " '" + cameras[i].name + "'";
  return names;
}

}  // namespace

Mat4 Transform::to_matrix() const {
  if (matrix) return *matrix;
  Mat4 m = rotation_matrix(rotation);
  for (int c = 0; c < 3; ++c) m[c] *= scale[c];
  m[3] = Vec4(translation, 1);
  return m;
}

bool is_singular(const Mat4& m) {
  const glm::dvec3 a(m[0]), b(m[1]), c(m[2]);
  const double volume = std::abs(glm::dot(glm::cross(a, b), c));
  // Relative to the lengths of the columns, so that a small scale is not mistaken for a flat one.
  if (!(volume > 1e-9 * glm::length(a) * glm::length(b) * glm::length(c)) || !(volume > 1e-36)) return true;
  // Embree transforms rays into the space of the mesh. Their coordinates must stay below 1e18.
  constexpr double kMaxInverse = 1e8;
  const glm::dmat3 inverse = glm::inverse(glm::dmat3(a, b, c));
  for (int column = 0; column < 3; ++column)
    for (int row = 0; row < 3; ++row)
      if (!(std::abs(inverse[column][row]) <= kMaxInverse)) return true;
  return false;
}

std::vector<size_t> playing_animations(const Scene& scene) {
  if (scene.clip >= 0 && static_cast<size_t>(scene.clip) < scene.animations.size())
    return {static_cast<size_t>(scene.clip)};
  std::vector<size_t> playing;
  std::set<std::pair<int, AnimatedPath>> animated;
  for (size_t i = 0; i < scene.animations.size(); ++i) {
    const auto& channels = scene.animations[i]->channels;
    const bool conflicts = std::any_of(channels.begin(), channels.end(), [&](const auto& c) {
      return animated.contains({c.node, c.path});
    });
    if (conflicts) continue;
    for (const auto& c : channels) animated.insert({c.node, c.path});
    playing.push_back(i);
  }
  return playing;
}

bool has_animated_transform(const Scene& scene, int node) {
  bool is_animated = false;
  for_each_channel(scene,
                   [&](const AnimationChannel& channel) { is_animated |= is_transform_channel(channel, node); });
  return is_animated;
}

Transform posed_transform(const Scene& scene, int node) {
  Transform posed = scene.nodes[static_cast<size_t>(node)].transform;
  for_each_channel(scene, [&](const AnimationChannel& channel) {
    if (channel.node == node) apply_channel(channel, scene.time, posed);
  });
  return posed;
}

std::vector<Mat4> world_matrices(const Scene& scene) { return world_matrices(scene, scene.time); }

namespace {

// A matrix that maps all points to the origin.
Mat4 collapsed() {
  Mat4 m(0);
  m[3][3] = 1;
  return m;
}

// Calls out_of_range(node) for each node whose matrix is out of range; its matrix is collapsed.
template <class OutOfRange>
std::vector<Mat4> checked_world_matrices(const Scene& scene, float time, OutOfRange&& out_of_range) {
  const auto transforms = animated_transforms(scene, time);
  std::vector<Mat4> world(scene.nodes.size(), Mat4(1));
  std::vector<bool> is_root(scene.nodes.size(), false);
  for (const int root : scene.roots) is_root[static_cast<size_t>(root)] = true;
  for (const int node : reached_nodes(scene, false)) {
    const auto i = static_cast<size_t>(node);
    const int parent = is_root[i] ? -1 : scene.nodes[i].parent;
    world[i] = (parent < 0 ? Mat4(1) : world[static_cast<size_t>(parent)]) * transforms[i].to_matrix();
    if (is_within_range(world[i])) continue;
    world[i] = collapsed();
    out_of_range(node);
  }
  return world;
}

}  // namespace

std::vector<Mat4> world_matrices(const Scene& scene, float time) {
  return checked_world_matrices(scene, time, [](int) {});
}

std::vector<int> nodes_out_of_range(const Scene& scene) {
  std::vector<int> nodes;
  checked_world_matrices(scene, scene.time, [&](int node) { nodes.push_back(node); });
  return nodes;
}

bool is_skinned(const Scene& scene, int node, const Primitive& primitive) {
  return primitive.deformation && scene.nodes[static_cast<size_t>(node)].skin >= 0 &&
         primitive.deformation->joint_sets > 0;
}

std::shared_ptr<Mesh> deformed_mesh(const Scene& scene, int node, const Primitive& primitive,
                                    const std::vector<Mat4>& world, float time) {
  auto mesh = std::make_shared<Mesh>(*primitive.mesh);
  mesh->positions.reserve(mesh->positions.size() + 1);
  morph(*mesh, *primitive.deformation, morph_weights(scene, node, time));
  const auto skin = static_cast<size_t>(scene.nodes[static_cast<size_t>(node)].skin);
  if (is_skinned(scene, node, primitive)) skin_mesh(*mesh, *primitive.deformation, *scene.skins[skin], world);
  return mesh;
}

PosedMesh posed_mesh(const Scene& scene, int node, const Primitive& primitive, const std::vector<Mat4>& world) {
  static const auto kEmpty = std::make_shared<const Mesh>();
  const bool skinned = is_skinned(scene, node, primitive);
  const Mat4& to_world = world[static_cast<size_t>(node)];
  if (!skinned && is_singular(to_world)) return {kEmpty, false};
  if (!primitive.deformation) return {primitive.mesh, false};
  auto mesh = deformed_mesh(scene, node, primitive, world, scene.time);
  if (!all_within_range(*mesh, skinned ? Mat4(1) : to_world)) return {kEmpty, false};
  return {std::move(mesh), skinned};
}

std::shared_ptr<const Mesh> in_world(const std::shared_ptr<const Mesh>& mesh, const Mat4& to_world) {
  if (to_world == Mat4(1)) return mesh;
  auto moved = std::make_shared<Mesh>(*mesh);
  const Mat3 linear(to_world), normals = glm::transpose(glm::inverse(linear));
  moved->positions.reserve(mesh->positions.size() + 1);
  for (auto& p : moved->positions) p = Vec3(to_world * Vec4(p, 1));
  for (auto& n : moved->normals) n = normalize_or(normals * n, n);
  for (auto& t : moved->tangents) t = Vec4(linear * Vec3(t), t.w);
  return moved;
}

Mat4 camera_to_world(const Mat4& m) {
  const Vec3 back = normalize_or(Vec3(m[2]), Vec3(0, 0, 1));
  const Vec3 right = normalize_or(glm::cross(Vec3(m[1]), back), Vec3(1, 0, 0));
  return Mat4(Vec4(right, 0), Vec4(glm::cross(back, right), 0), Vec4(back, 0), Vec4(Vec3(m[3]), 1));
}

namespace {

// Calls visit(node, camera) for each camera with its position at the scene's time, in their order.
template <class Visit>
void for_each_camera(const Scene& scene, Visit&& visit) {
  const auto world = world_matrices(scene);
  for (const int node : reached_nodes(scene, false)) {
    const Node& n = scene.nodes[static_cast<size_t>(node)];
    if (n.camera < 0) continue;
    Camera camera = scene.cameras[static_cast<size_t>(n.camera)];
    camera.to_world = camera_to_world(world[static_cast<size_t>(node)]);
    if (camera.name.empty()) camera.name = n.name;
    visit(node, camera);
  }
}

}  // namespace

std::vector<Camera> placed_cameras(const Scene& scene) {
  std::vector<Camera> cameras;
  for_each_camera(scene, [&](int, const Camera& camera) { cameras.push_back(camera); });
  return cameras;
}

int node_of_camera(const Scene& scene, const Camera& camera) {
  int result = -1;
  for_each_camera(scene, [&](int node, const Camera& placed) {
    if (result < 0 && placed.name == camera.name && placed.to_world == camera.to_world) result = node;
  });
  return result;
}

Bounds world_bounds(const Scene& scene) {
  Bounds bounds;
  const auto world = world_matrices(scene);
  for (const int node : reached_nodes(scene, true)) {
    const Node& n = scene.nodes[static_cast<size_t>(node)];
    if (n.mesh < 0) continue;
    for (const Primitive& primitive : scene.meshes[static_cast<size_t>(n.mesh)].primitives) {
      const PosedMesh posed = posed_mesh(scene, node, primitive, world);
      bounds.extend(bounds_of(*posed.mesh, posed.in_world ? Mat4(1) : world[static_cast<size_t>(node)]));
    }
  }
  return bounds;
}

Camera framing_camera(const Bounds& bounds) {
  constexpr float kFov = 0.7f;
  const Vec3 center = bounds.empty() ? Vec3(0) : bounds.center();
  // At least so large that the rounded position of the camera differs from the centre, however far away that is.
  const float radius = std::max({bounds.radius(), 1e-6f, 1e-5f * glm::length(center)});
  Camera camera = look_at(center + glm::normalize(Vec3(0.4f, 0.35f, 1)) * (1.05f * radius / std::sin(kFov / 2)), center,
                          Vec3(0, 1, 0), kFov);
  camera.name = "framing";
  return camera;
}

Result<Camera> choose_camera(const Scene& scene, const std::string& which) {
  const auto cameras = placed_cameras(scene);
  if (which.empty()) return cameras.empty() ? framing_camera(world_bounds(scene)) : cameras.front();
  for (const auto& camera : cameras)
    if (camera.name == which) return camera;
  if (which.find_first_not_of("0123456789") == std::string::npos && which.size() < 9) {
    const auto index = static_cast<size_t>(std::stoul(which));
    if (index < cameras.size()) return cameras[index];
  }
  return usage_error("there is no camera '" + which + "'; " +
                     (cameras.empty() ? "the scene has no cameras" : "the scene has " + joined_names(cameras)));
}

}  // namespace etendue::scene
