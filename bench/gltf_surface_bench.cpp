// Verdicts on the energy and the sampling of the materials of glTF files.
//
//   gltf_surface_bench [NAME=VALUE...] FILE|FOLDER...
//
// Each material is analysed (bsdf_analysis/checks.h) at eight surface points, drawn by area, with the values of its
// textures there, and once by its factors alone, as the Surface panel does. NAME=VALUE sets a parameter of all
// materials. Folders are searched for .gltf and .glb files; files that do not open are skipped.
//
// Columns: the largest albedo with its angle; surfaces of an albedo above 1; surfaces with a high sampling variance;
// the root mean square over points and angles up to 80 degrees of the relative standard deviation of sample weights,
// and its largest value. The last row sums all materials.
#include <algorithm>
#include <cmath>
#include <cstdio>
#include <filesystem>
#include <random>
#include <string>
#include <vector>

#include "bsdf_analysis/checks.h"
#include "scene/builtin/builtin.h"
#include "support/scenes.h"

namespace etendue {
namespace {

constexpr int kPoints = 8;

struct Summary {
  size_t surfaces = 0, above_one = 0, high_variance = 0;
  bsdf_analysis::Albedo largest_albedo;
  double largest_deviation = 0, squares = 0;
  size_t deviations = 0;

  void add(const bsdf_analysis::SurfaceAnalysis& a) {
    ++surfaces;
    above_one += !a.plausibility.conserves_energy();
    high_variance += !is_well_sampled(a.sampling);
    raise(a.plausibility.largest_albedo);
    for (const auto& q : a.sampling)
      if (q.degrees <= 80) add_deviations(q.deviation, sqr(q.deviation), 1);
  }
  void add(const Summary& s) {
    surfaces += s.surfaces;
    above_one += s.above_one;
    high_variance += s.high_variance;
    raise(s.largest_albedo);
    add_deviations(s.largest_deviation, s.squares, s.deviations);
  }
  void print(const std::string& file, const std::string& material) const {
    std::printf("| %s | %s | %zu | %.3f at %.4g° | %zu | %zu | %.3f | %.2f |\n", file.c_str(), material.c_str(),
                surfaces, static_cast<double>(max_component(largest_albedo.value)), largest_albedo.degrees, above_one,
                high_variance, std::sqrt(squares / static_cast<double>(std::max<size_t>(1, deviations))),
                largest_deviation);
    std::fflush(stdout);
  }

 private:
  void raise(const bsdf_analysis::Albedo& albedo) {
    if (max_component(albedo.value) > max_component(largest_albedo.value)) largest_albedo = albedo;
  }
  void add_deviations(double largest, double square, size_t count) {
    largest_deviation = std::max(largest_deviation, largest);
    squares += square;
    deviations += count;
  }
};

// The triangles that use a material, drawn by area.
class MaterialArea {
 public:
  MaterialArea(const scene::Scene& scene, int material) {
    std::vector<double> areas;
    for (const auto& group : scene.meshes)
      for (const auto& primitive : group.primitives) {
        if (primitive.material != material) continue;
        for (const Triangle& t : primitive.mesh->triangles) {
          const auto& p = primitive.mesh->positions;
          triangles_.push_back({primitive.mesh.get(), t});
          areas.push_back(static_cast<double>(glm::length(glm::cross(p[t[1]] - p[t[0]], p[t[2]] - p[t[0]]))));
        }
      }
    by_area_ = std::discrete_distribution<size_t>(areas.begin(), areas.end());
  }

  bool empty() const { return triangles_.empty(); }

  TexturePoint draw(std::mt19937& random) {
    const auto& [mesh, corners] = triangles_[by_area_(random)];
    std::uniform_real_distribution<float> uniform(0, 1);
    const float root = std::sqrt(uniform(random)), v = root * uniform(random);
    const float weights[] = {1 - root, root - v, v};
    TexturePoint point;
    for (size_t set = 0; set < 2; ++set)
      if (!mesh->uvs[set].empty()) point.uv[set] = interpolated(mesh->uvs[set], corners, weights);
    if (!mesh->colors.empty()) point.color = interpolated(mesh->colors, corners, weights);
    return point;
  }

 private:
  template <class T>
  static T interpolated(const std::vector<T>& values, const Triangle& corners, const float (&weights)[3]) {
    return values[corners[0]] * weights[0] + values[corners[1]] * weights[1] + values[corners[2]] * weights[2];
  }

  std::vector<std::pair<const Mesh*, Triangle>> triangles_;
  std::discrete_distribution<size_t> by_area_;
};

Summary analyze(const scene::Scene& scene, size_t material, MaterialArea& area) {
  Summary summary;
  summary.add(bsdf_analysis::analyze(bsdf_analysis::lobes_of(scene.materials[material])));
  const SurfaceMaterial surface(scene.materials[material], scene.textures);
  std::mt19937 random(static_cast<unsigned>(material));
  for (int k = 0; k < kPoints && surface.has_textures; ++k) {
    bsdf_analysis::Lobes lobes;
    add_lobes(surface, area.draw(random), lobes);
    if (!lobes.empty()) summary.add(bsdf_analysis::analyze(lobes));
  }
  return summary;
}

std::vector<std::filesystem::path> files_in(const std::vector<std::string>& paths) {
  std::vector<std::filesystem::path> files;
  for (const std::string& path : paths) {
    if (!std::filesystem::is_directory(path)) {
      files.emplace_back(path);
      continue;
    }
    for (const auto& entry : std::filesystem::recursive_directory_iterator(path))
      if (entry.path().extension() == ".gltf" || entry.path().extension() == ".glb") files.push_back(entry.path());
  }
  std::ranges::sort(files);
  return files;
}

// The scene with these parameters of all materials; ends the program if one is not valid.
std::shared_ptr<const scene::Scene> with_settings(scene::Scene scene, const std::vector<std::string>& settings) {
  Result<render::Document> document = render::Document{};
  document->scene = std::make_shared<const scene::Scene>(std::move(scene));
  for (const std::string& setting : settings) {
    document = test::with_materials_set(*document, setting);
    if (document) continue;
    std::fprintf(stderr, "gltf_surface_bench: %s\n", document.error().message.c_str());
    std::exit(2);
  }
  return document->scene;
}

int run(const std::vector<std::string>& arguments) {
  std::vector<std::string> settings, paths;
  for (const std::string& a : arguments) (a.find('=') == std::string::npos ? paths : settings).push_back(a);
  std::printf(
      "| file | material | surfaces | largest albedo | albedo > 1 | high variance | deviation | largest deviation |\n"
      "|---|---|---|---|---|---|---|---|\n");
  Summary total;
  for (const auto& file : files_in(paths)) {
    auto loaded = scene::load(file.string());
    if (!loaded) continue;
    const auto scene = with_settings(std::move(*loaded), settings);
    for (size_t m = 0; m < scene->materials.size(); ++m) {
      MaterialArea area(*scene, static_cast<int>(m));
      if (area.empty() || scene->materials[m].unlit) continue;
      const Summary summary = analyze(*scene, m, area);
      summary.print(file.stem().string(), scene->materials[m].name);
      total.add(summary);
    }
  }
  total.print("all", "");
  return 0;
}

}  // namespace
}  // namespace etendue

int main(int argc, char** argv) { return etendue::run({argv + 1, argv + argc}); }
