#include "support/scene_compare.h"

#include <cstring>
#include <sstream>

namespace etendue::test {
namespace {

class Comparison {
 public:
  Comparison(const scene::Scene& a, const scene::Scene& b) : a_(a), b_(b) {}

  std::string run() {
    same("name", a_.name, b_.name);
    each("nodes", a_.nodes, b_.nodes, [&](const auto& x, const auto& y) { node(x, y); });
    same("roots", a_.roots, b_.roots);
    each("meshes", shown(a_), shown(b_), [&](const auto* x, const auto* y) { group(*x, *y); });
    materials();
    each("textures", a_.textures, b_.textures, [&](const auto& x, const auto& y) { texture(x, y); });
    each("lights", a_.lights, b_.lights, [&](const auto& x, const auto& y) { same("", x, y); });
    each("cameras", a_.cameras, b_.cameras, [&](const auto& x, const auto& y) { same("", x, y); });
    each("skins", a_.skins, b_.skins, [&](const auto& x, const auto& y) {
      same(".joints", x->joints, y->joints);
      bits(".inverse_bind", x->inverse_bind, y->inverse_bind);
    });
    each("animations", a_.animations, b_.animations, [&](const auto& x, const auto& y) { animation(*x, *y); });
    environment();
    same("time", a_.time, b_.time);
    same("variants", a_.variants, b_.variants);
    same("variant", a_.variant, b_.variant);
    return found_;
  }

 private:
  void differ(const std::string& what) {
    if (found_.empty()) found_ = place_ + what;
  }
  template <class T>
  void same(const char* what, const T& x, const T& y) {
    if (!(x == y)) differ(what);
  }
  // Compares the bits, because files keep negative zeros.
  template <class T>
  void bits(const std::string& what, const std::vector<T>& x, const std::vector<T>& y) {
    if (x.size() != y.size()) return differ(what + ": " + std::to_string(x.size()) + " or " + std::to_string(y.size()));
    if (!x.empty() && std::memcmp(x.data(), y.data(), x.size() * sizeof(T)) != 0) differ(what + ": other bits");
  }
  template <class Array, class Compare>
  void each(const char* array, const Array& x, const Array& y, Compare&& compare) {
    const std::string before = place_;
    if (x.size() != y.size())
      differ(std::string(array) + ": " + std::to_string(x.size()) + " or " + std::to_string(y.size()));
    for (size_t i = 0; i < std::min(x.size(), y.size()); ++i) {
      place_ = before + array + "[" + std::to_string(i) + "]";
      compare(x[i], y[i]);
    }
    place_ = before;
  }

  static std::vector<const scene::MeshGroup*> shown(const scene::Scene& scene) {
    std::vector<const scene::MeshGroup*> groups;
    for (const auto& group : scene.meshes)
      if (!group.primitives.empty()) groups.push_back(&group);
    return groups;
  }
  static bool shows(const scene::Scene& scene, int mesh) {
    return mesh >= 0 && !scene.meshes[static_cast<size_t>(mesh)].primitives.empty();
  }

  void node(const scene::Node& x, const scene::Node& y) {
    same(".name", x.name, y.name);
    same(".transform.matrix", x.transform.matrix, y.transform.matrix);
    if (!x.transform.matrix) same(".transform", x.transform, y.transform);
    same(".parent", x.parent, y.parent);
    same(".children", x.children, y.children);
    same(".camera", x.camera, y.camera);
    same(".light", x.light, y.light);
    same(".visible", x.visible, y.visible);
    same(".mesh", shows(a_, x.mesh), shows(b_, y.mesh));
    if (!shows(a_, x.mesh)) return;
    same(".skin", x.skin, y.skin);
    same(".weights", x.weights, y.weights);
  }

  void group(const scene::MeshGroup& x, const scene::MeshGroup& y) {
    same(".name", x.name, y.name);
    same(".weights", x.weights, y.weights);
    each(".primitives", x.primitives, y.primitives, [&](const auto& p, const auto& q) { primitive(p, q); });
  }

