// Rays between patches, traced in packets of sixteen.
#pragma once
#include <array>

#include "base/hash.h"
#include "radiosity/patch_mesh.h"

namespace etendue::radiosity {

// A point of an element, moved off the surface to the element's side.
inline Vec3 off_surface(const PatchMesh& mesh, uint32_t element, const Vec3& point) {
  return point + mesh.normal_of(element) * mesh.patch_of(element).offset;
}

// The seed of the random numbers of an element.
inline uint32_t element_seed(uint64_t seed, uint32_t element) {
  return static_cast<uint32_t>(mix_bits(mix_bits(seed) ^ element) >> 32);
}

// Rays that start on an element and end where they hit; calls on_hit(element) for each hit of an element.
class HitRays {
 public:
  HitRays(const scene::CompiledScene& scene, const PatchMesh& mesh, uint32_t seed)
      : scene_(scene), mesh_(mesh), seed_(seed) {}

  template <class OnHit>
  void add(const Vec3& origin, const Vec3& direction, float weight, OnHit&& on_hit) {
    const auto lane = static_cast<size_t>(count_);
    weights_[lane] = weight;
    directions_[lane] = direction;
    seeds_[lane] = hash_combine(seed_, number_++);
    packet_.set(count_++, {origin, 0, direction, kInfinity});
    if (count_ == RayPacket::kSize) trace(on_hit);
  }
  // To be called after the last ray.
  template <class OnHit>
  void trace(OnHit&& on_hit) {
    if (count_ == 0) return;
    scene_.intersect(packet_, count_, false, seeds_.data());
    for (int lane = 0; lane < count_; ++lane) {
      if (!packet_.has_hit(lane)) continue;
      Hit hit;
      packet_.get(lane, hit);
      const auto i = static_cast<size_t>(lane);
      const uint32_t element = mesh_.element_at(hit, directions_[i]);
      if (element != kNoElement) on_hit(element, weights_[i]);
    }
    count_ = 0;
  }

  uint64_t traced() const { return number_; }

 private:
  const scene::CompiledScene& scene_;
  const PatchMesh& mesh_;
  uint32_t seed_, number_ = 0;
  RayPacket packet_;
  std::array<uint32_t, RayPacket::kSize> seeds_;
  std::array<Vec3, RayPacket::kSize> directions_;
  std::array<float, RayPacket::kSize> weights_;
  int count_ = 0;
};

// Segments between points of two elements; calls on_visible(weight) for each that is not occluded.
class VisibilityRays {
 public:
  VisibilityRays(const scene::CompiledScene& scene, uint32_t seed) : scene_(scene), seed_(seed) {}

  // Between two points that are off their surfaces.
  template <class OnVisible>
  void add(const Vec3& from, const Vec3& to, double weight, OnVisible&& on_visible) {
    const auto lane = static_cast<size_t>(count_);
    weights_[lane] = weight;
    seeds_[lane] = hash_combine(seed_, number_++);
    packet_.set(count_++, {from, 0, to - from, 1});
    if (count_ == RayPacket::kSize) trace(on_visible);
  }
  template <class OnVisible>
  void trace(OnVisible&& on_visible) {
    if (count_ == 0) return;
    scene_.occluded(packet_, count_, seeds_.data());
    for (int lane = 0; lane < count_; ++lane)
      if (!packet_.is_occluded(lane)) on_visible(weights_[static_cast<size_t>(lane)]);
    count_ = 0;
  }

  uint64_t traced() const { return number_; }

 private:
  const scene::CompiledScene& scene_;
  uint32_t seed_, number_ = 0;
  RayPacket packet_;
  std::array<uint32_t, RayPacket::kSize> seeds_;
  std::array<double, RayPacket::kSize> weights_;
  int count_ = 0;
};

}  // namespace etendue::radiosity
