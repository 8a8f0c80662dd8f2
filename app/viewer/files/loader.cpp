#include "viewer/files/loader.h"

#include <cctype>
#include <filesystem>

#include "image/image.h"
#include "render/image_output.h"

namespace etendue::viewer {
namespace {

std::string extension_of(const std::string& file) {
  std::string extension = std::filesystem::path(file).extension().string();
  for (char& c : extension) c = static_cast<char>(std::tolower(static_cast<unsigned char>(c)));
  return extension;
}

Result<Opened> environment(const std::string& file, const render::Document& current) {
  if (!current.scene)
    return usage_error(file + ": is a picture, and there is no scene that it could light; open a .gltf or .glb first");
  auto lit = render::with_environment(current, file);
  if (!lit) return lit.error();
  return Opened{Opened::Kind::environment, file, std::move(*lit)};
}

Result<Opened> read(const std::string& file, const render::Document& current) {
  const std::string extension = extension_of(file);
  if (extension == ".hdr") return environment(file, current);
  if (extension == ".exr") {
    const auto picture = image::read_exr(file);
    if (!picture) return picture.error();
    const auto state = picture->attributes.find(render::kStateAttribute);
    if (state == picture->attributes.end()) return environment(file, current);
    auto document = render::document_from_state(state->second, file);
    if (!document) return document.error();
    return Opened{Opened::Kind::snapshot, file, std::move(*document)};
  }
  auto document = render::new_document(file);
  if (!document) return document.error();
  return Opened{Opened::Kind::scene, file, std::move(*document)};
}

}  // namespace

void Loader::open(const std::string& file, const render::Document& current) {
  job_.abandon();
  file_ = file;
  started_ = std::chrono::steady_clock::now();
  job_.start([file, current] { return read(file, current); });
}

double Loader::seconds() const {
  return std::chrono::duration<double>(std::chrono::steady_clock::now() - started_).count();
}

}  // namespace etendue::viewer
