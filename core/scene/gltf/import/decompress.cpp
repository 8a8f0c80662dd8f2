#include "scene/gltf/import/decompress.h"

#include <map>

#include "scene/gltf/import/draco_decoder.h"
#include "scene/gltf/import/meshopt_decoder.h"
#include "scene/gltf/parallel_jobs.h"

namespace etendue::scene::gltf {
namespace {

using nlohmann::json;

constexpr const char *kDraco = "KHR_draco_mesh_compression", *kMeshopt = "EXT_meshopt_compression";

// An extension of a JSON object, or null.
json* extension_in(json& object, const char* name) {
  const auto extensions = object.find("extensions");
  if (extensions == object.end()) return nullptr;
  const auto found = extensions->find(name);
  return found == extensions->end() ? nullptr : &*found;
}

size_t size_of(const json& root, const char* array) { return root.contains(array) ? root[array].size() : 0; }

Bytes slice(const InputFile& input, uint64_t buffer, uint64_t offset, uint64_t length, const std::string& where) {
  if (buffer >= input.buffers.size())
    fail(where, "refers to buffers[" + std::to_string(buffer) + "], which does not exist; the file has " +
                    std::to_string(input.buffers.size()));
  const Buffer& from = input.buffers[buffer];
  const std::string name = "buffers[" + std::to_string(buffer) + "]";
  if (!from.problem.empty()) fail(where, name + " " + from.problem);
  if (offset > from.bytes.size() || length > from.bytes.size() - offset)
    fail(where, "ends at byte " + std::to_string(offset + length) + ", but " + name + " has " +
                    std::to_string(from.bytes.size()));
  return from.bytes.subspan(offset, length);
}

// Adds a buffer with these bytes; returns its index.
size_t add_buffer(InputFile& input, std::vector<std::byte> bytes) {
  input.storage.push_back(std::move(bytes));
  input.buffers.push_back({input.storage.back(), "", false});
  return input.buffers.size() - 1;
}

std::vector<std::byte> as_bytes(const std::vector<uint32_t>& values) {
  const auto bytes = std::as_bytes(std::span(values));
  return {bytes.begin(), bytes.end()};
}

class MeshoptViews {
 public:
  MeshoptViews(json& root, InputFile& input) : root_(root), input_(input) {
    for (size_t v = 0; v < size_of(root, "bufferViews"); ++v) {
      json* extension = extension_in(root["bufferViews"][v], kMeshopt);
      if (!extension || has_plain_bytes(root["bufferViews"][v])) continue;
      const std::string where = at("bufferViews", v) + ".extensions." + kMeshopt;
      Task task{v, where, read_meshopt_view(*extension, where), {}, {}};
      task.in = slice(input, task.description.buffer, task.description.offset, task.description.length, where);
      tasks_.push_back(std::move(task));
    }
  }

  size_t size() const { return tasks_.size(); }
  void run(size_t i) { tasks_[i].out = decode_meshopt(input_, tasks_[i].description, tasks_[i].in, tasks_[i].where); }
  void place() {
    for (Task& task : tasks_) {
      json& view = root_["bufferViews"][task.view];
      const size_t length = task.out.size();
      if (view["byteLength"] != length)
        input_.warnings.push_back(at("bufferViews", task.view) + ": declares " + view["byteLength"].dump() +
                                  " bytes, but the decompressed size is " + std::to_string(length));
      view["buffer"] = add_buffer(input_, std::move(task.out));
      view["byteOffset"] = 0;
      view["byteLength"] = length;
    }
  }

 private:
  struct Task {
    size_t view;
    std::string where;
    MeshoptView description;
    Bytes in;
    std::vector<std::byte> out;
  };

  bool has_plain_bytes(const json& view) const {
    const auto buffer = view["buffer"].get<size_t>();
    return buffer < input_.buffers.size() && input_.buffers[buffer].problem.empty();
  }

  json& root_;
  InputFile& input_;
  std::vector<Task> tasks_;
};

class DracoPrimitives {
 public:
  DracoPrimitives(json& root, InputFile& input) : root_(root), input_(input) {
    for (size_t m = 0; m < size_of(root, "meshes"); ++m) {
      json& primitives = root["meshes"][m]["primitives"];
      for (size_t p = 0; p < primitives.size(); ++p)
        if (json* extension = extension_in(primitives[p], kDraco))
          add(primitives[p], *extension, at("meshes", m) + "." + at("primitives", p));
    }
  }

  size_t size() const { return tasks_.size(); }
  void run(size_t i) {
    Task& task = tasks_[i];
    task.mesh = decode_draco(input_, task.in, task.attributes, task.where);
  }
  void place() {
    for (Task& task : tasks_) {
      const int indices = add_accessor(as_bytes(task.mesh.indices), 0,
                                       {{"componentType", TINYGLTF_COMPONENT_TYPE_UNSIGNED_INT},
                                        {"type", "SCALAR"},
                                        {"count", task.mesh.indices.size()}});
      std::map<std::string, int> attributes;
      for (DracoAttribute& a : task.attributes) attributes[a.name] = add_decoded(*task.users.front(), task, a);
      for (json* primitive : task.users) {
        for (const auto& [name, accessor] : attributes) (*primitive)["attributes"][name] = accessor;
        (*primitive)["indices"] = indices;
        (*primitive)["mode"] = TINYGLTF_MODE_TRIANGLES;
      }
    }
  }

