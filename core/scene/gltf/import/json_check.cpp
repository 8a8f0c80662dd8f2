#include "scene/gltf/import/json_check.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <unordered_map>

#include "base/json_nesting.h"
#include "base/json_text.h"
#include "scene/gltf/import/input_file.h"
#include "scene/gltf/transport_extension.h"

namespace etendue::scene::gltf {
namespace {

using nlohmann::json;

// glTF needs about twelve levels. The limit protects recursive functions, here and in tinygltf.
constexpr int kMaxNesting = 64;

// The type of a member. glTF uses most names for one type of value wherever they occur.
enum class Kind {
  index,       // integer in [0, 2^31)
  size,        // integer in [0, 2^53]
  stride,      // of a buffer view
  number,      // within the range of a float
  numbers,     // array of numbers
  scale,       // array for nodes and texture transforms, number for normal textures
  rotation,    // array for nodes, number for texture transforms
  factor,      // array for KHR_materials_pbrSpecularGlossiness, number for KHR_materials_specular
  indices,     // array of indices
  attributes,  // object with accessor indices as values
};

struct Rule {
  Kind kind = Kind::index;
  size_t count = 0;  // required length of an array of numbers; 0 is any
};

// The rules by member name.
const std::unordered_map<std::string_view, Rule>& rules() {
  static const auto kRules = [] {
    std::unordered_map<std::string_view, Rule> rules;
    const auto add = [&](const Rule& rule, std::initializer_list<std::string_view> names) {
      for (const std::string_view name : names) rules.emplace(name, rule);
    };
    add({.kind = Kind::index},
        {"buffer",    "bufferView", "mesh",  "camera", "skin",          "skeleton", "scene",
         "source",    "sampler",    "input", "output", "node",          "material", "inverseBindMatrices",
         "index",     "texCoord",   "light", "mode",   "componentType", "wrapS",    "wrapT",
         "minFilter", "magFilter"});
    add({.kind = Kind::size}, {"count", "byteOffset", "byteLength"});
    add({.kind = Kind::stride}, {"byteStride"});
    add({.kind = Kind::indices}, {"children", "nodes", "joints", "variants"});
    add({.kind = Kind::attributes}, {"attributes"});
    add({.kind = Kind::scale}, {"scale"});
    add({.kind = Kind::rotation}, {"rotation"});
    add({.kind = Kind::factor, .count = 3}, {"specularFactor"});
    add({.kind = Kind::numbers}, {"weights"});
    add({.kind = Kind::numbers, .count = 2}, {"offset"});
    add({.kind = Kind::numbers, .count = 3},
        {"translation", "color", "emissiveFactor", "specularColorFactor", "attenuationColor", "sheenColorFactor",
         "diffuseTransmissionColorFactor", "multiscatterColor", "multiscatterColorFactor"});
    add({.kind = Kind::numbers, .count = 4}, {"baseColorFactor", "diffuseFactor"});
    add({.kind = Kind::numbers, .count = 16}, {"matrix"});
    add({.kind = Kind::number}, {"metallicFactor", "roughnessFactor", "alphaCutoff", "strength"});
    add({.kind = Kind::number}, {"yfov", "xmag", "ymag", "znear", "zfar", "aspectRatio"});
    add({.kind = Kind::number}, {"intensity", "range", "innerConeAngle", "outerConeAngle"});
    add({.kind = Kind::number},
        {"emissiveStrength", "ior", "transmissionFactor", "thicknessFactor", "attenuationDistance",
         "anisotropyStrength", "anisotropyRotation", "clearcoatFactor", "clearcoatRoughnessFactor",
         "sheenRoughnessFactor", "iridescenceFactor", "iridescenceIor", "iridescenceThicknessMinimum",
         "iridescenceThicknessMaximum", "diffuseTransmissionFactor", "glossinessFactor", "scatterAnisotropy"});
    return rules;
  }();
  return kRules;
}

// The value as JSON, shortened for a message.
std::string shown(const json& value) {
  const std::string text = json_text(value);
  return text.size() > 40 ? text.substr(0, 40) + "..." : text;
}

// Also turns an integral float into an integer.
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
  if (!fits) fail(where, shown(value) + " has to be a number within the range of single precision");
}

void check_numbers(const json& value, size_t count, const std::string& where) {
  if (!value.is_array()) fail(where, shown(value) + " has to be an array of numbers");
  if (count > 0 && value.size() != count)
    fail(where, "has " + std::to_string(value.size()) + " numbers; it has to have " + std::to_string(count));
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
      // glTF 2.0, section 5.11.4. 0 means packed.
      if (value.get<int>() % 4 != 0 || value.get<int>() > 252)
        fail(where, shown(value) + " has to be a multiple of 4 and at most 252");
      return;
    case Kind::number:
      return check_number(value, where);
    case Kind::numbers:
      return check_numbers(value, rule.count, where);
    case Kind::scale:
      return value.is_array() ? check_numbers(value, value.size() == 2 ? 2 : 3, where) : check_number(value, where);
    case Kind::rotation:
      return value.is_array() ? check_numbers(value, 4, where) : check_number(value, where);
    case Kind::factor:
      return value.is_array() ? check_numbers(value, rule.count, where) : check_number(value, where);
    case Kind::indices:
      if (!value.is_array()) fail(where, "has to be an array of indices");
      for (size_t i = 0; i < value.size(); ++i)
        check_integer(value[i], kMostIndex, where + "[" + std::to_string(i) + "]");
      return;
    case Kind::attributes:
      if (!value.is_object()) fail(where, "has to be an object with accessor indices as values");
      for (auto& [name, index] : value.items()) check_integer(index, kMostIndex, where + "." + name);
      return;
  }
}

