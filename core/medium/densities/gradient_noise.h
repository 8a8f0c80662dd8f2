// Gradient noise [Perlin 2002] and its sum over octaves.
#pragma once
#include "base/hash.h"
#include "base/vec.h"

namespace etendue {

// Gradient noise in about [-1, 1]; 0 at all points with integer coordinates.
inline float gradient_noise(const Vec3& p, uint32_t seed) {
  const Vec3 base = glm::floor(p), f = p - base, fade = f * f * f * (f * (f * 6.0f - 15.0f) + 10.0f);
  const auto corner = [&](int dx, int dy, int dz) {
    const auto coordinate = [](float x, int d) { return static_cast<uint32_t>(static_cast<int32_t>(x) + d); };
    const uint32_t h = hash_combine(hash_combine(hash_combine(seed, coordinate(base.x, dx)), coordinate(base.y, dy)),
                                    coordinate(base.z, dz));
    // One of the twelve directions to the edges of a cube, four of them twice.
    const Vec3 d = f - Vec3(dx, dy, dz);
    const uint32_t edge = h & 15;
    const float u = edge < 8 ? d.x : d.y, v = edge < 4 ? d.y : edge == 12 || edge == 14 ? d.x : d.z;
    return ((h & 1) == 0 ? u : -u) + ((h & 2) == 0 ? v : -v);
  };
  const auto mix = [](float a, float b, float t) { return a + (b - a) * t; };
  const auto face = [&](int dz) {
    return mix(mix(corner(0, 0, dz), corner(1, 0, dz), fade.x), mix(corner(0, 1, dz), corner(1, 1, dz), fade.x),
               fade.y);
  };
  return mix(face(0), face(1), fade.z);
}

// The sum of octaves of doubled frequency and halved amplitude, relative to the amplitude of the first.
inline float fractal_noise(Vec3 p, int octaves, uint32_t seed) {
  float sum = 0, amplitude = 1;
  for (int i = 0; i < octaves; ++i) {
    sum += amplitude * gradient_noise(p, hash_combine(seed, static_cast<uint32_t>(i)));
    p *= 2;
    amplitude *= 0.5f;
  }
  return sum;
}

}  // namespace etendue
