#include "render/aov.h"

#include <array>

#include "base/hash.h"
#include "film/film.h"
#include "film/filter.h"
#include "integrator/shared/camera_path_integrator.h"
#include "render/thread_pool.h"

namespace etendue::render {
namespace {

struct Kind {
  const char* name;
  std::vector<std::string> channels;
  bool averaged;
};

const std::vector<Kind>& kinds() {
  static const std::vector<Kind> all{
      {"albedo", {"R", "G", "B"}, true},
      {"shading-normal", {"X", "Y", "Z"}, true},
      {"geometric-normal", {"X", "Y", "Z"}, true},
      {"depth", {"Z"}, true},
      {"position", {"X", "Y", "Z"}, true},
      {"material-id", {"V"}, false},
      {"object-id", {"V"}, false},
  };
  return all;
}

const Kind* find_kind(const std::string& name) {
  for (const auto& k : kinds())
    if (name == k.name) return &k;
  return nullptr;
}

// Up to three numbers of one hit. Normals face the camera. Ids start at one; zero is nothing.
std::array<float, 3> value_of(const std::string& name, const scene::SurfacePoint& point, float distance) {
  const auto of = [](const Vec3& v) { return std::array<float, 3>{v.x, v.y, v.z}; };
  const float side = point.front ? 1.0f : -1.0f;
  if (name == "albedo") {
    const Vec4 base = point.material->base_color_at(point.texture);
    return {base.x, base.y, base.z};
  }
  if (name == "shading-normal") return of(point.shading.z * side);
  if (name == "geometric-normal") return of(point.ng * side);
  if (name == "depth") return {distance, 0, 0};
  if (name == "position") return of(point.position);
  if (name == "material-id") return {static_cast<float>(point.instance->material + 1), 0, 0};
  return {static_cast<float>(point.instance->node + 1), 0, 0};
}

Vec2 pair_of(const SampleBlock& random, int dimension) {
  return Vec2(random[static_cast<size_t>(dimension)], random[static_cast<size_t>(dimension) + 1]);
}

}  // namespace

const std::vector<std::string>& aov_names() {
  static const auto names = [] {
    std::vector<std::string> list;
    for (const auto& k : kinds()) list.emplace_back(k.name);
    return list;
  }();
  return names;
}

std::vector<image::Layer> render_aovs(const scene::CompiledScene& scene, const Document& document,
                                      const std::vector<std::string>& names, uint32_t samples, int threads) {
  const int width = document.width, height = document.height;
  std::vector<image::Layer> layers;
  std::vector<const Kind*> wanted;
  for (const auto& name : names)
    if (const Kind* kind = find_kind(name)) {
      wanted.push_back(kind);
      layers.push_back(
          {name, kind->channels,
           std::vector<float>(static_cast<size_t>(width) * static_cast<size_t>(height) * kind->channels.size())});
    }
  const auto sampler = make_sampler(document.method.sampler, document.method.settings_of(document.method.sampler));
  const CameraRays camera(document.camera, width, height, scene.camera_motion());
  const film::Filter filter(document.filter);
  sampler->prepare(0, samples / film::kHalfBuffers + 1);

  const auto row = [&](int y) {
    for (int x = 0; x < width; ++x) {
      const size_t pixel = static_cast<size_t>(y) * static_cast<size_t>(width) + static_cast<size_t>(x);
      for (uint32_t s = 0; s < samples; ++s) {
        const uint32_t seed = integrator::pixel_seed(document.seed, x, y, s % film::kHalfBuffers);
        SampleBlock random;
        sampler->block(seed, s / film::kHalfBuffers, 0, random);
        const Vec2 at = Vec2(static_cast<float>(x) + 0.5f, static_cast<float>(y) + 0.5f) +
                        filter.sample(pair_of(random, camera_dimension::kPixel));
        const float time = random[camera_dimension::kTime];
        const Ray ray = camera.ray(at, pair_of(random, camera_dimension::kLens), time);
        const Hit hit = scene.intersect(ray, path_seed(seed, s / film::kHalfBuffers), time);
        if (!hit) continue;
        scene::SurfacePoint point;
        const Vec3 wo = -ray.direction;
        scene.surfaces({&wo, 1}, {&hit, 1}, &point, &time);
        for (size_t k = 0; k < wanted.size(); ++k) {
          if (!wanted[k]->averaged && s > 0) continue;
          const auto v = value_of(wanted[k]->name, point, hit.t);
          const size_t n = wanted[k]->channels.size();
          const float share = wanted[k]->averaged ? 1.0f / static_cast<float>(samples) : 1.0f;
          for (size_t c = 0; c < n; ++c) layers[k].pixels[pixel * n + c] += v[c] * share;
        }
      }
    }
  };
  ThreadPool workers(threads);
  workers.run(0, height, row, [] { return true; });
  return layers;
}

}  // namespace etendue::render
