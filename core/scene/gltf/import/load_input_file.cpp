#include "scene/gltf/import/input_file.h"

#include <set>

#include "base/file.h"
#include "base/json_text.h"
#include "scene/gltf/import/container.h"
#include "scene/gltf/import/decompress.h"
#include "scene/gltf/import/json_check.h"
#include "scene/gltf/import/plain_nodes.h"
#include "scene/gltf/import/uri.h"
#include "scene/gltf/transport_extension.h"

namespace etendue::scene::gltf {
namespace {

using nlohmann::json;

// Limit of the memory for arrays: 256 MiB plus 64 bytes for each byte of the buffers. Quantised attributes grow
// fourfold, and several primitives may use the same vertices.
constexpr uint64_t kBytesPerInputByte = 64, kFreeBytes = uint64_t{256} << 20;

std::string text_of(const json& object, const char* member) {
  const auto found = object.find(member);
  return found != object.end() && found->is_string() ? found->get<std::string>() : std::string();
}

// Removes the path from the front of a message about the file; load_gltf adds it once.
std::string without_path(const std::string& message, const std::filesystem::path& path) {
  const std::string prefix = path.string() + ": ";
  return message.starts_with(prefix) ? message.substr(prefix.size()) : message;
}

Buffer store(InputFile& input, std::vector<std::byte> bytes) {
  input.storage.push_back(std::move(bytes));
  return {input.storage.back(), "", false};
}

bool is_placeholder(const json& buffer) {
  const json::json_pointer place("/extensions/EXT_meshopt_compression/fallback");
  return buffer.contains(place) && buffer[place] == true;
}

Buffer find_buffer(InputFile& input, const json& description, size_t index, const Container& container) {
  const std::string uri = text_of(description, "uri");
  if (!description.contains("uri")) {
    if (is_placeholder(description)) return {{}, "is a placeholder for compressed data", true};
    if (index == 0 && container.has_binary) return {container.binary, "", false};
    return {{}, "has no uri, and the file has no binary chunk for it", false};
  }
  if (is_data_uri(uri)) {
    auto bytes = decode_data_uri(uri);
    if (!bytes) return {{}, "has a malformed data URI; it has to be base64", false};
    return store(input, std::move(*bytes));
  }
  const auto file = file_of_uri(input.folder, uri);
  if (!file) return {{}, "has the uri '" + shown_uri(uri) + "', which is not a local file", false};
  auto mapped = MappedFile::open(*file);
  if (!mapped)
    return {{}, "cannot be read from '" + shown_uri(uri) + "': " + without_path(mapped.error().message, *file), false};
  input.files.push_back(std::move(*mapped));
  return {input.files.back().bytes(), "", false};
}

void open_buffers(const json& root, const Container& container, InputFile& input) {
  if (!root.contains("buffers")) return;
  for (size_t i = 0; i < root["buffers"].size(); ++i) {
    Buffer buffer = find_buffer(input, root["buffers"][i], i, container);
    const auto declared = root["buffers"][i]["byteLength"].get<uint64_t>();
    // Bytes behind the declared length are padding. A length that is too small is reported for the view that exceeds
    // it.
    if (buffer.problem.empty() && buffer.bytes.size() < declared)
      input.warnings.push_back(at("buffers", i) + ": declares " + std::to_string(declared) + " bytes, but has " +
                               std::to_string(buffer.bytes.size()));
    if (buffer.bytes.size() > declared) buffer.bytes = buffer.bytes.first(declared);
    input.buffers.push_back(std::move(buffer));
  }
}

void open_images(const json& root, InputFile& input) {
  if (!root.contains("images")) return;
  for (const json& description : root["images"]) {
    ImageSource image{text_of(description, "name"), text_of(description, "uri"), -1};
    if (description.contains("bufferView")) image.view = description["bufferView"].get<int>();
    input.images.push_back(std::move(image));
  }
}

std::string one_line(const std::string& text) {
  const size_t first = text.find_first_not_of(" \r\n");
  if (first == std::string::npos) return "the parser gives no reason";
  return text.substr(first, std::min<size_t>(text.find_first_of("\r\n", first) - first, 300));
}

void parse_model(json&& root, InputFile& input) {
  root.erase("buffers");
  root.erase("images");
  PlainNodes plain_nodes(root);
  const std::string text = json_text(root);
  root = nullptr;
  tinygltf::TinyGLTF parser;
  std::string error, warning;
  bool parsed = false;
  try {
    parsed =
        parser.LoadASCIIFromString(&input.model, &error, &warning, text.data(), static_cast<unsigned>(text.size()), "");
  } catch (const std::exception& thrown) {
    error = thrown.what();
  }
  if (!parsed) throw FileError{"the structure cannot be read: " + one_line(error)};
  plain_nodes.add_to(input.model.nodes);
}

}  // namespace

bool is_supported(const std::string& extension) {
  static const std::set<std::string> kSupported{"KHR_materials_emissive_strength",
                                                "KHR_lights_punctual",
                                                "KHR_texture_transform",
                                                "KHR_materials_unlit",
                                                "KHR_materials_ior",
                                                "KHR_materials_dispersion",
                                                "KHR_mesh_quantization",
                                                "KHR_materials_transmission",
                                                "KHR_materials_volume",
                                                "KHR_materials_volume_scatter",
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

void open_input_file(const std::filesystem::path& path, InputFile& input, const std::function<bool(float)>& progress) {
  const auto file = MappedFile::open(path);
  if (!file) throw FileError{without_path(file.error().message, path)};
  if (file->bytes().empty()) throw FileError{"the file is empty; it has to be a .gltf or .glb file"};
  input.folder = path.parent_path();
  const Container container = split_container(file->bytes(), input.warnings);
  json root = parse_json(container.json, input.warnings);
  check_asset(root);
  check_structure(root);
  open_buffers(root, container, input);
  open_images(root, input);
  decompress(root, input, progress);
  check_index_accessors(root);
  parse_model(std::move(root), input);
  if (container.has_binary) input.files.push_back(*file);
}

void check_files(const InputFile& input) {
  for (const MappedFile& file : input.files)
    if (file.is_damaged()) throw FileError{"a file became shorter while it was read; load it again"};
}

void check_memory(const InputFile& input, uint64_t bytes, const std::string& where) {
  uint64_t available = 0;
  for (const Buffer& buffer : input.buffers) available += buffer.bytes.size();
  const uint64_t most = available * kBytesPerInputByte + kFreeBytes;
  if (bytes > most || input.planned_bytes.fetch_add(bytes) > most - bytes)
    fail(where, "needs more than " + std::to_string(most >> 20) +
                    " MiB together with all earlier arrays, but the buffers have only " + std::to_string(available) +
                    " bytes; the count of an accessor must be wrong");
}

ViewBytes view_bytes(const InputFile& input, int index) {
  const std::string name = "bufferView " + std::to_string(index);
  if (index < 0 || static_cast<size_t>(index) >= input.model.bufferViews.size())
    return {{}, name + " does not exist; the file has " + std::to_string(input.model.bufferViews.size())};
  const auto& view = input.model.bufferViews[static_cast<size_t>(index)];
  const std::string buffer_name = "buffer " + std::to_string(view.buffer);
  if (view.buffer < 0 || static_cast<size_t>(view.buffer) >= input.buffers.size())
    return {{},
            name + " refers to " + buffer_name + ", which does not exist; the file has " +
                std::to_string(input.buffers.size())};
  const Buffer& buffer = input.buffers[static_cast<size_t>(view.buffer)];
  if (!buffer.problem.empty()) return {{}, "buffers[" + std::to_string(view.buffer) + "] " + buffer.problem};
  const uint64_t size = buffer.bytes.size();
  if (view.byteOffset > size || view.byteLength > size - view.byteOffset)
    return {{},
            name + " ends at byte " + std::to_string(view.byteOffset + view.byteLength) + ", but " + buffer_name +
                " has " + std::to_string(size)};
  return {buffer.bytes.subspan(view.byteOffset, view.byteLength), ""};
}

std::string image_name(const InputFile& input, size_t image) {
  const ImageSource& source = input.images[image];
  const std::string name = source.uri.empty() ? source.name : shown_uri(source.uri);
  return at("images", image) + (name.empty() ? "" : " '" + name + "'");
}

ImageBytes read_image(const InputFile& input, size_t image) {
  const ImageSource& source = input.images[image];
  ImageBytes result;
  const auto take_ownership = [&](std::vector<std::byte> bytes) {
    result.owned = std::move(bytes);
    result.bytes = result.owned;
  };
  if (source.view >= 0) {
    const ViewBytes view = view_bytes(input, source.view);
    result.bytes = view.bytes;
    result.problem = view.problem;
  } else if (is_data_uri(source.uri)) {
    auto bytes = decode_data_uri(source.uri);
    if (!bytes) {
      result.problem = "has a malformed data URI";
      return result;
    }
    take_ownership(std::move(*bytes));
  } else if (source.uri.empty()) {
    result.problem = "has neither uri nor bufferView";
  } else {
    const auto file = file_of_uri(input.folder, source.uri);
    if (!file) {
      result.problem = "has a uri that is not a local file";
      return result;
    }
    auto bytes = read_file(*file);
    if (!bytes) {
      result.problem = without_path(bytes.error().message, *file);
      return result;
    }
    take_ownership(std::move(*bytes));
  }
  return result;
}

}  // namespace etendue::scene::gltf
