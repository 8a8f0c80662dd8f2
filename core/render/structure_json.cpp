#include "render/structure_json.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <nlohmann/json.hpp>

namespace etendue::render {
namespace {

using nlohmann::json;
using scene::EditKind;
using scene::StructuralEdit;

constexpr std::array<const char*, 6> kKindNames{"add-light", "add-camera", "add-shape",
                                                "duplicate", "remove",     "rename"};

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

json edit_json(const StructuralEdit& edit) {
  json j{{"edit", kKindNames[static_cast<size_t>(edit.kind)]}};
  if (edit.kind != EditKind::remove) j["name"] = edit.name;
  if (edit.kind >= EditKind::duplicate) {
    j["node"] = edit.node;
    return j;
  }
  if (!edit.type.empty()) j["type"] = edit.type;
  j["translation"] = numbers_of(edit.transform.translation);
  j["rotation"] = numbers_of(edit.transform.rotation);
  j["scale"] = numbers_of(edit.transform.scale);
  if (edit.kind == EditKind::add_camera) j["camera"] = camera_json(edit.camera);
  return j;
}

StructuralEdit edit_from(const json& j) {
  const auto kind = std::ranges::find(kKindNames, j.at("edit").get<std::string>());
  if (kind == kKindNames.end()) throw json::other_error::create(501, "unknown edit", &j);
  StructuralEdit edit;
  edit.kind = static_cast<EditKind>(kind - kKindNames.begin());
  if (edit.kind != EditKind::remove) edit.name = j.at("name").get<std::string>();
  if (edit.kind >= EditKind::duplicate) {
    edit.node = j.at("node").get<int>();
    return edit;
  }
  edit.type = j.value("type", "");
  edit.transform.translation = vector_of<Vec3>(j.at("translation"));
  edit.transform.rotation = vector_of<Vec4>(j.at("rotation"));
  edit.transform.scale = vector_of<Vec3>(j.at("scale"));
  if (edit.kind == EditKind::add_camera) edit.camera = camera_from(j.at("camera"));
  return edit;
}

}  // namespace

json structure_json(const std::vector<StructuralEdit>& edits) {
  json list = json::array();
  for (const StructuralEdit& edit : edits) list.push_back(edit_json(edit));
  return list;
}

Result<std::vector<StructuralEdit>> structure_from_json(const json& edits) {
  if (!edits.is_array()) return input_error("its list of added and removed objects is damaged");
  std::vector<StructuralEdit> list;
  for (const json& edit : edits) {
    try {
      list.push_back(edit_from(edit));
    } catch (const json::exception&) {
      return input_error("entry " + std::to_string(list.size()) +
                         " of its list of added and removed objects is damaged");
    }
  }
  return list;
}

}  // namespace etendue::render
