#include "radiosity/initial_irradiance.h"

#include <algorithm>
#include <array>

#include "base/warp.h"
#include "radiosity/patch_rays.h"

namespace etendue::radiosity {
namespace {

constexpr size_t kBatch = 64;

// Points of the element with one light sample each.
struct LightBatch {
  Vec3Lanes<kBatch> from{};
  alignas(64) std::array<float, kBatch> choice{}, u0{}, u1{};
  std::array<LightSample, kBatch> lights;

  void draw(const Patch& patch, const Sampler& sampler, uint32_t seed, uint32_t first, size_t count) {
    for (size_t i = 0; i < count; ++i) {
      SampleBlock u;
      sampler.block(seed, first + static_cast<uint32_t>(i), 0, u);
      from.set(i, patch.point(square_to_triangle({u[0], u[1]})));
      u0[i] = u[2];
      u1[i] = u[3];
      choice[i] = u[4];
    }
  }
};

// Light samples and shadow rays must not use the numbers of the form factors.
constexpr uint64_t kLightSeed = 0x2545f4914f6cdd1d;

}  // namespace

Rgb direct_irradiance(const scene::CompiledScene& scene, const PatchMesh& mesh, const Sampler& sampler,
                      uint32_t element, uint32_t samples, uint64_t seed, uint64_t& rays) {
  if (scene.lights().empty()) return Rgb(0);
  const Patch& patch = mesh.patch_of(element);
  scene::SurfacePoint start;
  start.ng = mesh.normal_of(element);
  start.offset = patch.offset;
  const uint32_t number = element_seed(seed ^ kLightSeed, element);
  RayPacket packet;
  std::array<uint32_t, RayPacket::kSize> seeds;
  std::array<Rgb, RayPacket::kSize> waiting;
  int count = 0;
  Rgb sum(0);
  const auto trace = [&] {
    if (count > 0) scene.occluded(packet, count, seeds.data());
    for (int lane = 0; lane < count; ++lane)
      if (!packet.is_occluded(lane)) sum += waiting[static_cast<size_t>(lane)];
    rays += static_cast<uint64_t>(count);
    count = 0;
  };
  LightBatch batch;
  for (uint32_t first = 0; first < samples; first += kBatch) {
    const size_t size = std::min<size_t>(kBatch, samples - first);
    batch.draw(patch, sampler, number, first, size);
    scene.lights().sample({batch.from, batch.choice.data(), batch.u0.data(), batch.u1.data(), size},
                          batch.lights.data(), LightStrategy::automatic);
    for (size_t i = 0; i < size; ++i) {
      const LightSample& light = batch.lights[i];
      const float cosine = glm::dot(light.wi, start.ng);
      if (!(light.pdf > 0) || !(cosine > 0)) continue;
      const Rgb irradiance = scene.radiance_of(light) * (cosine / light.pdf);
      if (is_black(irradiance)) continue;
      if (light.distance == 0) {
        sum += irradiance;
        continue;
      }
      Ray ray;
      start.position = batch.from[i];
      start.spawn_segment(light.wi, light.distance, ray);
      seeds[static_cast<size_t>(count)] = hash_combine(number, first + static_cast<uint32_t>(i));
      waiting[static_cast<size_t>(count)] = irradiance;
      packet.set(count++, ray);
      if (count == RayPacket::kSize) trace();
    }
  }
  trace();
  return sum / static_cast<float>(samples);
}

}  // namespace etendue::radiosity
