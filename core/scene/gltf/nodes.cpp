// Nodes, cameras and lights.                                    glTF 2.0, sections 3.5 and 3.10; KHR_lights_punctual
#include <algorithm>
#include <limits>

#include "scene/gltf/import.h"
#include "scene/pose.h"

namespace etendue::scene::gltf {
namespace {

constexpr double kNearlyOne = 1e-6;

Vec3 vec3_of(const std::vector<double>& v) {
  return {static_cast<float>(v[0]), static_cast<float>(v[1]), static_cast<float>(v[2])};
}

std::vector<float> floats_of(const std::vector<double>& v) {
  std::vector<float> floats;
  for (const double x : v) floats.push_back(static_cast<float>(x));
  return floats;
}

class NodeImporter {
 public:
  NodeImporter(const Document& document, Scene& scene) : document_(document), scene_(scene) {}

  void run(int wanted_scene) {
    for (size_t i = 0; i < document_.model.nodes.size(); ++i)
      scene_.nodes.push_back(import(document_.model.nodes[i], at("nodes", i)));
    for (size_t i = 0; i < scene_.nodes.size(); ++i)
      for (const int child : scene_.nodes[i].children)
        scene_.nodes[static_cast<size_t>(child)].parent = static_cast<int>(i);
    choose_roots(wanted_scene);
  }

 private:
  void warn(const std::string& where, const std::string& what) { scene_.warnings.push_back(where + ": " + what); }

  Node import(const tinygltf::Node& from, const std::string& where) {
    Node node;
    node.name = from.name;
    node.transform = transform(from, where);
    node.children = from.children;
    node.mesh = from.mesh, node.camera = from.camera, node.skin = from.skin;
    node.weights = floats_of(from.weights);
    if (node.skin >= 0 && node.mesh < 0) {
      warn(where, "has a skin but no mesh; the skin is ignored");
      node.skin = -1;
    }
    if (const auto* extension = extension_of(from.extensions, "KHR_lights_punctual"))
      node.light = static_cast<int>(checked_index(index_of(*extension, "light", -1), document_.model.lights.size(),
                                                  where + ".extensions.KHR_lights_punctual.light", "lights"));
    if (const auto* extension = extension_of(from.extensions, "KHR_node_visibility"))
      if (extension->Get("visible").IsBool()) node.visible = extension->Get("visible").Get<bool>();
    const bool shows = node.mesh >= 0 && node.skin < 0;
    if (shows && is_singular(node.transform.to_matrix()))
      warn(where, "its transform is singular (a scale of 0?); its mesh is not shown");
    return node;
  }

  Transform transform(const tinygltf::Node& from, const std::string& where) {
    Transform t;
    if (!from.matrix.empty()) {
      Mat4 m;
      for (int i = 0; i < 16; ++i) m[i / 4][i % 4] = static_cast<float>(from.matrix[static_cast<size_t>(i)]);
      if (m[0][3] != 0 || m[1][3] != 0 || m[2][3] != 0 || m[3][3] != 1) {
        warn(where + ".matrix", "its last row has to be 0 0 0 1; it is taken as that");
        m[0][3] = m[1][3] = m[2][3] = 0, m[3][3] = 1;
      }
      t.matrix = m;
    }
    if (!from.translation.empty()) t.translation = vec3_of(from.translation);
    if (from.scale.size() == 2) fail(where + ".scale", "has 2 numbers; 3 are needed");
    if (!from.scale.empty()) t.scale = vec3_of(from.scale);
    if (!from.rotation.empty()) t.rotation = rotation(from.rotation, where);
    return t;
  }

  Vec4 rotation(const std::vector<double>& q, const std::string& where) {
    const glm::dvec4 wide(q[0], q[1], q[2], q[3]);
    const double length = glm::length(wide);
    if (!(length > 0) || !std::isfinite(length)) {
      warn(where + ".rotation", "is no quaternion that can be made a unit; no rotation is used");
      return Vec4(0, 0, 0, 1);
    }
    if (std::abs(length - 1) > 1e-2) warn(where + ".rotation", "is no unit quaternion; it was normalised");
    // What rounding alone keeps from being a unit stays as the file has it.
    return Vec4(std::abs(length - 1) <= kNearlyOne ? wide : wide / length);
  }

  void choose_roots(int wanted) {
    const auto& scenes = document_.model.scenes;
    for (size_t s = 0; s < scenes.size(); ++s)
      scene_.scene_names.push_back(scenes[s].name.empty() ? "scene " + std::to_string(s) : scenes[s].name);
    if (wanted >= 0 && static_cast<size_t>(wanted) >= scenes.size())
      throw Unusable{"there is no scene " + std::to_string(wanted) + "; the file has " + std::to_string(scenes.size())};
    if (scenes.empty()) {
      if (!scene_.nodes.empty()) scene_.warnings.emplace_back("the file has no scenes; all its nodes are shown");
      for (size_t i = 0; i < scene_.nodes.size(); ++i)
        if (scene_.nodes[i].parent < 0) scene_.roots.push_back(static_cast<int>(i));
      return;
    }
    const auto chosen = static_cast<size_t>(wanted >= 0 ? wanted : std::max(document_.model.defaultScene, 0));
    if (!scenes[chosen].name.empty()) scene_.name = scenes[chosen].name;
    std::vector<bool> listed(scene_.nodes.size(), false);
    for (const int root : scenes[chosen].nodes) {
      const auto i = static_cast<size_t>(root);
      const std::string where = at("scenes", chosen) + ".nodes";
      if (scene_.nodes[i].parent >= 0)
        warn(where, "nodes[" + std::to_string(root) + "] is no root; it is shown without its parent");
      if (listed[i]) warn(where, "nodes[" + std::to_string(root) + "] is listed twice; it is shown once");
      if (!listed[i]) scene_.roots.push_back(root);
      listed[i] = true;
    }
    drop_nested_roots();
  }