// Whether the importer reads an extension. That of KTX 2 textures is read for a warning only.
bool is_read(const std::string& extension) { return is_supported(extension) || extension == kBasisUniversal; }

// Removes what the importer does not read.
void drop_unread(json& object) {
  object.erase("extras");
  const auto extensions = object.find("extensions");
  if (extensions == object.end()) return;
  if (!extensions->is_object()) {
    object.erase(extensions);
    return;
  }
  for (auto it = extensions->begin(); it != extensions->end();)
    it = is_read(it.key()) && it->is_object() ? std::next(it) : extensions->erase(it);
}

void require(const json& object, const std::string& where, std::initializer_list<const char*> members) {
  if (!object.is_object()) fail(where, "has to be an object");
  for (const char* member : members)
    if (!object.contains(member)) fail(where, std::string("has no ") + member + ", which is required");
}

// Whether a member that is otherwise a list of indices is an array of objects here.
bool is_object_array(bool at_root, const std::string& key, const std::string& where) {
  return (at_root && key == "nodes") || where == "extensions.KHR_materials_variants.variants";
}

// Checks all members below `value`, whose path is `where`; `in_sparse`: inside the `sparse` member of an accessor.
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
    // These extensions reuse member names with other types; their readers check them.
    if (it.key() == "EXT_meshopt_compression" || it.key() == kTransport) continue;
    const auto rule = rules().find(it.key());
    const bool special = it.key() == "indices" || it.key() == "values" || it.key() == "sparse";
    if (rule == rules().end() && !special && !it->is_structured()) continue;
    where += (length ? "." : "") + it.key();
    // `indices` is an accessor index in a primitive and an object in `sparse`.
    if (it.key() == "indices" && !in_sparse) check_integer(*it, kMostIndex, where);
    if (in_sparse && (it.key() == "indices" || it.key() == "values")) require(*it, where, {"bufferView"});
    if (it.key() == "sparse") require(*it, where, {"count", "indices", "values"});
    if (rule != rules().end() && !is_object_array(length == 0, it.key(), where))
      check_member(*it, rule->second, in_sparse, where);
    else if (it->is_structured())
      check_tree(*it, where, in_sparse || it.key() == "sparse");
    where.resize(length);
  }
}

void require_in_each(const json& root, const char* array, std::initializer_list<const char*> members) {
  const auto found = root.find(array);
  if (found == root.end()) return;
  for (size_t i = 0; i < found->size(); ++i) require((*found)[i], at(array, i), members);
}

size_t size_of(const json& root, const char* array) {
  const auto found = root.find(array);
  return found == root.end() ? 0 : found->size();
}

// The unsupported compression extension that holds the only copy of a primitive's vertices; empty if there is none.
std::string unsupported_compression(const json& root, const json& primitive) {
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
        if (const std::string name = unsupported_compression(root, (*primitives)[p]); !name.empty())
          fail(at("meshes", m) + "." + at("primitives", p),
               "is compressed with " + name + ", which is not supported, and has no uncompressed copy");
  }
}

