// Nodes, cameras, lights, skins and animations.                                    glTF 2.0, sections 3.5, 3.10 to 3.12
#include "scene/gltf_document.h"

namespace etendue::scene::gltf {
namespace {

bool finite(const std::vector<double>& v) {
  for (const double x : v)
    if (!std::isfinite(x)) return false;
  return true;
}

Vec3 vec3_of(const std::vector<double>& v) { return {static_cast<float>(v[0]), static_cast<float>(v[1]), static_cast<float>(v[2])}; }

Transform transform_of(const tinygltf::Node& n, const std::string& where, Scene& scene) {
  Transform t;
  if (!finite(n.matrix) || !finite(n.translation) || !finite(n.rotation) || !finite(n.scale)) fail(where, "its transform has numbers that are not finite");
  if (n.matrix.size() == 16) {
    Mat4 m;
    for (int i = 0; i < 16; ++i) m[i / 4][i % 4] = static_cast<float>(n.matrix[static_cast<size_t>(i)]);
    t.matrix = m;
  }
  if (n.translation.size() == 3) t.translation = vec3_of(n.translation);
  if (n.scale.size() == 3) t.scale = vec3_of(n.scale);
  if (n.rotation.size() == 4) {
    const Vec4 q(vec3_of(n.rotation), static_cast<float>(n.rotation[3]));
    const float length = glm::length(q);
    if (length > 0) t.rotation = q / length;
    if (!(length > 0)) scene.warnings.push_back(where + ": its rotation is no quaternion; left out");
  }
  return t;
}

int light_of(const tinygltf::Node& n, const Document& d, const std::string& where) {
  const auto* extension = extension_of(n.extensions, "KHR_lights_punctual");
  if (!extension) return -1;
  return checked_index(static_cast<int>(number_of(*extension, "light", -1)), d.model.lights.size(), where + ".KHR_lights_punctual", "lights");
}

AnimatedPath path_of(const std::string& name) {
  return name == "translation" ? AnimatedPath::translation : name == "rotation" ? AnimatedPath::rotation : name == "scale" ? AnimatedPath::scale : AnimatedPath::weights;
}

AnimationChannel import_channel(const Document& d, const Scene& scene, const tinygltf::Animation& animation, size_t c, const std::string& where) {
  const auto& from = animation.channels[c];
  AnimationChannel channel;
  channel.node = checked_index(from.target_node, d.model.nodes.size(), where + ".target.node", "nodes");
  if (channel.node < 0) return channel;
  channel.path = path_of(from.target_path);
  if (checked_index(from.sampler, animation.samplers.size(), where + ".sampler", "samplers") < 0) fail(where, "names no sampler");
  const auto& sampler = animation.samplers[static_cast<size_t>(from.sampler)];
  channel.interpolation = sampler.interpolation == "STEP" ? Interpolation::step : sampler.interpolation == "CUBICSPLINE" ? Interpolation::cubic : Interpolation::linear;
  channel.times = read_floats(d, sampler.input, 1, where + ".input");
  for (size_t i = 0; i < channel.times.size(); ++i)
    if (!std::isfinite(channel.times[i]) || (i > 0 && channel.times[i] <= channel.times[i - 1])) fail(where + ".input", "times have to grow from key to key");
  if (channel.path == AnimatedPath::weights) {
    const int mesh = scene.nodes[static_cast<size_t>(channel.node)].mesh;
    channel.components = mesh >= 0 && !d.model.meshes[static_cast<size_t>(mesh)].primitives.empty() ? d.model.meshes[static_cast<size_t>(mesh)].primitives[0].targets.size() : 0;
    channel.values = read_floats(d, sampler.output, 1, where + ".output");
  } else {
    channel.components = channel.path == AnimatedPath::rotation ? 4 : 3;
    channel.values = read_floats(d, sampler.output, static_cast<int>(channel.components), where + ".output");
  }
  const size_t wanted = channel.times.size() * channel.components * (channel.interpolation == Interpolation::cubic ? 3 : 1);
  if (channel.values.size() != wanted)
    fail(where + ".output", "has " + std::to_string(channel.values.size()) + " numbers, but the keys need " + std::to_string(wanted));
  return channel;
}

}  // namespace

void import_cameras(const Document& d, Scene& scene) {
  for (size_t i = 0; i < d.model.cameras.size(); ++i) {
    const auto& from = d.model.cameras[i];
    Camera camera;
    camera.name = from.name;
    if (from.type == "orthographic") {
      camera.projection = Projection::orthographic;
      camera.ymag = static_cast<float>(std::abs(from.orthographic.ymag));
      if (from.orthographic.ymag != 0) camera.aspect = static_cast<float>(std::abs(from.orthographic.xmag / from.orthographic.ymag));
      if (!(camera.ymag > 0)) scene.warnings.push_back(at("cameras", i) + ": its ymag is zero; 1 is used"), camera.ymag = 1, camera.aspect = 0;
    } else {
      camera.yfov = static_cast<float>(from.perspective.yfov);
      camera.aspect = static_cast<float>(from.perspective.aspectRatio);
      if (!(camera.yfov > 0 && camera.yfov < kPi)) scene.warnings.push_back(at("cameras", i) + ": its yfov is not between 0 and pi; 0.8 is used"), camera.yfov = 0.8f;
    }
    if (!std::isfinite(camera.aspect) || camera.aspect < 0 || camera.aspect > 100) camera.aspect = 0;
    scene.cameras.push_back(camera);
  }
}

void import_lights(const Document& d, Scene& scene) {
  for (const auto& from : d.model.lights) {
    Light light;
    light.name = from.name;
    light.type = from.type == "directional" ? LightType::directional : from.type == "spot" ? LightType::spot : LightType::point;
    if (from.color.size() == 3 && finite(from.color)) light.color = {std::max(0.0f, static_cast<float>(from.color[0])), std::max(0.0f, static_cast<float>(from.color[1])), std::max(0.0f, static_cast<float>(from.color[2]))};
    light.intensity = std::isfinite(from.intensity) ? std::max(0.0f, static_cast<float>(from.intensity)) : 0;
    if (from.range > 0) light.range = static_cast<float>(from.range);
    light.inner_cone = std::clamp(static_cast<float>(from.spot.innerConeAngle), 0.0f, kPi / 2);
    light.outer_cone = std::clamp(static_cast<float>(from.spot.outerConeAngle), light.inner_cone, kPi / 2);
    scene.lights.push_back(light);
  }
}

void import_nodes(const Document& d, Scene& scene, int wanted_scene) {
  const auto& model = d.model;
  for (size_t i = 0; i < model.nodes.size(); ++i) {
    const auto& from = model.nodes[i];
    Node n;
    n.name = from.name;
    n.transform = transform_of(from, at("nodes", i), scene);
    n.children = from.children;
    n.mesh = from.mesh, n.camera = from.camera, n.skin = from.skin;
    n.light = light_of(from, d, at("nodes", i));
    for (const double w : from.weights) n.weights.push_back(static_cast<float>(w));
    scene.nodes.push_back(std::move(n));
  }
  for (size_t i = 0; i < scene.nodes.size(); ++i)
    for (const int child : scene.nodes[i].children) scene.nodes[static_cast<size_t>(child)].parent = static_cast<int>(i);
  for (const auto& s : model.scenes) scene.scene_names.push_back(s.name);
  int chosen = wanted_scene >= 0 ? wanted_scene : model.defaultScene;
  if (chosen < 0 && !model.scenes.empty()) chosen = 0;
  if (chosen >= 0 && checked_index(chosen, model.scenes.size(), "scene", "scenes") >= 0) {
    scene.roots = model.scenes[static_cast<size_t>(chosen)].nodes;
    return;
  }
  for (size_t i = 0; i < scene.nodes.size(); ++i)
    if (scene.nodes[i].parent < 0) scene.roots.push_back(static_cast<int>(i));
}

void import_skins(const Document& d, Scene& scene) {
  for (size_t i = 0; i < d.model.skins.size(); ++i) {
    const auto& from = d.model.skins[i];
    const std::string where = at("skins", i);
    auto skin = std::make_shared<Skin>();
    for (const int joint : from.joints)
      if (checked_index(joint, d.model.nodes.size(), where + ".joints", "nodes") < 0) fail(where, "lists a joint that is no node");
    skin->joints = from.joints;
    skin->inverse_bind.assign(from.joints.size(), Mat4(1));
    if (from.inverseBindMatrices >= 0) {
      const auto numbers = read_floats(d, from.inverseBindMatrices, 16, where + ".inverseBindMatrices");
      if (numbers.size() < 16 * from.joints.size()) fail(where + ".inverseBindMatrices", "has fewer matrices than there are joints");
      for (size_t j = 0; j < from.joints.size(); ++j)
        for (size_t k = 0; k < 16; ++k) skin->inverse_bind[j][static_cast<int>(k / 4)][static_cast<int>(k % 4)] = numbers[16 * j + k];
    }
    scene.skins.push_back(std::move(skin));
  }
}

void import_animations(const Document& d, Scene& scene) {
  for (size_t i = 0; i < d.model.animations.size(); ++i) {
    const auto& from = d.model.animations[i];
    auto animation = std::make_shared<Animation>();
    animation->name = from.name;
    for (size_t c = 0; c < from.channels.size(); ++c) {
      AnimationChannel channel = import_channel(d, scene, from, c, at("animations", i) + "." + at("channels", c));
      if (channel.node < 0 || channel.times.empty() || channel.components == 0) continue;
      animation->duration = std::max(animation->duration, channel.times.back());
      animation->channels.push_back(std::move(channel));
    }
    // Only the first plays, as viewers do: several at once would pull at the same nodes.
    if (scene.animations.empty()) scene.animations.push_back(std::move(animation));
  }
  if (d.model.animations.size() > 1) scene.warnings.push_back("has " + std::to_string(d.model.animations.size()) + " animations; the first one plays");
}

}  // namespace etendue::scene::gltf
