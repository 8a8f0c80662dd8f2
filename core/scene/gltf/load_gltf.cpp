#include "scene/gltf/load_gltf.h"

#include <algorithm>
#include <atomic>
#include <iterator>
#include <map>

#include "scene/gltf/import/importers.h"
#include "scene/gltf/parallel_jobs.h"

namespace etendue::scene {
namespace {

using gltf::InputFile;

constexpr size_t kShown = 4;  // places of a defect, and warnings of a kind

// Warnings are "place: defect". Those with the same defect become one, which names the first places and counts the others.
std::vector<std::string> join_places(const std::vector<std::string>& warnings) {
  struct Places {
    std::vector<std::string> shown;
    size_t count = 0;
  };
  std::vector<std::pair<std::string, Places>> defects;
  std::map<std::string, size_t> number_of;
  for (const std::string& warning : warnings) {
    const size_t colon = warning.find(": ");
    const std::string defect = colon == std::string::npos ? warning : warning.substr(colon);
    const auto [known, is_new] = number_of.emplace(defect, defects.size());
    if (is_new) defects.push_back({defect, {}});
    Places& places = defects[known->second].second;
    if (places.count++ < kShown && colon != std::string::npos) places.shown.push_back(warning.substr(0, colon));
  }
  std::vector<std::string> joined;
  for (const auto& [defect, places] : defects) {
    std::string text;
    for (const std::string& place : places.shown) text += (text.empty() ? "" : ", ") + place;
    if (places.count > kShown) text += " and " + std::to_string(places.count - kShown) + " more";
    joined.push_back(text + defect);
  }
  return joined;
}

// Keeps the first warnings of each kind and counts the others. The kind is the text without digits.
std::vector<std::string> shorten(std::vector<std::string> warnings) {
  std::map<std::string, size_t> kinds;
  std::vector<std::string> kept;
  for (std::string& warning : warnings) {
    std::string kind;
    std::ranges::copy_if(warning, std::back_inserter(kind), [](char c) { return c < '0' || c > '9'; });
    if (++kinds[kind] <= kShown) kept.push_back(std::move(warning));
  }
  for (const auto& [kind, count] : kinds)
    if (count > kShown) kept.push_back(std::to_string(count - kShown) + " more of this kind: " + kind);
  return kept;
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
    gltf::open_input_file(path_, input_,
                          [&](float done) { return !options_.progress || options_.progress("decompressing", done); });
    gltf::check_references(input_);
    scene_.name = path_.stem().string();
    scene_.file = path_.string();
    for (const std::string& extension : input_.model.extensionsUsed)
      if (!gltf::is_supported(extension)) scene_.unsupported.push_back(extension);
    scene_.warnings = input_.warnings;
    report("reading the structure", 0);
    gltf::import_materials(input_, scene_);
    gltf::import_variants(input_, scene_);
    gltf::import_lights(input_, scene_);
    gltf::import_cameras(input_, scene_);
    gltf::import_nodes(input_, scene_, options_.scene);
    gltf::import_instances(input_, scene_);
    gltf::import_skins(input_, scene_);
    gltf::import_animations(input_, scene_);
    read_arrays();
    scene_.warnings = shorten(join_places(scene_.warnings));
    for (std::string& warning : scene_.warnings) warning = one_line(std::move(warning));
    return std::move(scene_);
  }

 private:
  void report(const char* phase, float done) const {
    if (options_.progress && !options_.progress(phase, done)) throw gltf::Cancelled{};
  }

  void read_arrays() {
    auto meshes = gltf::mesh_tasks(input_, scene_);
    auto images = gltf::image_tasks(input_, scene_);
    const bool tiled = gltf::exceed_texture_memory(input_, images);
    std::atomic<size_t> meshes_left = meshes.size();
    if (meshes.empty()) complete_without_images(meshes, images.empty());
    const auto job = [&](size_t i) {
      if (i >= meshes.size()) return gltf::read_image_task(input_, tiled, images[i - meshes.size()]);
      gltf::read_mesh(input_, meshes[i]);
      if (--meshes_left == 0) complete_without_images(meshes, images.empty());
    };
    gltf::run_jobs(meshes.size() + images.size(), job,
                   [&](float done) { return !options_.progress || options_.progress("meshes and images", done); });
    gltf::check_files(input_);
    gltf::add_images(input_, images, scene_);
    for (const auto& image : images)
      if (!image.warning.empty()) scene_.warnings.push_back(image.warning);
  }

  // Called when all meshes have been read, while other threads read images.
  void complete_without_images(const std::vector<gltf::MeshTask>& meshes, bool has_no_images) {
    gltf::add_meshes(input_, meshes, scene_);
    for (const auto& mesh : meshes)
      scene_.warnings.insert(scene_.warnings.end(), mesh.warnings.begin(), mesh.warnings.end());
    gltf::import_transport(input_, scene_);
    check_joint_indices();
    gltf::remove_far_meshes(scene_);
    gltf::check_boundaries(scene_);
    if (options_.without_images && !has_no_images) options_.without_images(scene_);
  }

  // A node selects the skin of its mesh, so this check needs both.
  void check_joint_indices() {
    for (size_t n = 0; n < scene_.nodes.size(); ++n) {
      const Node& node = scene_.nodes[n];
      if (node.skin < 0) continue;
      const size_t joints = scene_.skins[static_cast<size_t>(node.skin)]->joints.size();
      bool references_missing_joint = false;
      for (const Primitive& primitive : scene_.meshes[static_cast<size_t>(node.mesh)].primitives)
        if (primitive.deformation)
          references_missing_joint = references_missing_joint || !has_all_joints(*primitive.deformation, joints);
      if (references_missing_joint)
        scene_.warnings.push_back(gltf::at("nodes", n) +
                                  ": the mesh references joints that are not in its skin, which has " +
                                  std::to_string(joints) + "; these weights are ignored");
    }
  }

  static bool has_all_joints(const Deformation& deformation, size_t joints) {
    for (size_t i = 0; i < deformation.joints.size(); ++i)
      for (size_t k = 0; k < 4; ++k)
        if (deformation.weights[i][static_cast<int>(k)] > 0 && deformation.joints[i][k] >= joints) return false;
    return true;
  }

  const std::filesystem::path& path_;
  const LoadOptions& options_;
  InputFile input_;
  Scene scene_;
};

}  // namespace

Result<Scene> load_gltf(const std::filesystem::path& path, const LoadOptions& options) {
  const auto message = [&](const std::string& what) { return path.string() + ": " + one_line(what); };
  try {
    return Loader(path, options).run();
  } catch (const gltf::FileError& error) {
    return input_error(message(error.message));
  } catch (const gltf::Cancelled&) {
    return Error{Fault::interrupted, message("loading was cancelled")};
  } catch (const std::bad_alloc&) {
    return input_error(message("not enough memory to load the file"));
  } catch (const std::exception& error) {
    // A library rejected something that the checks above do not cover.
    return input_error(message(std::string("the structure cannot be read: ") + error.what()));
  }
}

}  // namespace etendue::scene
