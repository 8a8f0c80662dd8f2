#include "scene/emissive_triangles.h"

#include <algorithm>
#include <functional>

#include "scene/facet.h"
#include "scene/gltf/parallel_jobs.h"
#include "scene/texture_point.h"

namespace etendue::scene {
namespace {

// Calls job(i) for all i below `count`, on all threads.
void for_each_triangle(size_t count, const std::function<void(size_t)>& job) {
  constexpr size_t kTrianglesOfAJob = 2048;
  const auto range = [&](size_t number) {
    const size_t begin = number * kTrianglesOfAJob;
    for (size_t t = begin; t < std::min(begin + kTrianglesOfAJob, count); ++t) job(t);
  };
  gltf::run_jobs((count + kTrianglesOfAJob - 1) / kTrianglesOfAJob, range, [](float) { return true; });
}

// `known_mean` is the mean of textured emission; null if it is to be computed.
AreaLightTriangle emissive(const InstanceData& instance, const SurfaceMaterial& material, uint32_t t,
                           const Rgb* known_mean) {
  const Mesh& mesh = *instance.mesh;
  AreaLightTriangle e;
  e.instance = instance.number;
  e.triangle = t;
  e.radiance = material.description.emission;
  e.double_sided = material.description.double_sided;
  e.moving = instance.motion != nullptr;
  e.cosine_exponent = instance.cosine_exponent;
  e.set_triangle(facet_of(instance, t, 0.5f));
  e.textured = static_cast<bool>(material.emission);
  if (material.emission && known_mean) {
    e.radiance = *known_mean;
  } else if (material.emission) {
    // The mean over seven points of the triangle.
    Rgb sum(0);
    constexpr float kPoints[7][2] = {{1 / 3.f, 1 / 3.f}, {.8f, .1f},  {.1f, .8f}, {.1f, .1f},
                                     {.45f, .45f},       {.45f, .1f}, {.1f, .45f}};
    for (const auto& b : kPoints) sum += material.emission_at(texture_point(mesh, t, b[0], b[1]));
    e.radiance = sum / 7;
  }
  return e;
}

}  // namespace

void add_moved(const InstanceData& instance, const SurfaceMaterial& material, std::span<const AreaLightTriangle> known,
               std::vector<AreaLightTriangle>& triangles) {
  const size_t first = triangles.size();
  triangles.resize(first + known.size());
  for_each_triangle(known.size(), [&](size_t t) {
    triangles[first + t] = emissive(instance, material, known[t].triangle, &known[t].radiance);
  });
}

std::shared_ptr<const EmittingTriangles> add_emissive(const InstanceData& instance, const SurfaceMaterial& material,
                                                      std::vector<AreaLightTriangle>& triangles) {
  const size_t count = instance.mesh->triangles.size(), first = triangles.size();
  triangles.resize(first + count);
  for_each_triangle(
      count, [&](size_t t) { triangles[first + t] = emissive(instance, material, static_cast<uint32_t>(t), nullptr); });
  const auto is_dark = [](const AreaLightTriangle& t) { return is_black(t.radiance); };
  const auto begin = triangles.begin() + static_cast<std::ptrdiff_t>(first);
  if (!material.emission || std::none_of(begin, triangles.end(), is_dark)) return nullptr;
  triangles.erase(std::remove_if(begin, triangles.end(), is_dark), triangles.end());
  auto emitting = std::make_shared<EmittingTriangles>();
  emitting->numbers.assign(count, InstanceData::kNotALight);
  for (size_t t = first; t < triangles.size(); ++t) emitting->numbers[triangles[t].triangle] = emitting->count++;
  return emitting;
}

AreaLightTriangle emissive_round(const InstanceData& instance, const SurfaceMaterial& material,
                                 std::vector<AnalyticAreaLight>& round_lights) {
  AnalyticAreaLight round{*instance.round, instance.motion};
  if (round.motion) round.shape = round.at(0.5f);
  AreaLightTriangle e;
  e.instance = instance.number;
  e.cosine_exponent = instance.cosine_exponent;
  e.radiance = material.description.emission;
  e.double_sided = material.description.double_sided;
  e.set_shape(static_cast<int>(round_lights.size()), round.shape);
  round_lights.push_back(std::move(round));
  return e;
}

}  // namespace etendue::scene
