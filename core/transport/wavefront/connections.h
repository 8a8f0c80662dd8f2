// Segments between given points, and their contributions, which count unless the segment is occluded.
//
// Segments are collected in packets and traced together. Contributions of unoccluded ones are delivered in the order in
// which they were added, with the transmittance of the segment times its MIS weight in scattering media.
#pragma once
#include <array>
#include <vector>

#include "transport/wavefront/path_media.h"

namespace etendue::transport {

// `Contribution` is the type of contributions.
template <class Contribution>
class Connections {
 public:
  static constexpr int kCapacity = 16 * RayPacket::kSize;

  bool full() const { return size_ == kCapacity; }

  // Adds a segment that starts in these solids and ends at a distance of `length` metres, at `time`, from 0 (shutter
  // opens) to 1 (shutter closes); the seed drives stochastic opacity. The caller fills the returned contribution in
  // place, because copying parts that were just written stalls on store forwarding.
  // In models with scattering media, `weight` is the MIS weight, of which the factor is part of the contribution.
  Contribution& add(const Ray& ray, float time, uint32_t seed, const scene::MediumStack& medium, float length,
                    const ConnectionWeight& weight) {
    if (segments_.empty()) segments_.resize(kCapacity);
    segments_[static_cast<size_t>(size_)] = {ray, time, length, medium, weight};
    return add(ray, time, seed);
  }
  Contribution& add(const Ray& ray, float time, uint32_t seed, const scene::MediumStack& medium, float length,
                    float = 1) {
    return add(ray, time, seed, medium, length, ConnectionWeight());
  }
  // A segment in models without media.
  Contribution& add(const Ray& ray, float time, uint32_t seed, Vacuum, float, float = 1) {
    return add(ray, time, seed);
  }

  // Traces all segments, calls `deliver(contribution, transmittance)` for those that are not occluded, and removes
  // them. Returns the number of rays traced.
  template <class Deliver>
  uint64_t settle(const scene::CompiledScene& scene, Deliver&& deliver) {
    const TracedConnections media(scene);
    // Passages through media count their rays themselves.
    uint64_t rays = media.use_packets() ? static_cast<uint64_t>(size_) : 0;
    if (media.use_packets())
      for (int first = 0; first < size_; first += RayPacket::kSize)
        scene.occluded(packets_[static_cast<size_t>(first / RayPacket::kSize)],
                       std::min(RayPacket::kSize, size_ - first), &seeds_[static_cast<size_t>(first)]);
    for (int i = 0; i < size_; ++i) {
      const auto slot = static_cast<size_t>(i);
      const bool blocked = packets_[slot / RayPacket::kSize].is_occluded(i % RayPacket::kSize);
      if (segments_.empty()) {
        if (!blocked) deliver(contributions_[slot], Rgb(1));
        continue;
      }
      const Segment& s = segments_[slot];
      const Passage passage =
          media.passage(blocked, s.ray, s.length, seeds_[slot], s.time, s.medium, rays, s.weight.others > 0);
      const Rgb weighted = passage.transmittance * s.weight.at(passage.survival);
      if (!is_black(weighted)) deliver(contributions_[slot], weighted);
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
    ConnectionWeight weight;
  };

  Contribution& add(const Ray& ray, float time, uint32_t seed) {
    const auto i = static_cast<size_t>(size_++);
    packets_[i / RayPacket::kSize].set(static_cast<int>(i % RayPacket::kSize), ray);
    packets_[i / RayPacket::kSize].set_time(static_cast<int>(i % RayPacket::kSize), time);
    seeds_[i] = seed;
    return contributions_[i];
  }

  std::array<RayPacket, kCapacity / RayPacket::kSize> packets_;
  std::array<uint32_t, kCapacity> seeds_;
  std::array<Contribution, kCapacity> contributions_;
  std::vector<Segment> segments_;  // only in models with media
  int size_ = 0;
};

}  // namespace etendue::transport