  void primitive(const scene::Primitive& x, const scene::Primitive& y) {
    same(".material", x.material, y.material);
    const bool choice = std::any_of(x.choices.begin(), x.choices.end(), [&](int c) { return c != x.choices[0]; });
    if (choice) same(".choices", x.choices, y.choices);
    const Mesh &m = *x.mesh, &n = *y.mesh;
    bits(".positions", m.positions, n.positions);
    bits(".triangles", m.triangles, n.triangles);
    bits(".normals", m.normals, n.normals);
    bits(".tangents", m.tangents, n.tangents);
    bits(".uvs[0]", m.uvs[0], n.uvs[0]);
    bits(".uvs[1]", m.uvs[1], n.uvs[1]);
    bits(".colors", m.colors, n.colors);
    same(".deformation", !x.deformation, !y.deformation);
    if (x.deformation && y.deformation) deformation(*x.deformation, *y.deformation);
  }

  void deformation(const scene::Deformation& x, const scene::Deformation& y) {
    same(".joint_sets", x.joint_sets, y.joint_sets);
    bits(".joints", x.joints, y.joints);
    bits(".weights", x.weights, y.weights);
    each(".targets", x.targets, y.targets, [&](const auto& t, const auto& u) {
      bits(".positions", t.positions, u.positions);
      bits(".normals", t.normals, u.normals);
      bits(".tangents", t.tangents, u.tangents);
    });
  }

  static Material without_idle(Material m) {
    if (m.normal_texture.texture < 0) m.normal_scale = 1;
    if (m.clearcoat_normal_texture.texture < 0) m.clearcoat_normal_scale = 1;
    if (m.alpha_mode != AlphaMode::mask) m.alpha_cutoff = 0.5f;
    return m;
  }
  static size_t named(const scene::Scene& scene) {
    Material usual;
    usual.name = "default";
    return scene.materials.size() - (!scene.materials.empty() && scene.materials.back() == usual);
  }
  void materials() {
    if (named(a_) != named(b_)) differ("materials: " + std::to_string(named(a_)) + " or " + std::to_string(named(b_)));
    for (size_t m = 0; m < std::min(named(a_), named(b_)); ++m)
      if (!(without_idle(a_.materials[m]) == without_idle(b_.materials[m])))
        differ("materials[" + std::to_string(m) + "] '" + a_.materials[m].name + "'");
  }

  void texture(const Texture& x, const Texture& y) {
    same(".name", x.name, y.name);
    same(".nearest", x.nearest, y.nearest);
    same(".wrap", std::pair(x.wrap_u, x.wrap_v), std::pair(y.wrap_u, y.wrap_v));
    same(".image", !x.image, !y.image);
    if (x.image && y.image) image(*x.image, *y.image);
  }
  void image(const image::Image& x, const image::Image& y) {
    same(".image size", std::tuple(x.width, x.height, x.channels), std::tuple(y.width, y.height, y.channels));
    bits(".image bytes", x.bytes, y.bytes);
    bits(".image floats", x.floats, y.floats);
  }

  void animation(const scene::Animation& x, const scene::Animation& y) {
    same(".name", x.name, y.name);
    same(".duration", x.duration, y.duration);
    each(".channels", x.channels, y.channels, [&](const auto& c, const auto& d) {
      same("", std::tuple(c.node, c.path, c.interpolation, c.components),
           std::tuple(d.node, d.path, d.interpolation, d.components));
      bits(".times", c.times, d.times);
      bits(".values", c.values, d.values);
    });
  }

  void environment() {
    const Environment &x = a_.environment, &y = b_.environment;
    same("environment", std::tuple(x.tint, x.rotation, x.visible), std::tuple(y.tint, y.rotation, y.visible));
    same("atmosphere", a_.atmosphere, b_.atmosphere);
    same("environment.map", !x.map, !y.map);
    place_ = "environment";
    if (x.map && y.map) image(*x.map, *y.map);
    place_.clear();
  }

  const scene::Scene &a_, &b_;
  std::string place_, found_;
};

}  // namespace

std::string difference(const scene::Scene& a, const scene::Scene& b) { return Comparison(a, b).run(); }

}  // namespace etendue::test
