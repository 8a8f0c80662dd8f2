#include "scene/gltf/export/output_file.h"

#include <charconv>
#include <cstring>
#include <limits>

namespace etendue::scene::gltf {

int OutputFile::add(const char* array, Json object) {
  root[array].push_back(std::move(object));
  return static_cast<int>(root[array].size()) - 1;
}

int OutputFile::view(std::span<const std::byte> bytes, int target) {
  binary.resize((binary.size() + 3) / 4 * 4);
  Json view{{"buffer", 0}, {"byteOffset", binary.size()}, {"byteLength", bytes.size()}};
  if (target) view["target"] = target;
  binary.insert(binary.end(), bytes.begin(), bytes.end());
  return add("bufferViews", std::move(view));
}

int OutputFile::accessor(std::span<const std::byte> bytes, int component_type, const char* type, size_t count,
                         int target) {
  Json a{{"componentType", component_type}, {"type", type}, {"count", count}};
  if (count > 0) a["bufferView"] = view(bytes, target);
  return add("accessors", std::move(a));
}

int OutputFile::floats(const std::vector<float>& values) {
  return accessor(values, TINYGLTF_COMPONENT_TYPE_FLOAT, "SCALAR");
}

Json& OutputFile::extend(Json& object, const char* extension) {
  extensions.insert(extension);
  Json& added = object["extensions"][extension];
  if (added.is_null()) added = Json::object();
  return added;
}

Json number(float value) {
  std::array<char, 32> text;
  const char* end = std::to_chars(text.data(), text.data() + text.size(), value).ptr;
  double exact = 0;
  std::from_chars(text.data(), end, exact);
  // The largest float rounds up in decimal, which readers reject as out of range.
  const bool is_exact =
      static_cast<float>(exact) == value && std::abs(exact) <= double{std::numeric_limits<float>::max()};
  return is_exact ? exact : static_cast<double>(value);
}

Json numbers(std::span<const float> values) {
  Json array = Json::array();
  for (const float v : values) array.push_back(number(v));
  return array;
}

Json vector(const Rgb& color) { return vector(Vec3(color[0], color[1], color[2])); }

void put(Json& object, const char* member, float value, float default_value) {
  if (value != default_value) object[member] = number(value);
}

void put_name(Json& object, const std::string& name) {
  if (!name.empty()) object["name"] = name;
}

}  // namespace etendue::scene::gltf
