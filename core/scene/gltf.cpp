#include "scene/gltf.h"

#include <cstring>
#include <nlohmann/json.hpp>

#include "base/file.h"
#include "scene/gltf_document.h"

namespace etendue::scene {
namespace {

using gltf::Document;
using gltf::Unusable;

// tinygltf asks for pictures here. Those in a buffer are only noted, because nobody has checked yet where they lie; those from
// files and data URIs come with their bytes.
bool keep_image(tinygltf::Image* image, int index, std::string*, std::string*, int, int, const unsigned char* bytes, int size, void* user) {
  if (image->bufferView >= 0 || index < 0 || size <= 0) return true;
  auto& files = static_cast<Document*>(user)->image_files;
  if (files.size() <= static_cast<size_t>(index)) files.resize(static_cast<size_t>(index) + 1);
  files[static_cast<size_t>(index)].assign(bytes, bytes + size);
  return true;
}

bool file_exists(const std::string& name, void*) {
  std::error_code code;
  return std::filesystem::is_regular_file(name, code);
}

std::string unexpanded(const std::string& name, void*) { return name; }

bool read_whole(std::vector<unsigned char>* out, std::string* error, const std::string& name, void*) {
  const auto bytes = read_file(name);
  if (!bytes) return *error += bytes.error().message + "\n", false;
  const auto* data = reinterpret_cast<const unsigned char*>(bytes->data());
  out->assign(data, data + bytes->size());
  return true;
}

// The library writes paragraphs; people get a line.
std::string one_line(const std::string& text) {
  std::string line;
  for (const char c : text) {
    if (c != '\n' && c != '\r') line += c;
    if (c == '\n' && !line.empty()) break;
  }
  return line.empty() ? "it is no glTF" : line.substr(0, 300);
}

uint32_t word_at(const std::vector<std::byte>& bytes, size_t at) {
  uint32_t word;
  std::memcpy(&word, bytes.data() + at, sizeof word);
  return word;
}

bool is_glb(const std::vector<std::byte>& bytes) { return bytes.size() >= 4 && std::memcmp(bytes.data(), "glTF", 4) == 0; }

// Whether the strings under `key` name an extension for which `unusable` holds; throws it.
template <class Test>
void check_extensions(const nlohmann::json& json, const char* key, Test&& unusable) {
  if (!json.is_object() || !json.contains(key) || !json[key].is_array()) return;
  for (const auto& extension : json[key])
    if (extension.is_string() && unusable(extension.template get<std::string>()))
      throw Unusable{"requires the extension " + extension.template get<std::string>() + ", which is not supported"};
}

// What the library stumbles over is often an extension that the file needs: that is what people have to be told. Compressed
// geometry is needed even where a file only says that it is used.
void check_required_extensions(const std::vector<std::byte>& bytes) {
  const char* text = reinterpret_cast<const char*>(bytes.data());
  size_t size = bytes.size();
  if (is_glb(bytes)) text += 20, size = word_at(bytes, 12);
  const auto json = nlohmann::json::parse(text, text + size, nullptr, false);
  check_extensions(json, "extensionsRequired", [](const std::string& name) { return !gltf::is_supported(name); });
  check_extensions(json, "extensionsUsed", [](const std::string& name) { return name.ends_with("_compression"); });
}

// The header and the chunk lengths of a GLB have to agree with the file.                               section 4.4
void check_glb(const std::vector<std::byte>& bytes) {
  if (bytes.size() < 20) throw Unusable{"is a GLB of " + std::to_string(bytes.size()) + " bytes; a header and a chunk need 20"};
  if (word_at(bytes, 4) != 2) throw Unusable{"is a GLB of version " + std::to_string(word_at(bytes, 4)) + "; version 2 can be read"};
  const uint64_t length = word_at(bytes, 8);
  if (length > bytes.size()) throw Unusable{"is truncated: its header says " + std::to_string(length) + " bytes, the file has " + std::to_string(bytes.size())};
  for (uint64_t at = 12; at + 8 <= length;) {
    const uint64_t chunk = word_at(bytes, at);
    if (chunk > length - at - 8) throw Unusable{"has a chunk at byte " + std::to_string(at) + " that claims " + std::to_string(chunk) + " bytes, beyond the end of the file"};
    at += 8 + chunk;
  }
}

void parse(const std::filesystem::path& path, Document& document) {
  auto bytes = read_file(path);
  if (!bytes) throw Unusable{bytes.error().message.substr(path.string().size() + 2)};
  if (bytes->empty()) throw Unusable{"is empty; give a .gltf or .glb file"};
  if (bytes->size() > UINT32_MAX) throw Unusable{"is larger than 4 GiB; split it"};
  tinygltf::TinyGLTF loader;
  loader.SetImageLoader(keep_image, &document);
  loader.SetFsCallbacks({file_exists, unexpanded, read_whole, nullptr, nullptr});
  std::string error, warning;
  const std::string folder = path.has_parent_path() ? path.parent_path().string() : ".";
  const auto size = static_cast<unsigned>(bytes->size());
  bool ok = false;
  try {
    if (is_glb(*bytes)) {
      check_glb(*bytes);
      ok = loader.LoadBinaryFromMemory(&document.model, &error, &warning, reinterpret_cast<const unsigned char*>(bytes->data()), size, folder);
    } else {
      ok = loader.LoadASCIIFromString(&document.model, &error, &warning, reinterpret_cast<const char*>(bytes->data()), size, folder);
    }
  } catch (const std::exception& thrown) {
    throw Unusable{"cannot be parsed: " + one_line(thrown.what())};
  }
  const std::string& version = document.model.asset.version;
  if (ok && (version.empty() || version[0] != '2')) throw Unusable{"is glTF version '" + version + "'; version 2 can be read"};
  if (ok && !document.model.asset.minVersion.empty() && document.model.asset.minVersion > "2.0")
    throw Unusable{"needs glTF " + document.model.asset.minVersion + "; version 2.0 can be read"};
  if (!ok) check_required_extensions(*bytes);
  if (!ok) throw Unusable{one_line(error)};
}

Scene import(const std::filesystem::path& path, const LoadOptions& options) {
  const auto progress = [&](const char* phase, float done) {
    if (options.progress && !options.progress(phase, done)) throw Unusable{"loading was cancelled"};
  };
  progress("reading", 0);
  Document document;
  parse(path, document);
  gltf::validate(document);

  Scene scene;
  scene.name = path.stem().string();
  scene.file = path.string();
  for (const auto& extension : document.model.extensionsUsed)
    if (!gltf::is_supported(extension)) scene.unsupported.push_back(extension);
  progress("decoding pictures", 0.1f);
  gltf::import_textures(document, scene);
  gltf::import_materials(document, scene);
  gltf::import_meshes(document, scene, [&](float done) { return !options.progress || options.progress("reading meshes", 0.5f + 0.5f * done); });
  gltf::import_lights(document, scene);
  gltf::import_cameras(document, scene);
  gltf::import_nodes(document, scene, options.scene);
  gltf::import_skins(document, scene);
  gltf::import_animations(document, scene);
  return scene;
}

}  // namespace

Result<Scene> load_gltf(const std::filesystem::path& path, const LoadOptions& options) {
  try {
    return import(path, options);
  } catch (const Unusable& unusable) {
    return input_error(path.string() + ": " + unusable.message);
  } catch (const std::bad_alloc&) {
    return input_error(path.string() + ": needs more memory than there is");
  }
}

}  // namespace etendue::scene
