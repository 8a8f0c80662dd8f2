// The state of one path of a wavefront.
#pragma once
#include <cstdint>

#include "light/sampling/light_receiver.h"

namespace etendue::transport {

// The state of a path between two vertices.
template <class Color>
struct alignas(64) PathState {
  Color throughput, radiance;
  Vec3 from;  // origin of the last segment: reference point of light densities
  float pdf;  // of the last direction per solid angle; 0 if light sampling cannot find its hit
  // Factor of the throughput in Russian roulette. It corrects for refraction (squared relative indices) and for the
  // shares of branches.
  float eta_scale;
  float time;           // from 0 (shutter opens) to 1 (shutter closes); 0 in a model without motion
  uint32_t seed;        // of the pixel
  PackedNormal normal;  // at `from`
  bool all_specular;    // only specular scattering so far: the path hits directly visible surfaces

  // Filled in place: building a state elsewhere and copying it as words stalls on store forwarding.
  void start(const Vec3& origin, float at) {
    throughput = Color(1), radiance = Color(0);
    from = origin, normal = {};
    pdf = 0, eta_scale = 1, time = at;
    all_specular = true;
  }
  // The start of the last segment as a receiver of light.
  LightReceiver receiver() const { return {from, normal}; }
};

}  // namespace etendue::transport
