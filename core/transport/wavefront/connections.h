// Segments whose ends are known: contributions that count unless something lies in between.
//
// They are gathered until a few packets are full, and traced together; what is seen is handed to the caller in the
// order in which it was added.
#pragma once
#include <array>

#include "scene/compiled_scene.h"

namespace etendue::transport {

// `Carried` is what the caller wants back.
template <class Carried>
class Connections {
 public:
  static constexpr int kCapacity = 16 * RayPacket::kSize;

  bool full() const { return size_ == kCapacity; }

  // The ray is at `time`, from 0 at the shutter's opening to 1 at its closing; the seed drives stochastic opacity. The
  // caller fills what is returned, in place: what was just written in parts stalls when it is copied as words.
  Carried& add(const Ray& ray, float time, uint32_t seed) {
    const auto i = static_cast<size_t>(size_++);
    packets_[i / RayPacket::kSize].set(static_cast<int>(i % RayPacket::kSize), ray);
    packets_[i / RayPacket::kSize].set_time(static_cast<int>(i % RayPacket::kSize), time);
    seeds_[i] = seed;
    return carried_[i];
  }

  // Empties itself; returns the number of rays traced.
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
