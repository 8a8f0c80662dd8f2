// The scene that a user edits: a plain value.
//
// Copying it is cheap (the heavy arrays are shared and immutable), so an edit is a new Scene, undo is an old one, and
// `compile` finds out what changed by comparing the two.
#pragma once
#include <array>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "base/vec.h"
#include "camera/camera.h"
#include "geometry/mesh.h"
#include "light/light.h"
#include "material/material.h"

namespace etendue::scene {

// What deforms a mesh: morph targets (displacements per vertex) and the weights of skin joints.
struct MorphTarget {
  std::vector<Vec3> positions, normals, tangents;  // empty or one per vertex
};

struct Deformation {
  std::vector<MorphTarget> targets;
  std::vector<std::array<uint16_t, 4>> joints;  // one set of four per vertex and per entry of joint_sets
  std::vector<Vec4> weights;
  size_t joint_sets = 0;  // joints holds joint_sets * vertices entries, set by set
};

struct Primitive {
  std::shared_ptr<const Mesh> mesh;
  std::shared_ptr<const Deformation> deformation;  // null for a rigid mesh
  int material = 0;                                // what it wears now
  std::vector<int> choices;  // what it wears in the file's own look and in each variant; empty if always the same

  friend bool operator==(const Primitive&, const Primitive&) = default;
};

struct MeshGroup {  // a glTF mesh
  std::string name;
  std::vector<Primitive> primitives;
  std::vector<float> weights;  // default morph weights

  friend bool operator==(const MeshGroup&, const MeshGroup&) = default;
};

// Translation, rotation (quaternion x y z w) and scale, or a matrix where the file gives one.
struct Transform {
  Vec3 translation{0};
  Vec4 rotation{0, 0, 0, 1};
  Vec3 scale{1};
  std::optional<Mat4> matrix = std::nullopt;

  Mat4 to_matrix() const;
  friend bool operator==(const Transform&, const Transform&) = default;
};

struct Node {
  std::string name;
  Transform transform;
  int parent = -1;
  std::vector<int> children;
  int mesh = -1, camera = -1, light = -1, skin = -1;  // indices into Scene, or -1
  std::vector<float> weights;                         // morph weights; empty uses the mesh's
  bool visible = true;

  friend bool operator==(const Node&, const Node&) = default;
};

struct Skin {
  std::vector<int> joints;         // nodes
  std::vector<Mat4> inverse_bind;  // one per joint

  friend bool operator==(const Skin&, const Skin&) = default;
};

enum class Interpolation : uint8_t { step, linear, cubic };
enum class AnimatedPath : uint8_t { translation, rotation, scale, weights };

struct AnimationChannel {
  int node = -1;
  AnimatedPath path = AnimatedPath::translation;
  Interpolation interpolation = Interpolation::linear;
  std::vector<float> times;   // seconds, strictly increasing
  std::vector<float> values;  // components per key; three times as many for cubic (in-tangent, value, out-tangent)
  size_t components = 3;
};

struct Animation {
  std::string name;
  std::vector<AnimationChannel> channels;
  float duration = 0;
};

struct Scene {
  std::string name;
  std::string file;  // empty for a built-in scene

  std::vector<Node> nodes;
  std::vector<int> roots;  // the nodes of the chosen glTF scene
  std::vector<MeshGroup> meshes;
  std::vector<Material> materials;  // never empty: primitives without one share a default at the end
  std::vector<Texture> textures;
  std::vector<Light> lights;
  std::vector<Camera> cameras;  // projection only; a camera's place is its node's
  std::vector<std::shared_ptr<const Skin>> skins;
  std::vector<std::shared_ptr<const Animation>> animations;
  Environment environment;
  float time = 0;                     // seconds at which animations are evaluated
  std::vector<std::string> variants;  // names
  int variant = -1;                   // the one that is shown (scene/variants.h), -1 for the file's own look

  std::vector<std::string> scene_names;  // of the file's scenes
  std::vector<std::string> unsupported;  // optional extensions that are used and ignored
  std::vector<std::string> warnings;     // what was repaired or given up, one line each
};

// A camera of the scene at its place in the world, at the scene's time.
std::vector<Camera> placed_cameras(const Scene& scene);

// World matrices of all nodes at the scene's time (animations applied); nodes that no root reaches get the identity.
std::vector<Mat4> world_matrices(const Scene& scene);

// The primitive's mesh as this node shows it at the scene's time: morphed and skinned. Returns the rest mesh itself
// where nothing deforms it. The result is in the node's space, or in world space if the node is skinned (`in_world`
// says so).
struct PosedMesh {
  std::shared_ptr<const Mesh> mesh;
  bool in_world = false;
};
PosedMesh posed_mesh(const Scene& scene, int node, const Primitive& primitive, const std::vector<Mat4>& world);

// What is in the world at the scene's time, for framing. Hidden nodes are left out.
Bounds world_bounds(const Scene& scene);

// The scene's own camera by name or index; the first, or a framing one, if `which` is empty. An unknown name is an
// error that lists the names there are.
Result<Camera> choose_camera(const Scene& scene, const std::string& which);

// A camera that shows everything from slightly above and in front.
Camera framing_camera(const Bounds& bounds);

}  // namespace etendue::scene