  // A root below another root would be shown twice.
  void drop_nested_roots() {
    std::vector<bool> below(scene_.nodes.size(), false);
    std::vector<int> stack;
    for (const int root : scene_.roots) {
      const auto& children = scene_.nodes[static_cast<size_t>(root)].children;
      stack.insert(stack.end(), children.begin(), children.end());
    }
    while (!stack.empty()) {
      const auto i = static_cast<size_t>(stack.back());
      stack.pop_back();
      if (below[i]) continue;
      below[i] = true;
      stack.insert(stack.end(), scene_.nodes[i].children.begin(), scene_.nodes[i].children.end());
    }
    std::erase_if(scene_.roots, [&](int root) { return below[static_cast<size_t>(root)]; });
  }

  const Document& document_;
  Scene& scene_;
};

Camera import_camera(const tinygltf::Camera& from, const std::string& where, std::vector<std::string>& warnings) {
  Camera camera;
  camera.name = from.name;
  double near = 0, far = 0, aspect = 0;
  if (from.type == "orthographic") {
    const auto& o = from.orthographic;
    camera.projection = Projection::orthographic;
    near = o.znear, far = o.zfar;
    camera.ymag = std::abs(static_cast<float>(o.ymag));
    if (o.ymag != 0) aspect = std::abs(o.xmag / o.ymag);
    if (!(camera.ymag > 0)) {
      warnings.push_back(where + ": its ymag is 0; 1 is used");
      camera.ymag = 1;
    }
  } else {
    const auto& p = from.perspective;
    near = p.znear, far = p.zfar, aspect = p.aspectRatio;
    camera.yfov = static_cast<float>(p.yfov);
    if (!(camera.yfov > 0 && camera.yfov < kPi)) {
      warnings.push_back(where + ": its yfov is not between 0 and pi; 0.8 is used");
      camera.yfov = 0.8f;
    }
  }
  constexpr double kWidest = 1000;
  if (aspect >= 1 / kWidest && aspect <= kWidest) camera.aspect = static_cast<float>(aspect);
  // The least and the greatest numbers that there are stand for no plane where one has to be given.
  if (static_cast<float>(near) > std::numeric_limits<float>::min()) camera.near_clip = static_cast<float>(near);
  // A far plane of 0 is none: the projection is infinite.
  if (far > 0 && static_cast<float>(far) < std::numeric_limits<float>::max()) camera.far_clip = static_cast<float>(far);
  if (!(camera.far_clip > camera.near_clip)) {
    warnings.push_back(where + ": its zfar is not beyond its znear; both are ignored");
    camera.near_clip = 0, camera.far_clip = kInfinity;
  }
  return camera;
}

Light import_light(const tinygltf::Light& from, const std::string& where, std::vector<std::string>& warnings) {
  const LightTypeInfo* type = find_light_type(from.type);
  if (!type || !type->description.punctual)
    fail(where + ".type", "'" + from.type.substr(0, 40) + "' is none of point, spot and directional");
  Light light = make_light(from.type);
  light.name = from.name;
  if (from.color.size() == 3)
    for (int c = 0; c < 3; ++c) light.color[c] = std::max(0.0f, static_cast<float>(from.color[static_cast<size_t>(c)]));
  light.set("intensity", double{std::max(0.0f, static_cast<float>(from.intensity))});
  if (from.range > 0) light.set("range", from.range);
  if (!light.parameter("outer-cone")) return light;
  const auto inner = static_cast<float>(from.spot.innerConeAngle);
  const auto outer = static_cast<float>(from.spot.outerConeAngle);
  const float outer_cone = std::clamp(outer, 1e-3f, kPi / 2);
  const float inner_cone = std::clamp(inner, 0.0f, outer_cone);
  light.set("outer-cone", double{outer_cone});
  light.set("inner-cone", double{inner_cone});
  constexpr float kRounding = 1e-4f;
  if (std::abs(outer_cone - outer) > kRounding || std::abs(inner_cone - inner) > kRounding)
    warnings.push_back(where + ": its cones have to satisfy 0 <= inner < outer <= pi/2; they were limited to that");
  return light;
}

}  // namespace

void import_cameras(const Document& document, Scene& scene) {
  for (size_t i = 0; i < document.model.cameras.size(); ++i) {
    scene.cameras.push_back(import_camera(document.model.cameras[i], at("cameras", i), scene.warnings));
    import_lens(document.model.cameras[i].extensions, at("cameras", i), scene.cameras.back(), scene.warnings);
  }
}

void import_lights(const Document& document, Scene& scene) {
  for (size_t i = 0; i < document.model.lights.size(); ++i) {
    scene.lights.push_back(import_light(document.model.lights[i], at("lights", i), scene.warnings));
    import_shape(document.model.lights[i].extensions, at("lights", i), scene.lights.back(), scene.warnings);
  }
}

void import_nodes(const Document& document, Scene& scene, int wanted_scene) {
  NodeImporter(document, scene).run(wanted_scene);
}

}  // namespace etendue::scene::gltf
