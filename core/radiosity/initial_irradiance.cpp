#include "radiosity/initial_irradiance.h"

#include <algorithm>
#include <array>

#include "base/warp.h"
#include "radiosity/patch_rays.h"

namespace etendue::radiosity {
namespace {

constexpr size_t kBatch = 64;

// Points with one light sample each.
struct LightBatch {
  Vec3Lanes<kBatch> from{};
  alignas(64) std::array<float, kBatch> choice{}, u0{}, u1{};
  std::array<LightSample, kBatch> lights;

  void set(size_t i, const Vec3& point, const SampleBlock& u) {
    from.set(i, point);
    u0[i] = u[2];
    u1[i] = u[3];
    choice[i] = u[4];
  }
  void sample(const scene::CompiledScene& scene, size_t count) {
    scene.lights().sample({from, choice.data(), u0.data(), u1.data(), count}, lights.data(), LightStrategy::automatic);
  }
};

// Adds the irradiance of light samples that nothing occludes to sums.
class ShadowRays {
 public:
  ShadowRays(const scene::CompiledScene& scene, const PatchMesh& mesh, uint32_t element) : scene_(scene) {
    start_.ng = mesh.normal_of(element);
    start_.offset = mesh.patch_of(element).offset;
  }

  void add(const Vec3& from, const LightSample& light, uint32_t seed, Rgb& sum) {
    const float cosine = glm::dot(light.wi, start_.ng);
    if (!(light.pdf > 0) || !(cosine > 0)) return;
    const Rgb irradiance = scene_.radiance_of(light) * (cosine / light.pdf);
    if (is_black(irradiance)) return;
    if (light.distance == 0) {
      sum += irradiance;
      return;
    }
    Ray ray;
    start_.position = from;
    start_.spawn_segment(light.wi, light.distance, ray);
    const auto lane = static_cast<size_t>(count_);
    seeds_[lane] = seed;
    waiting_[lane] = irradiance;
    sums_[lane] = &sum;
    packet_.set(count_++, ray);
    if (count_ == RayPacket::kSize) trace();
  }
  // To be called after the last ray. Returns the number of all rays.
  uint64_t trace() {
    if (count_ > 0) scene_.occluded(packet_, count_, seeds_.data());
    for (int lane = 0; lane < count_; ++lane)
      if (!packet_.is_occluded(lane)) *sums_[static_cast<size_t>(lane)] += waiting_[static_cast<size_t>(lane)];
    traced_ += static_cast<uint64_t>(count_);
    count_ = 0;
    return traced_;
  }

 private:
  const scene::CompiledScene& scene_;
  scene::SurfacePoint start_;
  RayPacket packet_;
  std::array<uint32_t, RayPacket::kSize> seeds_;
  std::array<Rgb, RayPacket::kSize> waiting_;
  std::array<Rgb*, RayPacket::kSize> sums_;
  int count_ = 0;
  uint64_t traced_ = 0;
};

// Light samples and shadow rays must not use the numbers of the form factors.
constexpr uint64_t kLightSeed = 0x2545f4914f6cdd1d;

}  // namespace

Rgb direct_irradiance(const scene::CompiledScene& scene, const PatchMesh& mesh, const Sampler& sampler,
                      uint32_t element, uint32_t samples, uint64_t seed, uint64_t& rays) {
  if (scene.lights().empty()) return Rgb(0);
  const Patch& patch = mesh.patch_of(element);
  const uint32_t number = element_seed(seed ^ kLightSeed, element);
  ShadowRays shadows(scene, mesh, element);
  Rgb sum(0);
  LightBatch batch;
  for (uint32_t first = 0; first < samples; first += kBatch) {
    const size_t size = std::min<size_t>(kBatch, samples - first);
    for (size_t i = 0; i < size; ++i) {
      SampleBlock u;
      sampler.block(number, first + static_cast<uint32_t>(i), 0, u);
      batch.set(i, patch.point(square_to_triangle({u[0], u[1]})), u);
    }
    batch.sample(scene, size);
    for (size_t i = 0; i < size; ++i)
      shadows.add(batch.from[i], batch.lights[i], hash_combine(number, first + static_cast<uint32_t>(i)), sum);
  }
  rays += shadows.trace();
  return sum / static_cast<float>(samples);
}

void irradiance_at_points(const scene::CompiledScene& scene, const PatchMesh& mesh, const Sampler& sampler,
                          uint32_t element, std::span<const Vec3> points, uint32_t samples, uint64_t seed,
                          std::span<Rgb> irradiance, uint64_t& rays) {
  std::ranges::fill(irradiance, Rgb(0));
  if (scene.lights().empty()) return;
  const uint32_t number = element_seed(seed ^ kLightSeed, element);
  ShadowRays shadows(scene, mesh, element);
  LightBatch batch;
  const size_t samples_per_batch = kBatch / points.size();
  for (size_t first = 0; first < samples; first += samples_per_batch) {
    const size_t size = std::min(samples_per_batch, samples - first);
    for (size_t i = 0; i < size; ++i) {
      SampleBlock u;
      sampler.block(number, static_cast<uint32_t>(first + i), 0, u);
      for (size_t p = 0; p < points.size(); ++p) batch.set(i * points.size() + p, points[p], u);
    }
    batch.sample(scene, size * points.size());
    for (size_t i = 0; i < size; ++i)
      for (size_t p = 0; p < points.size(); ++p)
        shadows.add(points[p], batch.lights[i * points.size() + p],
                    hash_combine(number, static_cast<uint32_t>(first + i)), irradiance[p]);
  }
  rays += shadows.trace();
  for (Rgb& value : irradiance) value /= static_cast<float>(samples);
}

}  // namespace etendue::radiosity
