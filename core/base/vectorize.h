// Support for loops that the compiler vectorises over many paths.
//
// A function marked ETENDUE_VECTORIZE is compiled for several instruction sets; the dynamic linker selects the best one
// at program start. All versions give the same bits, because multiplications and additions are never fused.
#pragma once
#include <array>

#include "base/vec.h"

// Not with ThreadSanitizer (the linker selects a version before the sanitizer starts) and Clang (not with gnu::flatten).
#if defined(__x86_64__) && !defined(__SANITIZE_THREAD__) && !defined(__clang__)
#define ETENDUE_VECTORIZE [[gnu::target_clones("default", "avx2", "avx512f"), gnu::flatten]]
#else
#define ETENDUE_VECTORIZE
#endif

namespace etendue {

// The number of floats in the widest vector register.
inline constexpr size_t kMaxLanes = 16;

// `count` rounded up to whole registers. Vectorised loops run over padded_lanes(count) elements; their arrays must have
// that size, and the results beyond `count` are unused.
constexpr size_t padded_lanes(size_t count) { return (count + kMaxLanes - 1) / kMaxLanes * kMaxLanes; }

// N vectors in structure-of-arrays layout.
template <size_t N>
struct Vec3Lanes {
  alignas(64) std::array<float, N> x, y, z;

  void set(size_t i, const Vec3& v) {
    x[i] = v.x;
    y[i] = v.y;
    z[i] = v.z;
  }
  Vec3 operator[](size_t i) const { return {x[i], y[i], z[i]}; }
};

// Pointers to the three arrays of vectors in structure-of-arrays layout.
struct Vec3LanesView {
  float *x, *y, *z;

  Vec3LanesView(float* x_, float* y_, float* z_) : x(x_), y(y_), z(z_) {}
  template <size_t N>
  Vec3LanesView(Vec3Lanes<N>& v)  // NOLINT(google-explicit-constructor)
      : Vec3LanesView(v.x.data(), v.y.data(), v.z.data()) {}

  void set(size_t i, const Vec3& v) const {
    x[i] = v.x;
    y[i] = v.y;
    z[i] = v.z;
  }
  Vec3 operator[](size_t i) const { return {x[i], y[i], z[i]}; }
  Vec3LanesView operator+(size_t n) const { return {x + n, y + n, z + n}; }
};

}  // namespace etendue
