#include "support/scenes.h"

#include <cmath>
#include <cstdlib>
#include <cstring>
#include <filesystem>

#include "integrator/integrator.h"
#include "render/session.h"

namespace etendue::test {
render::Document document(scene::Scene scene, const Camera& camera, int width, int height) {
  render::Document d;
  d.scene_name = "test";
  if (scene.materials.empty()) scene.materials.emplace_back();
  d.scene = std::make_shared<const scene::Scene>(std::move(scene));
  d.camera = camera;
  d.width = width;
  d.height = height;
  return d;
}

render::Document integrating_sphere(double share, float albedo, scene::Cap cap, int size) {
  auto d = document(scene::integrating_sphere(share, albedo, cap), scene::integrating_sphere_camera(), size, size);
  d.filter = film::FilterKind::box;
  d.method.sampler = "random";
  const auto depth = static_cast<int64_t>(std::ceil(std::log(1e-6) / std::log(albedo)));
  for (const auto& info : integrator::integrator_infos())
    for (const auto& [name, value] : {std::pair{".roulette-start", int64_t{64}}, {".max-depth", depth}})
      if (auto changed = render::with(d, info.name + name, value)) d = *changed;
  return d;
}

render::Document cornell(int size) {
  auto d = *render::new_document("cornell");
  d.width = d.height = size;
  return d;
}

Result<render::Document> with_materials_set(render::Document document, const std::string& setting) {
  const size_t equals = setting.find('=');
  if (equals == std::string::npos) return usage_error("'" + setting + "' has no '='; give NAME=VALUE");
  const std::string name = setting.substr(0, equals), value = setting.substr(equals + 1);
  for (size_t m = 0; m < document.scene->materials.size(); ++m) {
    auto changed = render::with_text(document, "material." + std::to_string(m) + "." + name, value);
    if (!changed) return changed.error();
    document = std::move(*changed);
  }
  return document;
}

Rgb mean_color(const film::Film& film) {
  double sum[3] = {0, 0, 0};
  for (int y = 0; y < film.height(); ++y)
    for (int x = 0; x < film.width(); ++x)
      for (int c = 0; c < 3; ++c) sum[c] += film.mean(x, y)[c];
  const double n = static_cast<double>(film.width()) * film.height();
  return {static_cast<float>(sum[0] / n), static_cast<float>(sum[1] / n), static_cast<float>(sum[2] / n)};
}

bool same_bits(const film::Film& a, const film::Film& b) {
  return a.pixels().size() == b.pixels().size() &&
         std::memcmp(a.pixels().data(), b.pixels().data(), a.pixels().size_bytes()) == 0;
}

std::string data_folder() {
  const char* folder = std::getenv("ETENDUE_TEST_DATA");
  return folder && std::filesystem::is_directory(folder) ? folder : "";
}

}  // namespace etendue::test
