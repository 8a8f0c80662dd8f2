// Loops over many paths at once, on the widest registers that the machine has.
//
// A function marked ETENDUE_WIDE is compiled for several instruction sets, and the program takes the best one when it
// starts. Every one of them gives the same bits: products and sums are never fused.
#pragma once
#include <array>

#include "base/vec.h"

// The linker's choice of a version runs before a thread sanitizer is ready.
#if defined(__x86_64__) && !defined(__SANITIZE_THREAD__)
#define ETENDUE_VECTORIZE [[gnu::target_clones("default", "avx2", "avx512f"), gnu::flatten]]
#else
#define ETENDUE_VECTORIZE
#endif

namespace etendue {

// Loops run over whole registers: what lies beyond the last element that counts is computed for nothing, and arrays
// have room for it.
inline constexpr size_t kMaxLanes = 16;
constexpr size_t padded_lanes(size_t count) { return (count + kMaxLanes - 1) / kMaxLanes * kMaxLanes; }

// Vectors number by number.
template <size_t N>
struct Vec3Lanes {
  alignas(64) std::array<float, N> x, y, z;

  void set(size_t i, const Vec3& v) { x[i] = v.x, y[i] = v.y, z[i] = v.z; }
  Vec3 operator[](size_t i) const { return {x[i], y[i], z[i]}; }
};

struct Vec3LanesView {
  float *x, *y, *z;

  Vec3LanesView(float* x_, float* y_, float* z_) : x(x_), y(y_), z(z_) {}
  template <size_t N>
  Vec3LanesView(Vec3Lanes<N>& v)  // NOLINT(google-explicit-constructor)
      : Vec3LanesView(v.x.data(), v.y.data(), v.z.data()) {}

  void set(size_t i, const Vec3& v) const { x[i] = v.x, y[i] = v.y, z[i] = v.z; }
  Vec3 operator[](size_t i) const { return {x[i], y[i], z[i]}; }
  Vec3LanesView operator+(size_t n) const { return {x + n, y + n, z + n}; }
};

}  // namespace etendue