// tinygltf rejects these without naming the place.
void check_cameras_and_lights(const json& root) {
  for (size_t c = 0; root.contains("cameras") && c < root["cameras"].size(); ++c) {
    const json& camera = root["cameras"][c];
    const json& type = camera["type"];
    if (type != "perspective" && type != "orthographic")
      fail(at("cameras", c) + ".type", shown(type) + " has to be \"perspective\" or \"orthographic\"");
    require(camera, at("cameras", c), {type == "perspective" ? "perspective" : "orthographic"});
    if (type == "perspective")
      require(camera["perspective"], at("cameras", c) + ".perspective", {"yfov", "znear"});
    else
      require(camera["orthographic"], at("cameras", c) + ".orthographic", {"xmag", "ymag", "zfar", "znear"});
  }
  const json::json_pointer place("/extensions/KHR_lights_punctual/lights");
  if (!root.contains(place)) return;
  const json& lights = root[place];
  const std::string where = "extensions.KHR_lights_punctual.lights";
  if (!lights.is_array()) fail(where, "has to be an array of objects");
  for (size_t l = 0; l < lights.size(); ++l) {
    const std::string light = where + "[" + std::to_string(l) + "]";
    require(lights[l], light, {"type"});
    if (lights[l]["type"] == "spot") require(lights[l], light, {"spot"});
  }
}

void check_indices(const json& root, const json& primitive, const std::string& where) {
  if (!primitive.contains("indices")) return;
  const auto index = primitive["indices"].get<size_t>();
  const size_t accessors = size_of(root, "accessors"), views = size_of(root, "bufferViews");
  checked_index(static_cast<int>(std::min<size_t>(index, std::numeric_limits<int>::max())), accessors, where,
                "accessors");
  const json& accessor = root["accessors"][index];
  const std::string name = "accessor " + std::to_string(index);
  if (!accessor.contains("bufferView")) fail(where, name + " has no bufferView");
  if (const auto view = accessor["bufferView"].get<size_t>(); view >= views)
    fail(where, name + " refers to bufferView " + std::to_string(view) + ", which does not exist; the file has " +
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
      require(primitives[p], primitive, {"attributes"});
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

// "2.0" as (2, 0); negative if the text is not a version.
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
    throw FileError{"not glTF: the file has to begin with '{' (JSON) or 'glTF' (binary)"};
  if (json_nesting(text) > kMaxNesting)
    throw FileError{"the JSON is nested more than " + std::to_string(kMaxNesting) + " levels deep"};
  try {
    return json::parse(text);
  } catch (const json::exception& error) {
    std::string what = error.what();
    const size_t name = what.find("] ");
    throw FileError{"not valid JSON: " + (name == std::string::npos ? what : what.substr(name + 2))};
  }
}

void check_asset(const json& root) {
  const auto asset = root.find("asset");
  if (asset == root.end() || !asset->is_object() || !asset->contains("version"))
    throw FileError{"not glTF: asset.version is missing"};
  const auto [major, minor] = version_of((*asset)["version"]);
  if (major != 2 || minor < 0)
    throw FileError{"glTF version " + version_text((*asset)["version"]) +
                    " (asset.version) is not supported, only 2.0 is"};
  if (asset->contains("minVersion")) {
    const auto least = version_of((*asset)["minVersion"]);
    if (least.first < 0 || least > std::pair(2, 0))
      throw FileError{"requires glTF " + version_text((*asset)["minVersion"]) +
                      " (asset.minVersion); only 2.0 is supported"};
  }
  const auto required = root.find("extensionsRequired");
  if (required == root.end()) return;
  if (!required->is_array()) fail("extensionsRequired", "has to be an array of strings");
  for (const json& name : *required) {
    if (!name.is_string()) fail("extensionsRequired", shown(name) + " has to be a string");
    if (!is_supported(name))
      throw FileError{"requires the extension " + name.get<std::string>() + ", which is not supported"};
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
  require_in_each(root, "accessors", {"componentType", "count", "type"});
  require_in_each(root, "bufferViews", {"buffer", "byteLength"});
  require_in_each(root, "buffers", {"byteLength"});
  require_in_each(root, "skins", {"joints"});
  require_in_each(root, "animations", {"channels", "samplers"});
  require_in_each(root, "meshes", {"primitives"});
  require_in_each(root, "cameras", {"type"});
  check_primitives(root);
  check_cameras_and_lights(root);
}

}  // namespace etendue::scene::gltf
