#include "render/aov.h"

#include <algorithm>
#include <array>

#include "base/hash.h"
#include "film/film.h"
#include "film/filter.h"
#include "integrator/path/transport_terms.h"
#include "integrator/shared/camera_path_integrator.h"
#include "render/prepared_document.h"
#include "render/thread_pool.h"

namespace etendue::render {
namespace {

// One camera ray's hit.
struct AovHit {
  const scene::SurfacePoint& point;
  float distance;
  float side;  // 1 on the front of the surface, -1 on its back
};

using AovValue = std::array<float, 3>;

struct Aov {
  const char* name;
  std::vector<std::string> channels;
  bool is_averaged;
  AovValue (*evaluate)(const AovHit& hit);
};

AovValue components(const Vec3& v) { return {v.x, v.y, v.z}; }

const std::vector<Aov>& aovs() {
  static const std::vector<Aov> list{
      {"albedo",
       {"R", "G", "B"},
       true,
       [](const AovHit& hit) { return components(Vec3(hit.point.material->base_color_at(hit.point.texture))); }},
      {"shading-normal",
       {"X", "Y", "Z"},
       true,
       [](const AovHit& hit) { return components(hit.point.shading.z * hit.side); }},
      {"geometric-normal",
       {"X", "Y", "Z"},
       true,
       [](const AovHit& hit) { return components(hit.point.ng * hit.side); }},
      {"depth", {"Z"}, true, [](const AovHit& hit) { return AovValue{hit.distance}; }},
      {"position", {"X", "Y", "Z"}, true, [](const AovHit& hit) { return components(hit.point.position); }},
      {"material-id",
       {"V"},
       false,
       [](const AovHit& hit) { return AovValue{static_cast<float>(hit.point.instance->material + 1)}; }},
      {"object-id",
       {"V"},
       false,
       [](const AovHit& hit) { return AovValue{static_cast<float>(hit.point.instance->node + 1)}; }},
  };
  return list;
}

const Aov* find_aov(const std::string& name) {
  for (const Aov& aov : aovs())
    if (name == aov.name) return &aov;
  return nullptr;
}

Vec2 pair_of(const SampleBlock& random, int dimension) {
  return Vec2(random[static_cast<size_t>(dimension)], random[static_cast<size_t>(dimension) + 1]);
}

// A term of the equation of transfer.
struct MediumAov {
  const char* name;
  Rgb integrator::TransportTerms::*term;
};

constexpr MediumAov kMediumAovs[] = {
    {"medium-surface", &integrator::TransportTerms::surface},
    {"medium-absorption", &integrator::TransportTerms::absorption},
    {"medium-out-scattering", &integrator::TransportTerms::out_scattering},
    {"medium-emission", &integrator::TransportTerms::emission},
    {"medium-in-scattering", &integrator::TransportTerms::in_scattering},
};

int max_depth_of(const Document& document) {
  for (const Setting& setting : document.method.settings_of(document.method.integrator))
    if (setting.name == "max-depth") return static_cast<int>(std::get<int64_t>(setting.value));
  return 0;
}

// The samples first, first + step, ...
struct AovSamples {
  uint32_t first = 0;
  uint32_t step = 1;
  uint32_t count = 1;
};

std::vector<image::Layer> aov_layers(const scene::CompiledScene& scene, const Document& document,
                                     const std::vector<std::string>& names, const AovSamples& samples, int threads) {
  const int width = document.width, height = document.height;
  std::vector<image::Layer> layers;
  std::vector<const Aov*> requested;
  for (const auto& name : names)
    if (const Aov* aov = find_aov(name)) {
      requested.push_back(aov);
      layers.push_back(
          {name, aov->channels,
           std::vector<float>(static_cast<size_t>(width) * static_cast<size_t>(height) * aov->channels.size())});
    }
  const auto sampler = sampler_of(document);
  const CameraRays camera(document.camera, width, height, scene.camera_motion());
  const film::Filter filter(document.filter);
  sampler->prepare(0, (samples.first + samples.step * samples.count) / film::kHalfBuffers + 1);

  const auto render_row = [&](int y) {
    for (int x = 0; x < width; ++x) {
      const size_t pixel = static_cast<size_t>(y) * static_cast<size_t>(width) + static_cast<size_t>(x);
      for (uint32_t i = 0; i < samples.count; ++i) {
        const uint32_t s = samples.first + i * samples.step;
        const uint32_t seed = integrator::PixelSeeds(*sampler, document.seed, s % film::kHalfBuffers)(x, y);
        SampleBlock random;
        sampler->block(seed, s / film::kHalfBuffers, 0, random);
        const Vec2 raster = Vec2(static_cast<float>(x) + 0.5f, static_cast<float>(y) + 0.5f) +
                            filter.sample(pair_of(random, camera_dimension::kPixel));
        const float time = random[camera_dimension::kTime];
        const Ray ray = camera.ray(raster, pair_of(random, camera_dimension::kLens), time);
        const Hit hit = scene.intersect(ray, path_seed(seed, s / film::kHalfBuffers), time);
        if (!hit) continue;
        scene::SurfacePoint point;
        const Vec3 wo = -ray.direction;
        scene.surfaces({&wo, 1}, {&hit, 1}, &point, &time);
        const AovHit aov_hit{.point = point, .distance = hit.t, .side = point.front ? 1.0f : -1.0f};
        for (size_t k = 0; k < requested.size(); ++k) {
          const Aov& aov = *requested[k];
          if (!aov.is_averaged && i > 0) continue;
          const AovValue value = aov.evaluate(aov_hit);
          const size_t channels = aov.channels.size();
          const float weight = aov.is_averaged ? 1.0f / static_cast<float>(samples.count) : 1.0f;
          for (size_t c = 0; c < channels; ++c) layers[k].pixels[pixel * channels + c] += value[c] * weight;
        }
      }
    }
  };
  ThreadPool workers(threads);
  workers.run(0, height, render_row, [] { return true; });
  return layers;
}

}  // namespace

const std::vector<std::string>& medium_aov_names() {
  static const auto names = [] {
    std::vector<std::string> list;
    for (const MediumAov& aov : kMediumAovs) list.emplace_back(aov.name);
    return list;
  }();
  return names;
}

const std::vector<std::string>& aov_names() {
  static const auto names = [] {
    std::vector<std::string> list;
    for (const Aov& aov : aovs()) list.emplace_back(aov.name);
    return list;
  }();
  return names;
}

std::vector<image::Layer> render_aovs(const scene::CompiledScene& scene, const Document& document,
                                      const std::vector<std::string>& names, uint32_t samples, int threads) {
  return aov_layers(scene, document, names, {.count = samples}, threads);
}

std::array<std::vector<image::Layer>, film::kHalfBuffers> render_aov_half_buffers(const scene::CompiledScene& scene,
                                                                                  const Document& document,
                                                                                  const std::vector<std::string>& names,
                                                                                  uint32_t samples, int threads) {
  std::array<std::vector<image::Layer>, film::kHalfBuffers> layers;
  for (uint32_t h = 0; h < film::kHalfBuffers; ++h)
    layers[h] = aov_layers(scene, document, names, {.first = h, .step = film::kHalfBuffers, .count = samples}, threads);
  return layers;
}

std::vector<image::Layer> render_medium_aovs(std::shared_ptr<const scene::CompiledScene> scene,
                                             const Document& document, const std::vector<std::string>& names,
                                             uint32_t samples, int threads, const std::function<bool()>& continues) {
  std::vector<image::Layer> layers;
  std::vector<Rgb integrator::TransportTerms::*> terms;
  const auto width = static_cast<size_t>(document.width), height = static_cast<size_t>(document.height);
  for (const MediumAov& aov : kMediumAovs) {
    if (std::ranges::find(names, aov.name) == names.end()) continue;
    terms.push_back(aov.term);
    layers.push_back({aov.name, {"R", "G", "B"}, std::vector<float>(width * height * 3)});
  }
  if (layers.empty()) return layers;
  PreparedDocument prepared(document, std::move(scene));
  const integrator::RenderContext context = prepared.context();
  const int max_depth = max_depth_of(document);
  const int columns = (document.width + integrator::PixelBlock::kWidth - 1) / integrator::PixelBlock::kWidth,
            rows = (document.height + integrator::PixelBlock::kHeight - 1) / integrator::PixelBlock::kHeight;
  const auto render_block = [&](int number, uint32_t sample) {
    const auto block = integrator::block_containing(number % columns * integrator::PixelBlock::kWidth,
                                                    number / columns * integrator::PixelBlock::kHeight, document.width,
                                                    document.height, sample);
    std::array<integrator::TransportTerms, integrator::PixelBlock::kMostPixels> values;
    if (!integrator::sample_transport_terms(context, block, max_depth, {}, values)) return;
    for (int y = 0; y < block.height; ++y)
      for (int x = 0; x < block.width; ++x) {
        const auto& value = values[static_cast<size_t>(y * block.width + x)];
        const size_t pixel = static_cast<size_t>(block.y + y) * width + static_cast<size_t>(block.x + x);
        for (size_t k = 0; k < layers.size(); ++k)
          for (int c = 0; c < 3; ++c)
            layers[k].pixels[pixel * 3 + static_cast<size_t>(c)] += (value.*terms[k])[c] / static_cast<float>(samples);
      }
  };
  ThreadPool workers(threads);
  for (uint32_t sample = 0; sample < samples; ++sample) {
    if (sample % film::kHalfBuffers == 0) prepared.prepare_sampler(sample / film::kHalfBuffers);
    workers.run(
        0, columns * rows, [&](int number) { render_block(number, sample); }, continues);
    if (!continues()) return {};
  }
  return layers;
}

}  // namespace etendue::render