 private:
  struct Task {
    std::string where;
    Bytes in;
    std::vector<DracoAttribute> attributes;
    std::vector<json*> users;
    DracoMesh mesh = {};
  };

  const json& accessor_of(const json& index, const std::string& where) const {
    return root_["accessors"][checked_index(index.get<int>(), size_of(root_, "accessors"), where, "accessors")];
  }

  // Whether the file lacks an uncompressed copy of the indices or of an attribute.
  bool needs_decoding(const json& primitive, const json& attributes, const std::string& where) const {
    const auto missing = [&](const json& index) { return !accessor_of(index, where).contains("bufferView"); };
    if (primitive.contains("indices") && missing(primitive["indices"])) return true;
    for (const auto& item : attributes.items())
      if (primitive["attributes"].contains(item.key()) && missing(primitive["attributes"][item.key()])) return true;
    return false;
  }

  void add(json& primitive, const json& extension, const std::string& at_primitive) {
    const std::string where = at_primitive + ".extensions." + kDraco;
    if (!extension.contains("bufferView") || !extension.contains("attributes"))
      fail(where, "has to have bufferView and attributes");
    const json& compressed = extension["attributes"];
    if (!needs_decoding(primitive, compressed, where)) return;
    // Primitives that differ only in their material share one decoded mesh.
    const auto [known, added] =
        known_.try_emplace({extension["bufferView"].get<int>(), compressed, primitive["attributes"]}, tasks_.size());
    if (!added) return tasks_[known->second].users.push_back(&primitive);
    const size_t v =
        checked_index(extension["bufferView"].get<int>(), size_of(root_, "bufferViews"), where, "bufferViews");
    const json& view = root_["bufferViews"][v];
    Task task{where, {}, {}, {&primitive}};
    task.in = slice(input_, view["buffer"].get<uint64_t>(), view.value("byteOffset", uint64_t{0}),
                    view["byteLength"].get<uint64_t>(), where);
    for (const auto& item : compressed.items())
      if (primitive["attributes"].contains(item.key()))
        task.attributes.push_back(describe(item.key(), item.value().get<uint32_t>(), primitive, where));
    tasks_.push_back(std::move(task));
  }

  DracoAttribute describe(const std::string& name, uint32_t id, const json& primitive, const std::string& where) const {
    static const std::map<std::string, int> kComponents{{"SCALAR", 1}, {"VEC2", 2}, {"VEC3", 3}, {"VEC4", 4}};
    const std::string place = where + ".attributes." + name;
    const json& accessor = accessor_of(primitive["attributes"][name], place);
    DracoAttribute attribute;
    attribute.name = name;
    attribute.id = id;
    attribute.component_type = accessor["componentType"].get<int>();
    const auto components =
        accessor["type"].is_string() ? kComponents.find(accessor["type"].get<std::string>()) : kComponents.end();
    if (components == kComponents.end() ||
        tinygltf::GetComponentSizeInBytes(static_cast<uint32_t>(attribute.component_type)) < 1)
      fail(place, "its accessor has a type that vertex attributes cannot have");
    attribute.components = components->second;
    return attribute;
  }

  // An accessor for the decoded attribute; it copies all other members of the one in the file.
  int add_decoded(const json& primitive, const Task& task, DracoAttribute& attribute) {
    json accessor = accessor_of(primitive["attributes"][attribute.name], task.where);
    if (accessor["count"] != task.mesh.vertices)
      input_.warnings.push_back(task.where + ".attributes." + attribute.name + ": the accessor declares " +
                                accessor["count"].dump() + " elements, but the decoded mesh has " +
                                std::to_string(task.mesh.vertices));
    accessor["count"] = task.mesh.vertices;
    accessor.erase("sparse");
    accessor.erase("byteOffset");
    return add_accessor(std::move(attribute.values), attribute.stride, std::move(accessor));
  }

  int add_accessor(std::vector<std::byte> bytes, size_t stride, json accessor) {
    json view{{"byteOffset", 0}, {"byteLength", bytes.size()}};
    if (stride > 0) view["byteStride"] = stride;
    view["buffer"] = add_buffer(input_, std::move(bytes));
    root_["bufferViews"].push_back(std::move(view));
    accessor["bufferView"] = root_["bufferViews"].size() - 1;
    root_["accessors"].push_back(std::move(accessor));
    return static_cast<int>(root_["accessors"].size()) - 1;
  }

  json& root_;
  InputFile& input_;
  std::vector<Task> tasks_;
  std::map<std::tuple<int, json, json>, size_t> known_;
};

}  // namespace

void decompress(json& root, InputFile& input, const std::function<bool(float)>& progress) {
  // A compressed buffer view may hold a compressed mesh, so buffer views come first.
  MeshoptViews views(root, input);
  run_jobs(
      views.size(), [&](size_t i) { views.run(i); }, progress);
  views.place();
  DracoPrimitives primitives(root, input);
  run_jobs(
      primitives.size(), [&](size_t i) { primitives.run(i); }, progress);
  primitives.place();
}

}  // namespace etendue::scene::gltf
