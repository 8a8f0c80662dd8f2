// The scene that a user edits: a plain value.
//
// Copies are cheap because large arrays are shared and immutable, and nodes are shared in blocks. An edit makes a new Scene, undo restores an old
// one, and `compile` finds the changes by comparing the two.
#pragma once
#include <array>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "base/shared_array.h"
#include "base/vec.h"
#include "camera/camera.h"
#include "geometry/mesh.h"
#include "light/light.h"
#include "material/material.h"
#include "medium/medium.h"

namespace etendue::scene {

// Displacements of vertices; one weight scales all of them.
struct MorphTarget {
  std::vector<Vec3> positions, normals, tangents;  // empty or one per vertex
};

// How a mesh deforms: morph targets and joint weights.
struct Deformation {
  std::vector<MorphTarget> targets;
  std::vector<std::array<uint16_t, 4>> joints;  // indices into Skin::joints, four per vertex and set
  std::vector<Vec4> weights;                    // one per entry of `joints`
  size_t joint_sets = 0;  // `joints` and `weights` hold joint_sets * vertices entries, one set after the other
};

struct Primitive {
  std::shared_ptr<const Mesh> mesh;
  std::shared_ptr<const Deformation> deformation;  // null for a rigid mesh
  int material = 0;                                // the current one
  // The material without a variant, then the material in each variant; empty if all are the same.
  std::vector<int> choices;

  friend bool operator==(const Primitive&, const Primitive&) = default;
};

struct MeshGroup {  // a glTF mesh
  std::string name;
  std::vector<Primitive> primitives;
  std::vector<float> weights;  // default morph weights

  friend bool operator==(const MeshGroup&, const MeshGroup&) = default;
};

// Translation (metres), rotation (quaternion x y z w) and scale, or a matrix that replaces all three.
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
  Vec2 portal{0};  // width along x and height along y of an environment portal that faces -z, m; 0 for none

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
  std::vector<float> values;  // `components` per key; for cubic three times as many: in-tangent, value, out-tangent
  size_t components = 3;      // 3, 4 for rotations, the number of targets for weights
};

struct Animation {
  std::string name;
  std::vector<AnimationChannel> channels;
  float duration = 0;
};

// The medium around all solids, in a sphere about the centre of the scene's bounds. Outside of the sphere is a vacuum.
// Light from infinity passes an unbounded medium only in colours that it does not attenuate.
struct Atmosphere {
  MediumDescription medium;
  float radius = kInfinity;  // metres

  friend bool operator==(const Atmosphere&, const Atmosphere&) = default;
};

struct Scene {
  std::string name;
  std::string file;  // path; empty for a built-in scene

  SharedArray<Node> nodes;
  std::vector<int> roots;  // of the chosen glTF scene
  std::vector<MeshGroup> meshes;
  std::vector<Material> materials;  // never empty: the last one is the default of primitives without a material
  std::vector<int> removed_materials;  // by edits; they stay in `materials` and no object uses them
  std::vector<Texture> textures;
  std::vector<Light> lights;
  std::vector<Camera> cameras;  // without to_world, which is that of the node
  std::vector<std::shared_ptr<const Skin>> skins;
  std::vector<std::shared_ptr<const Animation>> animations;
  Environment environment;
  Atmosphere atmosphere;
  float time = 0;                     // of animations, seconds
  int clip = -1;                      // the animation that plays; -1: all that move different nodes
  std::vector<std::string> variants;  // names
  int variant = -1;                   // the selected one (scene/variants.h); -1 is none

  std::vector<std::string> scene_names;  // of all scenes of the file
  std::vector<std::string> unsupported;  // extensions that the file uses and that are ignored
  std::vector<std::string> warnings;     // what was repaired or ignored, one line each
};

// Whether the atmosphere or a material of the scene scatters or emits light between surfaces, or has a density that
// varies.
bool has_scattering_media(const Scene& scene);

// All cameras of the scene with their positions in the world at the scene's time.
std::vector<Camera> placed_cameras(const Scene& scene);

// World matrices of all nodes at the scene's time, with animations applied. Nodes that no root reaches have the
// identity. A matrix that is out of range (scene/coordinate_range.h) is replaced by one that maps all points to the
// origin, which is_singular recognises.
std::vector<Mat4> world_matrices(const Scene& scene);

// The mesh of a primitive at the scene's time, morphed and skinned; a rigid primitive returns its own mesh. The result
// is in the space of the node, or in world space if the node is skinned (`in_world`). It has no triangles if the world
// matrix is singular or the deformed mesh is out of range.
struct PosedMesh {
  std::shared_ptr<const Mesh> mesh;
  bool in_world = false;
};
PosedMesh posed_mesh(const Scene& scene, int node, const Primitive& primitive, const std::vector<Mat4>& world);

// The bounding box of all visible meshes in the world at the scene's time.
Bounds world_bounds(const Scene& scene);

// A camera of the scene by name or index. If `which` is empty: the first camera, or a framing camera if there is none.
// The error for an unknown name lists all cameras.
Result<Camera> choose_camera(const Scene& scene, const std::string& which);

// A camera that shows the whole box from the front and slightly above.
Camera framing_camera(const Bounds& bounds);

}  // namespace etendue::scene
