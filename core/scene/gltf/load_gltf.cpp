#include "scene/gltf/load_gltf.h"

#include <map>

#include "scene/gltf/import.h"
#include "scene/gltf/jobs.h"

namespace etendue::scene {
namespace {

using gltf::Document;

// A file with one fault a thousand times gets a few lines for it.
void shorten(std::vector<std::string>& warnings) {
  constexpr size_t kEnough = 4;
  std::map<std::string, size_t> kinds;  // by the text without its numbers
  const auto kind_of = [](const std::string& warning) {
    std::string kind;
    for (const char c : warning)
      if (c < '0' || c > '9') kind += c;
    return kind;
  };
  std::vector<std::string> kept;
  for (std::string& warning : warnings)
    if (++kinds[kind_of(warning)] <= kEnough) kept.push_back(std::move(warning));
  for (const auto& [kind, count] : kinds)
    if (count > kEnough) kept.push_back(std::to_string(count - kEnough) + " more like this: " + kind);
  warnings = std::move(kept);
}

std::string one_line(std::string text) {
  std::replace_if(
      text.begin(), text.end(), [](char c) { return static_cast<unsigned char>(c) < ' ' || c == 127; }, ' ');
  return text;
}

class Loader {
 public:
  Loader(const std::filesystem::path& path, const LoadOptions& options) : path_(path), options_(options) {}

  Scene run() {
    report("reading", 0);
    gltf::open_document(path_, document_,
                        [&](float done) { return !options_.progress || options_.progress("decompressing", done); });
    gltf::validate(document_);
    scene_.name = path_.stem().string();
    scene_.file = path_.string();
    for (const std::string& extension : document_.model.extensionsUsed)
      if (!gltf::is_supported(extension)) scene_.unsupported.push_back(extension);
    scene_.warnings = document_.warnings;
    report("describing", 0);
    gltf::import_materials(document_, scene_);
    gltf::import_variants(document_, scene_);
    gltf::import_lights(document_, scene_);
    gltf::import_cameras(document_, scene_);
    gltf::import_nodes(document_, scene_, options_.scene);
    gltf::import_instances(document_, scene_);
    gltf::import_skins(document_, scene_);
    gltf::import_animations(document_, scene_);
    read_arrays();
    gltf::import_transport(document_, scene_);
    check_skinned_nodes();
    shorten(scene_.warnings);
    for (std::string& warning : scene_.warnings) warning = one_line(std::move(warning));
    return std::move(scene_);
  }

 private:
  void report(const char* phase, float done) const {
    if (options_.progress && !options_.progress(phase, done)) throw gltf::Cancelled{};
  }

  void read_arrays() {
    auto meshes = gltf::mesh_tasks(document_, scene_);
    auto pictures = gltf::image_tasks(document_);
    const auto job = [&](size_t i) {
      if (i < meshes.size())
        gltf::read_mesh(document_, meshes[i]);
      else
        gltf::read_picture(document_, pictures[i - meshes.size()]);
    };
    gltf::run_jobs(meshes.size() + pictures.size(), job,
                   [&](float done) { return !options_.progress || options_.progress("meshes and pictures", done); });
    gltf::place_meshes(document_, meshes, scene_);
    gltf::place_pictures(document_, pictures, scene_);
    for (const auto& mesh : meshes)
      scene_.warnings.insert(scene_.warnings.end(), mesh.warnings.begin(), mesh.warnings.end());
    for (const auto& picture : pictures)
      if (!picture.warning.empty()) scene_.warnings.push_back(picture.warning);
  }

  // Only here is it known which skin a mesh hangs on.
  void check_skinned_nodes() {
    for (size_t n = 0; n < scene_.nodes.size(); ++n) {
      const Node& node = scene_.nodes[n];
      if (node.skin < 0) continue;
      const size_t joints = scene_.skins[static_cast<size_t>(node.skin)]->joints.size();
      bool reaches_too_far = false;
      for (const Primitive& primitive : scene_.meshes[static_cast<size_t>(node.mesh)].primitives)
        if (primitive.deformation) reaches_too_far = reaches_too_far || !fits(*primitive.deformation, joints);
      if (reaches_too_far)
        scene_.warnings.push_back(gltf::at("nodes", n) +
                                  ": vertices of its mesh hang on joints that its skin does not have (it has " +
                                  std::to_string(joints) + "); these are ignored");
    }
  }

  static bool fits(const Deformation& deformation, size_t joints) {
    for (size_t i = 0; i < deformation.joints.size(); ++i)
      for (size_t k = 0; k < 4; ++k)
        if (deformation.weights[i][static_cast<int>(k)] > 0 && deformation.joints[i][k] >= joints) return false;
    return true;
  }

  const std::filesystem::path& path_;
  const LoadOptions& options_;
  Document document_;
  Scene scene_;
};

}  // namespace

Result<Scene> load_gltf(const std::filesystem::path& path, const LoadOptions& options) {
  const auto message = [&](const std::string& what) { return path.string() + ": " + one_line(what); };
  try {
    return Loader(path, options).run();
  } catch (const gltf::Unusable& unusable) {
    return input_error(message(unusable.message));
  } catch (const gltf::Cancelled&) {
    return Error{Fault::interrupted, message("loading was cancelled")};
  } catch (const std::bad_alloc&) {
    return input_error(message("needs more memory than there is"));
  } catch (const std::exception& error) {
    // A library rejected something that the checks let through.
    return input_error(message(std::string("the structure cannot be read: ") + error.what()));
  }
}

}  // namespace etendue::scene
