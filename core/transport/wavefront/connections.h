// Segments between given points, and their contributions, which count unless the segment is occluded.
//
// Segments are collected in packets and traced together. Contributions of unoccluded ones are delivered in the order in
// which they were added.
#pragma once
#include <array>

#include "scene/compiled_scene.h"

namespace etendue::transport {

// `Carried` is the type of contributions.
template <class Carried>
class Connections {
 public:
  static constexpr int kCapacity = 16 * RayPacket::kSize;

  bool full() const { return size_ == kCapacity; }

  // Adds a segment at `time`, from 0 (shutter opens) to 1 (shutter closes); the seed drives stochastic opacity. The
  // caller fills the returned contribution in place, because copying parts that were just written stalls on store
  // forwarding.
  Carried& add(const Ray& ray, float time, uint32_t seed) {
    const auto i = static_cast<size_t>(size_++);
    packets_[i / RayPacket::kSize].set(static_cast<int>(i % RayPacket::kSize), ray);
    packets_[i / RayPacket::kSize].set_time(static_cast<int>(i % RayPacket::kSize), time);
    seeds_[i] = seed;
    return carried_[i];
  }

  // Traces all segments, delivers the contributions and removes them. Returns the number of rays traced.
  template <class Deliver>
  uint64_t settle(const scene::CompiledScene& scene, Deliver&& deliver) {
    for (int first = 0; first < size_; first += RayPacket::kSize)
      scene.occluded(packets_[static_cast<size_t>(first / RayPacket::kSize)], std::min(RayPacket::kSize, size_ - first),
                     &seeds_[static_cast<size_t>(first)]);
    for (int i = 0; i < size_; ++i) {
      const auto slot = static_cast<size_t>(i);
      if (!packets_[slot / RayPacket::kSize].is_occluded(i % RayPacket::kSize)) deliver(carried_[slot]);
    }
    return static_cast<uint64_t>(std::exchange(size_, 0));
  }

 private:
  std::array<RayPacket, kCapacity / RayPacket::kSize> packets_;
  std::array<uint32_t, kCapacity> seeds_;
  std::array<Carried, kCapacity> carried_;
  int size_ = 0;
};

}  // namespace etendue::transport
