#include "scene/gltf/save_gltf.h"

#include <cstring>
#include <limits>

#include "base/file.h"
#include "scene/gltf/export/output_file.h"

namespace etendue::scene {
namespace {

using gltf::Json;
using gltf::OutputFile;
namespace fs = std::filesystem;

// Percent-encodes all characters that RFC 3986 does not allow in a path segment.
std::string escaped(const std::string& name) {
  static constexpr const char* kDigits = "0123456789ABCDEF";
  std::string uri;
  for (const char c : name) {
    const auto byte = static_cast<unsigned char>(c);
    const bool plain = std::isalnum(byte) || c == '-' || c == '_' || c == '.' || c == '~';
    if (plain)
      uri += c;
    else
      uri += {'%', kDigits[byte >> 4], kDigits[byte & 15]};
  }
  return uri;
}

void append_word(std::vector<std::byte>& bytes, uint64_t value) {
  const auto word = static_cast<uint32_t>(value);
  const auto* first = reinterpret_cast<const std::byte*>(&word);
  bytes.insert(bytes.end(), first, first + sizeof word);
}

class Saver {
 public:
  Saver(const Scene& scene, const fs::path& path) : path_(path), out_(scene) {}

  Result<void> run() {
    const bool binary = path_.extension() == ".glb";
    if (!binary && path_.extension() != ".gltf")
      return usage_error(path_.string() + ": the file name has to end in .glb or .gltf");
    make_json();
    if (binary) return write_binary();
    return write_text();
  }
  std::vector<std::string>& warnings() { return out_.warnings; }

 private:
  void make_json() {
    out_.root["asset"] = {{"version", "2.0"}, {"generator", "Étendue"}};
    out_.folder = path_.parent_path();
    gltf::export_textures(out_);
    gltf::export_materials(out_);
    gltf::export_meshes(out_);
    gltf::export_cameras_and_lights(out_, path_.parent_path());
    gltf::export_nodes(out_);
    gltf::export_skins(out_);
    gltf::export_animations(out_);
    gltf::export_transport(out_, out_.folder);
    if (!out_.extensions.empty()) out_.root["extensionsUsed"] = out_.extensions;
  }

  std::string text() const { return out_.root.dump(-1, ' ', false, Json::error_handler_t::replace); }

  Result<void> write_binary() {
    for (auto& image : out_.images) {
      const int view = out_.view(image);
      out_.add("images", {{"bufferView", view}, {"mimeType", "image/png"}});
      image = {};
    }
    out_.binary.resize((out_.binary.size() + 3) / 4 * 4);
    if (!out_.binary.empty()) out_.root["buffers"] = Json::array({{{"byteLength", out_.binary.size()}}});
    std::string json = text();
    json.resize((json.size() + 3) / 4 * 4, ' ');
    const uint64_t length = 12 + 8 + json.size() + (out_.binary.empty() ? 0 : 8 + out_.binary.size());
    if (length > std::numeric_limits<uint32_t>::max())
      return output_error(path_.string() + ": a .glb file is limited to 4 GiB; save a .gltf file instead");
    return write_file(path_, chunks(json, length));
  }

  std::vector<std::byte> chunks(const std::string& json, uint64_t length) const {
    constexpr uint32_t kMagic = 0x46546c67, kJson = 0x4e4f534a, kBinary = 0x004e4942;
    std::vector<std::byte> file;
    file.reserve(length);
    append_word(file, kMagic);
    append_word(file, 2);
    append_word(file, length);
    append_word(file, json.size());
    append_word(file, kJson);
    const auto* first = reinterpret_cast<const std::byte*>(json.data());
    file.insert(file.end(), first, first + json.size());
    if (out_.binary.empty()) return file;
    append_word(file, out_.binary.size());
    append_word(file, kBinary);
    file.insert(file.end(), out_.binary.begin(), out_.binary.end());
    return file;
  }

  Result<void> write_text() {
    const std::string stem = path_.stem().string();
    for (size_t i = 0; i < out_.images.size(); ++i) {
      const std::string name = stem + "-" + std::to_string(i) + ".png";
      out_.add("images", {{"uri", escaped(name)}});
      if (auto r = write_file(path_.parent_path() / name, out_.images[i]); !r) return r;
    }
    if (!out_.binary.empty()) {
      const std::string name = stem + ".bin";
      out_.root["buffers"] = Json::array({{{"byteLength", out_.binary.size()}, {"uri", escaped(name)}}});
      if (auto r = write_file(path_.parent_path() / name, out_.binary); !r) return r;
    }
    const std::string json = out_.root.dump(1, ' ', false, Json::error_handler_t::replace) + "\n";
    return etendue::write_file(path_, json.data(), json.size());
  }

  static Result<void> write_file(const fs::path& path, const std::vector<std::byte>& bytes) {
    return etendue::write_file(path, bytes.data(), bytes.size());
  }

  fs::path path_;
  OutputFile out_;
};

}  // namespace

Result<void> save_gltf(const Scene& scene, const fs::path& path, std::vector<std::string>* warnings) {
  try {
    Saver saver(scene, path);
    auto saved = saver.run();
    if (saved && warnings) *warnings = std::move(saver.warnings());
    return saved;
  } catch (const gltf::FileError& error) {
    return output_error(path.string() + ": " + error.message);
  } catch (const std::bad_alloc&) {
    return output_error(path.string() + ": not enough memory to save the file");
  }
}

}  // namespace etendue::scene
