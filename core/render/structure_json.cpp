#include "render/structure_json.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <nlohmann/json.hpp>

#include "base/json_integer.h"

namespace etendue::render {
namespace {

using nlohmann::json;
using scene::EditKind;
using scene::StructuralEdit;

constexpr std::array<const char*, 14> kKindNames{
    "add-light",       "add-camera",      "add-shape",    "duplicate",    "remove",
    "rename",          "set-parent",      "add-material", "rename-material", "remove-material",
    "assign-material", "add-texture",     "set-keyframe", "remove-keyframe"};

// What an edit of each kind consists of, besides the camera of add-camera.
struct Members {
  bool name = false, type = false, node = false, material = false, parent = false, primitive = false, file = false;
  bool transform = false, keyframe = false;
};

Members members_of(EditKind kind) {
  switch (kind) {
    case EditKind::add_light:
    case EditKind::add_camera:
    case EditKind::add_shape:
      return {.name = true, .type = true, .transform = true};
    case EditKind::duplicate:
    case EditKind::rename:
      return {.name = true, .node = true};
    case EditKind::remove:
      return {.node = true};
    case EditKind::set_parent:
      return {.node = true, .parent = true, .transform = true};
    case EditKind::add_material:
    case EditKind::rename_material:
      return {.name = true, .material = true};
    case EditKind::remove_material:
      return {.material = true};
    case EditKind::assign_material:
      return {.node = true, .material = true, .primitive = true};
    case EditKind::add_texture:
      return {.file = true};
    case EditKind::set_keyframe:
      return {.node = true, .transform = true, .keyframe = true};
    case EditKind::remove_keyframe:
      return {.node = true, .keyframe = true};
  }
  return {};
}

template <class V>
json numbers_of(const V& v) {
  json list = json::array();
  for (int c = 0; c < V::length(); ++c) list.push_back(v[c]);
  return list;
}

// json::exception for anything but an array of numbers of this length.
template <class V>
V vector_of(const json& list) {
  const auto values = list.get<std::vector<float>>();
  V v;
  if (values.size() != static_cast<size_t>(V::length())) throw json::other_error::create(501, "length", &list);
  for (int c = 0; c < V::length(); ++c) v[c] = values[static_cast<size_t>(c)];
  return v;
}

json camera_json(const Camera& camera) {
  json j{{"orthographic", camera.projection == Projection::orthographic},
         {"yfov", camera.yfov},
         {"ymag", camera.ymag},
         {"aspect", camera.aspect},
         {"lens_radius", camera.lens_radius},
         {"focus_distance", camera.focus_distance},
         {"shutter", camera.shutter},
         {"near_clip", camera.near_clip}};
  // JSON has no infinity.
  if (std::isfinite(camera.far_clip)) j["far_clip"] = camera.far_clip;
  return j;
}

// Throws unless the value is in the range of the parameter of the same name.
float number_in(const json& j, const char* name, float low, float high) {
  const auto value = j.at(name).get<float>();
  if (!(value >= low && value <= high)) throw json::other_error::create(501, std::string(name) + " out of range", &j);
  return value;
}

Camera camera_from(const json& j) {
  constexpr float kLargest = 1e9f, kSmallest = 1e-9f;
  Camera camera;
  camera.projection = j.at("orthographic").get<bool>() ? Projection::orthographic : Projection::perspective;
  camera.yfov = number_in(j, "yfov", 1e-3f, 3.1f);
  camera.ymag = number_in(j, "ymag", kSmallest, kLargest);
  camera.aspect = number_in(j, "aspect", 0, 1e3f);
  camera.lens_radius = number_in(j, "lens_radius", 0, kLargest);
  camera.focus_distance = number_in(j, "focus_distance", 0, kLargest);
  camera.shutter = number_in(j, "shutter", 0, kLargest);
  camera.near_clip = number_in(j, "near_clip", 0, kLargest);
  if (j.contains("far_clip")) camera.far_clip = number_in(j, "far_clip", 0, std::numeric_limits<float>::max());
  return camera;
}

void put_transform(json& j, const scene::Transform& transform) {
  if (transform.matrix) {
    j["matrix"] = json::array();
    for (int c = 0; c < 4; ++c) j["matrix"].push_back(numbers_of((*transform.matrix)[c]));
    return;
  }
  j["translation"] = numbers_of(transform.translation);
  j["rotation"] = numbers_of(transform.rotation);
  j["scale"] = numbers_of(transform.scale);
}

scene::Transform transform_from(const json& j) {
  scene::Transform transform;
  if (!j.contains("matrix")) {
    transform.translation = vector_of<Vec3>(j.at("translation"));
    transform.rotation = vector_of<Vec4>(j.at("rotation"));
    transform.scale = vector_of<Vec3>(j.at("scale"));
    return transform;
  }
  Mat4 matrix;
  for (int c = 0; c < 4; ++c) matrix[c] = vector_of<Vec4>(j.at("matrix").at(static_cast<size_t>(c)));
  transform.matrix = matrix;
  return transform;
}

json edit_json(const StructuralEdit& edit, const FileNaming& naming) {
  json j{{"edit", kKindNames[static_cast<size_t>(edit.kind)]}};
  const Members members = members_of(edit.kind);
  if (members.name) j["name"] = edit.name;
  if (members.type && !edit.type.empty()) j["type"] = edit.type;
  if (members.node) j["node"] = edit.node;
  if (members.material) j["material"] = edit.material;
  if (members.parent) j["parent"] = edit.parent;
  if (members.primitive) j["primitive"] = edit.primitive;
  if (members.file) j["file"] = naming(edit.file);
  if (members.transform) put_transform(j, edit.transform);
  if (members.keyframe) {
    j["animation"] = edit.animation;
    j["time"] = edit.time;
  }
  if (edit.kind == EditKind::add_camera) j["camera"] = camera_json(edit.camera);
  return j;
}

StructuralEdit edit_from(const json& j, const FileNaming& naming) {
  const auto kind = std::ranges::find(kKindNames, j.at("edit").get<std::string>());
  if (kind == kKindNames.end()) throw json::other_error::create(501, "unknown edit", &j);
  StructuralEdit edit;
  edit.kind = static_cast<EditKind>(kind - kKindNames.begin());
  const Members members = members_of(edit.kind);
  if (members.name) edit.name = j.at("name").get<std::string>();
  if (members.type) edit.type = j.value("type", "");
  if (members.node) edit.node = json_integer<int>(j.at("node"));
  if (members.material) edit.material = json_integer<int>(j.at("material"));
  if (members.parent) edit.parent = json_integer<int>(j.at("parent"));
  if (members.primitive) edit.primitive = json_integer<int>(j.at("primitive"));
  if (members.file) edit.file = naming(j.at("file").get<std::string>());
  if (members.transform) edit.transform = transform_from(j);
  if (members.keyframe) {
    edit.animation = json_integer<int>(j.at("animation"));
    edit.time = j.at("time").get<float>();
  }
  if (edit.kind == EditKind::add_camera) edit.camera = camera_from(j.at("camera"));
  return edit;
}

}  // namespace

json structure_json(const std::vector<StructuralEdit>& edits, const FileNaming& naming) {
  json list = json::array();
  for (const StructuralEdit& edit : edits) list.push_back(edit_json(edit, naming));
  return list;
}

Result<std::vector<StructuralEdit>> structure_from_json(const json& edits, const FileNaming& naming) {
  if (!edits.is_array()) return input_error("its list of edits of objects and materials is damaged");
  std::vector<StructuralEdit> list;
  for (const json& edit : edits) {
    try {
      list.push_back(edit_from(edit, naming));
    } catch (const json::exception&) {
      return input_error("entry " + std::to_string(list.size()) +
                         " of its list of edits of objects and materials is damaged");
    }
  }
  return list;
}

}  // namespace etendue::render
