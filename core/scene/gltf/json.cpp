#include "scene/gltf/json.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <unordered_map>

#include "scene/gltf/document.h"

namespace etendue::scene::gltf {
namespace {

using nlohmann::json;

// glTF needs a dozen levels. The parser's own tree is walked recursively, here and elsewhere.
constexpr int kDeepest = 64;

// What a member has to be wherever it occurs; glTF uses each name for one kind of thing, or for two that differ in
// type.
enum class Kind { index, size, stride, number, numbers, scale, rotation, factor, indices, attributes };

struct Rule {
  Kind kind;
  size_t count = 0;  // numbers: how many
};

const std::unordered_map<std::string_view, Rule>& rules() {
  static const std::unordered_map<std::string_view, Rule> kRules{{"buffer", {Kind::index}},
                                                                 {"bufferView", {Kind::index}},
                                                                 {"mesh", {Kind::index}},
                                                                 {"camera", {Kind::index}},
                                                                 {"skin", {Kind::index}},
                                                                 {"skeleton", {Kind::index}},
                                                                 {"scene", {Kind::index}},
                                                                 {"source", {Kind::index}},
                                                                 {"sampler", {Kind::index}},
                                                                 {"input", {Kind::index}},
                                                                 {"output", {Kind::index}},
                                                                 {"node", {Kind::index}},
                                                                 {"material", {Kind::index}},
                                                                 {"inverseBindMatrices", {Kind::index}},
                                                                 {"index", {Kind::index}},
                                                                 {"texCoord", {Kind::index}},
                                                                 {"light", {Kind::index}},
                                                                 {"mode", {Kind::index}},
                                                                 {"componentType", {Kind::index}},
                                                                 {"wrapS", {Kind::index}},
                                                                 {"wrapT", {Kind::index}},
                                                                 {"minFilter", {Kind::index}},
                                                                 {"magFilter", {Kind::index}},
                                                                 {"count", {Kind::size}},
                                                                 {"byteOffset", {Kind::size}},
                                                                 {"byteLength", {Kind::size}},
                                                                 {"byteStride", {Kind::stride}},
                                                                 {"children", {Kind::indices}},
                                                                 {"nodes", {Kind::indices}},
                                                                 {"joints", {Kind::indices}},
                                                                 {"variants", {Kind::indices}},
                                                                 {"attributes", {Kind::attributes}},
                                                                 {"scale", {Kind::scale}},
                                                                 {"rotation", {Kind::rotation}},
                                                                 {"matrix", {Kind::numbers, 16}},
                                                                 {"translation", {Kind::numbers, 3}},
                                                                 {"offset", {Kind::numbers, 2}},
                                                                 {"baseColorFactor", {Kind::numbers, 4}},
                                                                 {"emissiveFactor", {Kind::numbers, 3}},
                                                                 {"color", {Kind::numbers, 3}},
                                                                 {"specularColorFactor", {Kind::numbers, 3}},
                                                                 {"attenuationColor", {Kind::numbers, 3}},
                                                                 {"weights", {Kind::numbers}},
                                                                 {"metallicFactor", {Kind::number}},
                                                                 {"roughnessFactor", {Kind::number}},
                                                                 {"alphaCutoff", {Kind::number}},
                                                                 {"strength", {Kind::number}},
                                                                 {"yfov", {Kind::number}},
                                                                 {"xmag", {Kind::number}},
                                                                 {"ymag", {Kind::number}},
                                                                 {"znear", {Kind::number}},
                                                                 {"zfar", {Kind::number}},
                                                                 {"aspectRatio", {Kind::number}},
                                                                 {"intensity", {Kind::number}},
                                                                 {"range", {Kind::number}},
                                                                 {"innerConeAngle", {Kind::number}},
                                                                 {"outerConeAngle", {Kind::number}},
                                                                 {"emissiveStrength", {Kind::number}},
                                                                 {"ior", {Kind::number}},
                                                                 {"specularFactor", {Kind::factor, 3}},
                                                                 {"transmissionFactor", {Kind::number}},
                                                                 {"thicknessFactor", {Kind::number}},
                                                                 {"attenuationDistance", {Kind::number}},
                                                                 {"anisotropyStrength", {Kind::number}},
                                                                 {"clearcoatFactor", {Kind::number}},
                                                                 {"clearcoatRoughnessFactor", {Kind::number}},
                                                                 {"sheenRoughnessFactor", {Kind::number}},
                                                                 {"iridescenceFactor", {Kind::number}},
                                                                 {"iridescenceIor", {Kind::number}},
                                                                 {"iridescenceThicknessMinimum", {Kind::number}},
                                                                 {"iridescenceThicknessMaximum", {Kind::number}},
                                                                 {"diffuseTransmissionFactor", {Kind::number}},
                                                                 {"glossinessFactor", {Kind::number}},
                                                                 {"sheenColorFactor", {Kind::numbers, 3}},
                                                                 {"diffuseTransmissionColorFactor", {Kind::numbers, 3}},
                                                                 {"diffuseFactor", {Kind::numbers, 4}},
                                                                 {"anisotropyRotation", {Kind::number}}};
  return kRules;
}

std::string shown(const json& value) {
  const std::string text = value.dump(-1, ' ', false, json::error_handler_t::replace);
  return text.size() > 40 ? text.substr(0, 40) + "..." : text;
}

void check_integer(json& value, uint64_t most, const std::string& where) {
  if (value.is_number_float() && std::floor(value.get<double>()) == value.get<double>() &&
      std::abs(value.get<double>()) <= 0x1p53)
    value = static_cast<int64_t>(value.get<double>());
  if (value.is_number_integer() && !value.is_number_unsigned() && value.get<int64_t>() >= 0)
    value = static_cast<uint64_t>(value.get<int64_t>());
  if (!value.is_number_unsigned() || value.get<uint64_t>() > most)
    fail(where, shown(value) + " has to be an integer between 0 and " + std::to_string(most));
}

void check_number(const json& value, const std::string& where) {
  const bool fits =
      value.is_number() && std::abs(value.get<double>()) <= static_cast<double>(std::numeric_limits<float>::max());
  if (!fits) fail(where, shown(value) + " has to be a number that single precision can hold");
}

void check_numbers(const json& value, size_t count, const std::string& where) {
  if (!value.is_array()) fail(where, shown(value) + " has to be an array of numbers");
  if (count > 0 && value.size() != count)
    fail(where, "has " + std::to_string(value.size()) + " numbers; " + std::to_string(count) + " are needed");
  for (const json& number : value) check_number(number, where);
}

constexpr uint64_t kMostIndex = std::numeric_limits<int>::max(), kMostSize = uint64_t{1} << 53;

void check_member(json& value, const Rule& rule, bool in_sparse, const std::string& where) {
  switch (rule.kind) {
    case Kind::index:
      return check_integer(value, kMostIndex, where);
    case Kind::size:
      return check_integer(value, in_sparse ? kMostIndex : kMostSize, where);
    case Kind::stride:
      check_integer(value, kMostIndex, where);
      // Section 5.11.4; what is not said is taken as packed.
      if (value.get<int>() % 4 != 0 || value.get<int>() > 252)
        fail(where, shown(value) + " has to be a multiple of 4 of at most 252");
      return;
    case Kind::number:
      return check_number(value, where);
    case Kind::numbers:
      return check_numbers(value, rule.count, where);
    // Of a node, of a texture transform, of a normal texture.
    case Kind::scale:
      return value.is_array() ? check_numbers(value, value.size() == 2 ? 2 : 3, where) : check_number(value, where);
    case Kind::rotation:
      return value.is_array() ? check_numbers(value, 4, where) : check_number(value, where);
    // Of KHR_materials_specular, of KHR_materials_pbrSpecularGlossiness.
    case Kind::factor:
      return value.is_array() ? check_numbers(value, rule.count, where) : check_number(value, where);
    case Kind::indices:
      if (!value.is_array()) fail(where, "has to be an array of indices");
      for (size_t i = 0; i < value.size(); ++i)
        check_integer(value[i], kMostIndex, where + "[" + std::to_string(i) + "]");
      return;
    case Kind::attributes:
      if (!value.is_object()) fail(where, "has to be an object that names accessors");
      for (auto& [name, index] : value.items()) check_integer(index, kMostIndex, where + "." + name);
      return;
  }
}

void drop_unread(json& object) {
  object.erase("extras");
  const auto extensions = object.find("extensions");
  if (extensions == object.end()) return;
  if (!extensions->is_object()) {
    object.erase(extensions);
    return;
  }
  for (auto it = extensions->begin(); it != extensions->end();)
    it = is_supported(it.key()) && it->is_object() ? std::next(it) : extensions->erase(it);
}

void need(const json& object, const std::string& where, std::initializer_list<const char*> members) {
  if (!object.is_object()) fail(where, "has to be an object");
  for (const char* member : members)
    if (!object.contains(member)) fail(where, std::string("has no ") + member);
}

// Two names of index lists are also names of arrays of objects.
bool lists_objects(bool at_root, const std::string& key, const std::string& where) {
  return (at_root && key == "nodes") || where == "extensions.KHR_materials_variants.variants";
}

void check_tree(json& value, std::string& where, bool in_sparse) {
  const size_t length = where.size();
  if (value.is_array()) {
    for (size_t i = 0; i < value.size(); ++i) {
      if (!value[i].is_structured()) continue;
      where += "[" + std::to_string(i) + "]";
      check_tree(value[i], where, in_sparse);
      where.resize(length);
    }
    return;
  }
  drop_unread(value);
  for (auto it = value.begin(); it != value.end(); ++it) {
    // Its members have names of others and other meanings; who decodes it checks it.
    if (it.key() == "EXT_meshopt_compression" || it.key() == kTransport) continue;
    const auto rule = rules().find(it.key());
    if (rule == rules().end() && !it->is_structured()) continue;
    where += (length ? "." : "") + it.key();
    // The indices of a primitive are an accessor, those of sparse values an object.
    if (it.key() == "indices" && !in_sparse) check_integer(*it, kMostIndex, where);
    if (in_sparse && (it.key() == "indices" || it.key() == "values")) need(*it, where, {"bufferView"});
    if (it.key() == "sparse") need(*it, where, {"count", "indices", "values"});
    if (rule != rules().end() && !lists_objects(length == 0, it.key(), where))
      check_member(*it, rule->second, in_sparse, where);
    else if (it->is_structured())
      check_tree(*it, where, in_sparse || it.key() == "sparse");
    where.resize(length);
  }
}

void need_everywhere(const json& root, const char* array, std::initializer_list<const char*> members) {
  const auto found = root.find(array);
  if (found == root.end()) return;
  for (size_t i = 0; i < found->size(); ++i) need((*found)[i], at(array, i), members);
}

size_t size_of(const json& root, const char* array) {
  const auto found = root.find(array);
  return found == root.end() ? 0 : found->size();
}

// Whether the vertices are only there in a form that cannot be read; the name of that extension.
std::string compression_of(const json& root, const json& primitive) {
  const json extensions = primitive.value("extensions", json::object());
  const json attributes = primitive.value("attributes", json::object());
  if (!extensions.is_object() || !attributes.is_object()) return "";
  const json index = attributes.value("POSITION", json());
  if (!index.is_number_unsigned() || index.get<size_t>() >= size_of(root, "accessors")) return "";
  const json& accessor = root["accessors"][index.get<size_t>()];
  if (accessor.contains("bufferView") || accessor.contains("sparse")) return "";
  for (const auto& item : extensions.items())
    if (item.key().ends_with("_compression") && !is_supported(item.key())) return item.key();
  return "";
}

void check_compression(const json& root) {
  const auto meshes = root.find("meshes");
  if (meshes == root.end()) return;
  for (size_t m = 0; m < meshes->size(); ++m) {
    const auto primitives = (*meshes)[m].find("primitives");
    if (primitives == (*meshes)[m].end() || !primitives->is_array()) continue;
    for (size_t p = 0; p < primitives->size(); ++p)
      if ((*primitives)[p].is_object() && (*primitives)[p].contains("extensions"))
        if (const std::string name = compression_of(root, (*primitives)[p]); !name.empty())
          fail(at("meshes", m) + "." + at("primitives", p),
               "requires the extension " + name + ", which is not supported; it has no uncompressed copy");
  }
}

// The parser gives up on these without saying where.
void check_choices(const json& root) {
  for (size_t c = 0; root.contains("cameras") && c < root["cameras"].size(); ++c) {
    const json& camera = root["cameras"][c];
    const json& type = camera["type"];
    if (type != "perspective" && type != "orthographic")
      fail(at("cameras", c) + ".type", shown(type) + " is neither perspective nor orthographic");
    need(camera, at("cameras", c), {type == "perspective" ? "perspective" : "orthographic"});
    if (type == "perspective")
      need(camera["perspective"], at("cameras", c) + ".perspective", {"yfov", "znear"});
    else
      need(camera["orthographic"], at("cameras", c) + ".orthographic", {"xmag", "ymag", "zfar", "znear"});
  }
  const json::json_pointer place("/extensions/KHR_lights_punctual/lights");
  if (!root.contains(place)) return;
  const json& lights = root[place];
  const std::string where = "extensions.KHR_lights_punctual.lights";
  if (!lights.is_array()) fail(where, "has to be an array of objects");
  for (size_t l = 0; l < lights.size(); ++l) {
    const std::string light = where + "[" + std::to_string(l) + "]";
    need(lights[l], light, {"type"});
    if (lights[l]["type"] == "spot") need(lights[l], light, {"spot"});
  }
}

void check_indices(const json& root, const json& primitive, const std::string& where) {
  if (!primitive.contains("indices")) return;
  const auto index = primitive["indices"].get<size_t>();
  const size_t accessors = size_of(root, "accessors"), views = size_of(root, "bufferViews");
  checked_index(static_cast<int>(index), accessors, where, "accessors");
  const json& accessor = root["accessors"][index];
  const std::string name = "accessor " + std::to_string(index);
  if (!accessor.contains("bufferView")) fail(where, name + " has no bufferView");
  if (const auto view = accessor["bufferView"].get<size_t>(); view >= views)
    fail(where, name + " lies in bufferView " + std::to_string(view) + ", which does not exist; there are " +
                    std::to_string(views));
}

void check_primitives(json& root) {
  const auto meshes = root.find("meshes");
  if (meshes == root.end()) return;
  for (size_t m = 0; m < meshes->size(); ++m) {
    json& primitives = (*meshes)[m]["primitives"];
    const std::string where = at("meshes", m);
    if (!primitives.is_array()) fail(where + ".primitives", "has to be an array");
    for (size_t p = 0; p < primitives.size(); ++p) {
      const std::string primitive = where + "." + at("primitives", p);
      if (!primitives[p].is_object()) fail(primitive, "has to be an object");
      need(primitives[p], primitive, {"attributes"});
      const auto targets = primitives[p].find("targets");
      if (targets == primitives[p].end()) continue;
      if (!targets->is_array()) fail(primitive + ".targets", "has to be an array");
      for (size_t t = 0; t < targets->size(); ++t)
        check_member((*targets)[t], {Kind::attributes}, false, primitive + "." + at("targets", t));
    }
  }
}

void check_arrays(const json& root) {
  for (const char* array : {"accessors", "animations", "bufferViews", "buffers", "cameras", "images", "materials",
                            "meshes", "nodes", "samplers", "scenes", "skins", "textures"}) {
    const auto found = root.find(array);
    if (found == root.end()) continue;
    if (!found->is_array()) fail(array, "has to be an array of objects");
    for (size_t i = 0; i < found->size(); ++i)
      if (!(*found)[i].is_object()) fail(at(array, i), "has to be an object");
  }
}

// "2.0" as (2, 0); negative if it is no version.
std::pair<int, int> version_of(const json& text) {
  int major = -1, minor = -1;
  if (text.is_string()) std::sscanf(text.get_ref<const std::string&>().c_str(), "%4d.%4d", &major, &minor);
  return {major, minor};
}

std::string version_text(const json& version) {
  return version.is_string() ? version.get<std::string>().substr(0, 40) : shown(version);
}

}  // namespace

json parse_json(std::string_view text, std::vector<std::string>& warnings) {
  if (text.starts_with("\xef\xbb\xbf")) {
    warnings.emplace_back("the JSON begins with a byte order mark, which glTF forbids; it is ignored");
    text.remove_prefix(3);
  }
  while (!text.empty() && text.back() == '\0') text.remove_suffix(1);
  const size_t first = text.find_first_not_of(" \t\r\n");
  if (first == std::string_view::npos || text[first] != '{')
    throw Unusable{"is no glTF: it begins neither with '{' (JSON) nor with 'glTF' (binary)"};
  try {
    return json::parse(text, [](int depth, json::parse_event_t, const json&) {
      if (depth > kDeepest) throw Unusable{"the JSON is nested more than " + std::to_string(kDeepest) + " levels deep"};
      return true;
    });
  } catch (const json::exception& error) {
    std::string what = error.what();
    const size_t name = what.find("] ");
    throw Unusable{"is no valid JSON: " + (name == std::string::npos ? what : what.substr(name + 2))};
  }
}

void check_asset(const json& root) {
  const auto asset = root.find("asset");
  if (asset == root.end() || !asset->is_object() || !asset->contains("version"))
    throw Unusable{"is no glTF: asset.version is missing"};
  const auto [major, minor] = version_of((*asset)["version"]);
  if (major != 2 || minor < 0)
    throw Unusable{"is glTF of version " + version_text((*asset)["version"]) +
                   " (asset.version); 2.0 is what can be read"};
  if (asset->contains("minVersion")) {
    const auto least = version_of((*asset)["minVersion"]);
    if (least.first < 0 || least > std::pair(2, 0))
      throw Unusable{"needs glTF " + version_text((*asset)["minVersion"]) +
                     " (asset.minVersion); 2.0 is what can be read"};
  }
  const auto required = root.find("extensionsRequired");
  if (required == root.end()) return;
  if (!required->is_array()) fail("extensionsRequired", "has to be an array of names");
  for (const json& name : *required) {
    if (!name.is_string()) fail("extensionsRequired", shown(name) + " has to be a name");
    if (!is_supported(name))
      throw Unusable{"requires the extension " + name.get<std::string>() + ", which is not supported"};
  }
}

void check_index_accessors(const json& root) {
  for (size_t m = 0; m < size_of(root, "meshes"); ++m) {
    const json& primitives = root["meshes"][m]["primitives"];
    for (size_t p = 0; p < primitives.size(); ++p)
      check_indices(root, primitives[p], at("meshes", m) + "." + at("primitives", p) + ".indices");
  }
}

void check_structure(json& root) {
  check_arrays(root);
  check_compression(root);
  std::string where;
  check_tree(root, where, false);
  need_everywhere(root, "accessors", {"componentType", "count", "type"});
  need_everywhere(root, "bufferViews", {"buffer", "byteLength"});
  need_everywhere(root, "buffers", {"byteLength"});
  need_everywhere(root, "skins", {"joints"});
  need_everywhere(root, "animations", {"channels", "samplers"});
  need_everywhere(root, "meshes", {"primitives"});
  need_everywhere(root, "cameras", {"type"});
  check_primitives(root);
  check_choices(root);
}

}  // namespace etendue::scene::gltf
