// Segments whose ends are known: contributions that count unless something lies in between.
//
// They are gathered until a few packets are full, and traced together; what is seen is handed to the caller in the
// order in which it was added, with the transmittance of the segment.
#pragma once
#include <array>
#include <vector>

#include "transport/wavefront/path_media.h"

namespace etendue::transport {

// `Carried` is what the caller wants back.
template <class Carried>
class Connections {
 public:
  static constexpr int kCapacity = 16 * RayPacket::kSize;

  bool full() const { return size_ == kCapacity; }

  // A segment that starts in these solids and ends at a distance of `length` metres. The ray is at `time`, from 0 at
  // the shutter's opening to 1 at its closing; the seed drives stochastic opacity. The caller fills what is returned,
  // in place: what was just written in parts stalls when it is copied as words.
  Carried& add(const Ray& ray, float time, uint32_t seed, const scene::MediumStack& medium, float length) {
    if (segments_.empty()) segments_.resize(kCapacity);
    segments_[static_cast<size_t>(size_)] = {ray, time, length, medium};
    return add(ray, time, seed);
  }
  // A segment in models without media.
  Carried& add(const Ray& ray, float time, uint32_t seed, Vacuum, float) { return add(ray, time, seed); }

  // Empties itself and calls `deliver(carried, transmittance)`. Returns the number of rays traced.
  template <class Deliver>
  uint64_t settle(const scene::CompiledScene& scene, Deliver&& deliver) {
    const TracedConnections media(scene);
    auto rays = static_cast<uint64_t>(size_);
    if (media.use_packets())
      for (int first = 0; first < size_; first += RayPacket::kSize)
        scene.occluded(packets_[static_cast<size_t>(first / RayPacket::kSize)],
                       std::min(RayPacket::kSize, size_ - first), &seeds_[static_cast<size_t>(first)]);
    for (int i = 0; i < size_; ++i) {
      const auto slot = static_cast<size_t>(i);
      const bool blocked = packets_[slot / RayPacket::kSize].is_occluded(i % RayPacket::kSize);
      if (segments_.empty()) {
        if (!blocked) deliver(carried_[slot], Rgb(1));
        continue;
      }
      const Segment& s = segments_[slot];
      const Rgb transmittance = media.transmittance(blocked, s.ray, s.length, seeds_[slot], s.time, s.medium, rays);
      if (!is_black(transmittance)) deliver(carried_[slot], transmittance);
    }
    size_ = 0;
    return rays;
  }

 private:
  struct Segment {
    Ray ray;
    float time = 0;
    float length = 0;  // metres
    scene::MediumStack medium;
  };

  Carried& add(const Ray& ray, float time, uint32_t seed) {
    const auto i = static_cast<size_t>(size_++);
    packets_[i / RayPacket::kSize].set(static_cast<int>(i % RayPacket::kSize), ray);
    packets_[i / RayPacket::kSize].set_time(static_cast<int>(i % RayPacket::kSize), time);
    seeds_[i] = seed;
    return carried_[i];
  }

  std::array<RayPacket, kCapacity / RayPacket::kSize> packets_;
  std::array<uint32_t, kCapacity> seeds_;
  std::array<Carried, kCapacity> carried_;
  std::vector<Segment> segments_;  // only in models with media
  int size_ = 0;
};

}  // namespace etendue::transport
