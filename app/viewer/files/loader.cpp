#include "viewer/files/loader.h"

#include <algorithm>

#include "image/format.h"
#include "image/image.h"
#include "render/image_output.h"
#include "render/session_file.h"
#include "viewer/files/file_names.h"

namespace etendue::viewer {
namespace {

using Kind = OpenedFile::Kind;

Result<OpenedFile> read_environment(const std::string& file, const render::Document& current) {
  if (!current.scene)
    return usage_error(file + ": is an environment map, but no scene is open; open a .gltf or .glb file first");
  auto document = render::with_environment(current, file);
  if (!document) return document.error();
  return OpenedFile{.kind = Kind::environment, .file = file, .document = std::move(*document)};
}

bool is_image(const std::string& extension) {
  const auto extensions = image::readable_extensions();
  return std::ranges::find(extensions, extension) != extensions.end();
}

Result<OpenedFile> read(const std::string& file, const render::Document& current, const std::string& environment) {
  const std::string extension = lower_extension(file);
  if (extension == ".exr") {
    const auto image = image::read_exr(file);
    if (!image) return image.error();
    const auto state = image->attributes.find(render::kStateAttribute);
    if (state == image->attributes.end()) return read_environment(file, current);
    auto document = render::document_from_state(state->second, file);
    if (!document) return document.error();
    return OpenedFile{.kind = Kind::snapshot, .file = file, .document = std::move(*document)};
  }
  if (extension == render::kSessionExtension) {
    auto document = render::read_session_file(file);
    if (!document) return document.error();
    return OpenedFile{.kind = Kind::session, .file = file, .document = std::move(*document)};
  }
  if (is_image(extension)) return read_environment(file, current);
  auto document = render::new_document(file);
  if (!document) return document.error();
  if (document->lit_by_default && !environment.empty()) document = render::with_environment(*document, environment);
  if (!document) return document.error();
  return OpenedFile{.kind = Kind::scene, .file = file, .document = std::move(*document)};
}

}  // namespace

void Loader::open(const std::string& file, const render::Document& current, const std::string& environment) {
  file_ = file;
  start_ = std::chrono::steady_clock::now();
  task_.start([file, current, environment] { return read(file, current, environment); }, wake_);
}

void Loader::recover(const std::string& journal) {
  file_ = journal;
  start_ = std::chrono::steady_clock::now();
  const auto work = [journal]() -> Result<OpenedFile> {
    auto document = render::read_session_file(journal);
    if (!document) return document.error();
    return OpenedFile{.kind = Kind::recovered, .file = journal, .document = std::move(*document)};
  };
  task_.start(work, wake_);
}

double Loader::seconds() const {
  return std::chrono::duration<double>(std::chrono::steady_clock::now() - start_).count();
}

}  // namespace etendue::viewer
