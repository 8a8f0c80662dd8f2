// Where everything is at the scene's time: node matrices, deformed meshes, cameras.
#include <functional>

#include "scene/animation.h"
#include "scene/scene.h"

namespace etendue::scene {
namespace {

Mat4 rotation_matrix(const Vec4& q) {
  const float x = q.x, y = q.y, z = q.z, w = q.w;
  Mat4 m(1);
  m[0] = Vec4(1 - 2 * (y * y + z * z), 2 * (x * y + z * w), 2 * (x * z - y * w), 0);
  m[1] = Vec4(2 * (x * y - z * w), 1 - 2 * (x * x + z * z), 2 * (y * z + x * w), 0);
  m[2] = Vec4(2 * (x * z + y * w), 2 * (y * z - x * w), 1 - 2 * (x * x + y * y), 0);
  return m;
}

// Nodes as the animations leave them.
struct Pose {
  std::vector<Transform> transforms;
  std::vector<std::vector<float>> weights;
};

Pose pose_of(const Scene& scene) {
  Pose pose;
  for (const Node& n : scene.nodes) {
    pose.transforms.push_back(n.transform);
    const bool own = !n.weights.empty() || n.mesh < 0;
    pose.weights.push_back(own ? n.weights : scene.meshes[static_cast<size_t>(n.mesh)].weights);
  }
  for (const auto& animation : scene.animations)
    for (const AnimationChannel& channel : animation->channels) {
      if (channel.node < 0 || static_cast<size_t>(channel.node) >= scene.nodes.size() || channel.times.empty()) continue;
      const auto node = static_cast<size_t>(channel.node);
      std::vector<float> v(channel.components);
      sample_channel(channel, scene.time, v);
      Transform& t = pose.transforms[node];
      switch (channel.path) {
        case AnimatedPath::translation: t.translation = Vec3(v[0], v[1], v[2]), t.matrix.reset(); break;
        case AnimatedPath::rotation: t.rotation = Vec4(v[0], v[1], v[2], v[3]), t.matrix.reset(); break;
        case AnimatedPath::scale: t.scale = Vec3(v[0], v[1], v[2]), t.matrix.reset(); break;
        case AnimatedPath::weights: pose.weights[node] = v; break;
      }
    }
  return pose;
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
}

void skin_mesh(Mesh& mesh, const Deformation& d, const Skin& skin, const std::vector<Mat4>& world) {
  std::vector<Mat4> joints;
  for (size_t j = 0; j < skin.joints.size(); ++j) joints.push_back(world[static_cast<size_t>(skin.joints[j])] * skin.inverse_bind[j]);
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
      mesh.normals[i] = normalize_or((invertible ? glm::transpose(glm::inverse(linear)) : linear) * mesh.normals[i], mesh.normals[i]);
    }
    if (!mesh.tangents.empty()) mesh.tangents[i] = Vec4(Mat3(m) * Vec3(mesh.tangents[i]), mesh.tangents[i].w);
  }
}

std::string joined_names(const std::vector<Camera>& cameras) {
  std::string names;
  for (size_t i = 0; i < cameras.size(); ++i) names += (i ? ", " : "") + std::to_string(i) + " '" + cameras[i].name + "'";
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

std::vector<Mat4> world_matrices(const Scene& scene) {
  const Pose pose = pose_of(scene);
  std::vector<Mat4> world(scene.nodes.size(), Mat4(1));
  std::vector<std::pair<int, Mat4>> stack;
  for (const int root : scene.roots) stack.emplace_back(root, Mat4(1));
  while (!stack.empty()) {
    const auto [node, parent] = stack.back();
    stack.pop_back();
    const auto i = static_cast<size_t>(node);
    world[i] = parent * pose.transforms[i].to_matrix();
    for (const int child : scene.nodes[i].children) stack.emplace_back(child, world[i]);
  }
  return world;
}

PosedMesh posed_mesh(const Scene& scene, int node, const Primitive& primitive, const std::vector<Mat4>& world) {
  if (!primitive.deformation) return {primitive.mesh, false};
  const Node& n = scene.nodes[static_cast<size_t>(node)];
  auto mesh = std::make_shared<Mesh>(*primitive.mesh);
  mesh->positions.reserve(mesh->positions.size() + 1);
  morph(*mesh, *primitive.deformation, pose_of(scene).weights[static_cast<size_t>(node)]);
  const bool skinned = n.skin >= 0 && primitive.deformation->joint_sets > 0;
  if (skinned) skin_mesh(*mesh, *primitive.deformation, *scene.skins[static_cast<size_t>(n.skin)], world);
  return {std::move(mesh), skinned};
}

std::vector<Camera> placed_cameras(const Scene& scene) {
  std::vector<Camera> cameras;
  const auto world = world_matrices(scene);
  for (size_t i = 0; i < scene.nodes.size(); ++i) {
    const Node& n = scene.nodes[i];
    if (n.camera < 0) continue;
    Camera camera = scene.cameras[static_cast<size_t>(n.camera)];
    const Mat4& m = world[i];
    // Scale does not belong to a camera.
    const Vec3 back = normalize_or(Vec3(m[2]), Vec3(0, 0, 1));
    const Vec3 right = normalize_or(glm::cross(Vec3(m[1]), back), Vec3(1, 0, 0));
    camera.to_world = Mat4(Vec4(right, 0), Vec4(glm::cross(back, right), 0), Vec4(back, 0), Vec4(Vec3(m[3]), 1));
    if (camera.name.empty()) camera.name = n.name;
    cameras.push_back(camera);
  }
  return cameras;
}

Bounds world_bounds(const Scene& scene) {
  Bounds bounds;
  const auto world = world_matrices(scene);
  const std::function<void(int)> visit = [&](int node) {
    const Node& n = scene.nodes[static_cast<size_t>(node)];
    if (!n.visible) return;
    if (n.mesh >= 0)
      for (const auto& primitive : scene.meshes[static_cast<size_t>(n.mesh)].primitives) {
        const PosedMesh posed = posed_mesh(scene, node, primitive, world);
        bounds.extend(bounds_of(*posed.mesh, posed.in_world ? Mat4(1) : world[static_cast<size_t>(node)]));
      }
    for (const int child : n.children) visit(child);
  };
  for (const int root : scene.roots) visit(root);
  return bounds;
}

Camera framing_camera(const Bounds& bounds) {
  constexpr float kFov = 0.7f;
  const float radius = std::max(bounds.radius(), 1e-6f);
  const Vec3 center = bounds.empty() ? Vec3(0) : bounds.center();
  Camera camera = look_at(center + glm::normalize(Vec3(0.4f, 0.35f, 1)) * (1.05f * radius / std::sin(kFov / 2)), center, Vec3(0, 1, 0), kFov);
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
                     (cameras.empty() ? "the scene has none" : "there are " + joined_names(cameras)));
}

}  // namespace etendue::scene
