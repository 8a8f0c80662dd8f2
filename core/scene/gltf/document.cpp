#include "scene/gltf/document.h"

#include <set>

#include "base/file.h"
#include "scene/gltf/compressed.h"
#include "scene/gltf/container.h"
#include "scene/gltf/json.h"
#include "scene/gltf/uri.h"

namespace etendue::scene::gltf {
namespace {

using nlohmann::json;

// What a file may ask for beyond its own size: quantised attributes grow fourfold and primitives share vertices.
constexpr uint64_t kClaimsPerByte = 64, kFreeClaims = uint64_t{256} << 20;

std::string text_of(const json& object, const char* member) {
  const auto found = object.find(member);
  return found != object.end() && found->is_string() ? found->get<std::string>() : std::string();
}

// The name of the file is not repeated in what is said about it.
std::string without_path(const std::string& message, const std::filesystem::path& path) {
  const std::string prefix = path.string() + ": ";
  return message.starts_with(prefix) ? message.substr(prefix.size()) : message;
}

Buffer keep(Document& document, std::vector<std::byte> bytes) {
  document.storage.push_back(std::move(bytes));
  return {document.storage.back(), "", false};
}

bool is_placeholder(const json& buffer) {
  const json::json_pointer place("/extensions/EXT_meshopt_compression/fallback");
  return buffer.contains(place) && buffer[place] == true;
}

Buffer find_buffer(Document& document, const json& description, size_t index, const Container& container) {
  const std::string uri = text_of(description, "uri");
  if (!description.contains("uri")) {
    if (is_placeholder(description)) return {{}, "is a placeholder for what is compressed", true};
    if (index == 0 && container.has_binary) return {container.binary, "", false};
    return {{}, "has no uri, and the file has no binary chunk for it", false};
  }
  if (is_data_uri(uri)) {
    auto bytes = decode_data_uri(uri);
    if (!bytes) return {{}, "its data URI is malformed; base64 is needed", false};
    return keep(document, std::move(*bytes));
  }
  const auto file = file_of_uri(document.folder, uri);
  if (!file) return {{}, "its uri '" + shown_uri(uri) + "' names no local file", false};
  auto bytes = read_file(*file);
  if (!bytes)
    return {
        {}, "its file '" + shown_uri(uri) + "' cannot be had: " + without_path(bytes.error().message, *file), false};
  return keep(document, std::move(*bytes));
}

void open_buffers(const json& root, const Container& container, Document& document) {
  if (!root.contains("buffers")) return;
  for (size_t i = 0; i < root["buffers"].size(); ++i) {
    Buffer buffer = find_buffer(document, root["buffers"][i], i, container);
    const auto declared = root["buffers"][i]["byteLength"].get<uint64_t>();
    // Padding and lies of too much are cut off, and lies of too little found when something reaches too far.
    if (buffer.problem.empty() && buffer.bytes.size() < declared)
      document.warnings.push_back(at("buffers", i) + ": declares " + std::to_string(declared) +
                                  " bytes, but there are " + std::to_string(buffer.bytes.size()));
    if (buffer.bytes.size() > declared) buffer.bytes = buffer.bytes.first(declared);
    document.buffers.push_back(std::move(buffer));
  }
}

void open_images(const json& root, Document& document) {
  if (!root.contains("images")) return;
  for (const json& description : root["images"]) {
    ImageSource image{text_of(description, "name"), text_of(description, "uri"), -1};
    if (description.contains("bufferView")) image.view = description["bufferView"].get<int>();
    document.images.push_back(std::move(image));
  }
}

std::string one_line(const std::string& text) {
  const size_t first = text.find_first_not_of(" \r\n");
  if (first == std::string::npos) return "it is no glTF that the parser knows";
  return text.substr(first, std::min<size_t>(text.find_first_of("\r\n", first) - first, 300));
}

void parse_model(json&& root, Document& document) {
  root.erase("buffers");
  root.erase("images");
  const std::string text = root.dump(-1, ' ', false, json::error_handler_t::replace);
  root = nullptr;
  tinygltf::TinyGLTF parser;
  std::string error, warning;
  bool parsed = false;
  try {
    parsed = parser.LoadASCIIFromString(&document.model, &error, &warning, text.data(),
                                        static_cast<unsigned>(text.size()), "");
  } catch (const std::exception& thrown) {
    error = thrown.what();
  }
  if (!parsed) throw Unusable{"the structure cannot be read: " + one_line(error)};
}

}  // namespace

bool is_supported(const std::string& extension) {
  static const std::set<std::string> kSupported{"KHR_materials_emissive_strength",
                                                "KHR_lights_punctual",
                                                "KHR_texture_transform",
                                                "KHR_materials_unlit",
                                                "KHR_materials_ior",
                                                "KHR_mesh_quantization",
                                                "KHR_materials_transmission",
                                                "KHR_materials_volume",
                                                "KHR_materials_specular",
                                                "KHR_materials_anisotropy",
                                                "KHR_materials_clearcoat",
                                                "KHR_materials_sheen",
                                                "KHR_materials_iridescence",
                                                "KHR_materials_diffuse_transmission",
                                                "KHR_materials_pbrSpecularGlossiness",
                                                "KHR_materials_variants",
                                                "KHR_draco_mesh_compression",
                                                "EXT_meshopt_compression",
                                                "EXT_mesh_gpu_instancing",
                                                "KHR_node_visibility",
                                                kTransport,
                                                "EXT_texture_webp"};
  return kSupported.contains(extension);
}

void open_document(const std::filesystem::path& path, Document& document, const std::function<bool(float)>& progress) {
  auto file = read_file(path);
  if (!file) throw Unusable{without_path(file.error().message, path)};
  if (file->empty()) throw Unusable{"the file is empty; give a .gltf or .glb file"};
  document.folder = path.parent_path();
  const Container container = split_container(*file, document.warnings);
  json root = parse_json(container.json, document.warnings);
  check_asset(root);
  check_structure(root);
  open_buffers(root, container, document);
  open_images(root, document);
  decompress(root, document, progress);
  check_index_accessors(root);
  parse_model(std::move(root), document);
  // Moving keeps the bytes where they are.
  if (container.has_binary) document.storage.push_back(std::move(*file));
}

void claim(const Document& document, uint64_t bytes, const std::string& where) {
  uint64_t available = 0;
  for (const Buffer& buffer : document.buffers) available += buffer.bytes.size();
  const uint64_t most = available * kClaimsPerByte + kFreeClaims;
  if (bytes > most || document.claimed.fetch_add(bytes) > most - bytes)
    fail(where, "would need more than " + std::to_string(most >> 20) +
                    " MiB together with what was read before, from buffers of " + std::to_string(available) +
                    " bytes; the counts cannot be meant");
}

ViewBytes view_bytes(const Document& document, int index) {
  const std::string name = "bufferView " + std::to_string(index);
  if (index < 0 || static_cast<size_t>(index) >= document.model.bufferViews.size())
    return {{}, name + " does not exist; there are " + std::to_string(document.model.bufferViews.size())};
  const auto& view = document.model.bufferViews[static_cast<size_t>(index)];
  const std::string buffer_name = "buffer " + std::to_string(view.buffer);
  if (view.buffer < 0 || static_cast<size_t>(view.buffer) >= document.buffers.size())
    return {{},
            name + " lies in " + buffer_name + ", which does not exist; there are " +
                std::to_string(document.buffers.size())};
  const Buffer& buffer = document.buffers[static_cast<size_t>(view.buffer)];
  if (!buffer.problem.empty()) return {{}, "buffers[" + std::to_string(view.buffer) + "] " + buffer.problem};
  const uint64_t size = buffer.bytes.size();
  if (view.byteOffset > size || view.byteLength > size - view.byteOffset)
    return {{},
            name + " ends at byte " + std::to_string(view.byteOffset + view.byteLength) + ", but " + buffer_name +
                " has " + std::to_string(size)};
  return {buffer.bytes.subspan(view.byteOffset, view.byteLength), ""};
}

std::string image_name(const Document& document, size_t image) {
  const ImageSource& source = document.images[image];
  const std::string name = source.uri.empty() ? source.name : shown_uri(source.uri);
  return at("images", image) + (name.empty() ? "" : " '" + name + "'");
}

ImageBytes read_image(const Document& document, size_t image) {
  const ImageSource& source = document.images[image];
  ImageBytes result;
  const auto own = [&](std::vector<std::byte> bytes) {
    result.owned = std::move(bytes);
    result.bytes = result.owned;
  };
  if (source.view >= 0) {
    const ViewBytes view = view_bytes(document, source.view);
    result.bytes = view.bytes, result.problem = view.problem;
  } else if (is_data_uri(source.uri)) {
    auto bytes = decode_data_uri(source.uri);
    if (!bytes) return result.problem = "its data URI is malformed", result;
    own(std::move(*bytes));
  } else if (source.uri.empty()) {
    result.problem = "has neither uri nor bufferView";
  } else {
    const auto file = file_of_uri(document.folder, source.uri);
    if (!file) return result.problem = "its uri names no local file", result;
    auto bytes = read_file(*file);
    if (!bytes) return result.problem = without_path(bytes.error().message, *file), result;
    own(std::move(*bytes));
  }
  return result;
}

}  // namespace etendue::scene::gltf
