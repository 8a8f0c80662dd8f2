// Vectors, matrices (GLM) and scalar functions that all modules use.
//
// Positions are in metres and y points up. Matrices are column-major and act on column vectors, as in glTF.
#pragma once
#include <algorithm>
#include <bit>
#include <cmath>
#include <cstdint>
#include <glm/glm.hpp>
#include <limits>

namespace etendue {

using Vec2 = glm::vec2;
using Vec3 = glm::vec3;
using Vec4 = glm::vec4;
using Vec2i = glm::ivec2;
using Mat3 = glm::mat3;
using Mat4 = glm::mat4;

inline constexpr float kPi = 3.14159265358979323846f;
inline constexpr float kInvPi = 0.31830988618379067154f;
inline constexpr float kInfinity = std::numeric_limits<float>::infinity();

// The largest float below 1. Samplers return values in [0, kOneMinusEpsilon].
inline constexpr float kOneMinusEpsilon = 0x1.fffffep-1f;

template <class T>
constexpr T sqr(T x) {
  return x * x;
}

// condition ? a : b, without a branch. For conditions on random numbers, which branch prediction cannot follow.
inline float select(bool condition, float a, float b) {
  const uint32_t mask = 0U - static_cast<uint32_t>(condition);
  return std::bit_cast<float>((std::bit_cast<uint32_t>(a) & mask) | (std::bit_cast<uint32_t>(b) & ~mask));
}

// The square root of x, or 0 if rounding made x negative.
inline float safe_sqrt(float x) { return std::sqrt(std::max(0.0f, x)); }

inline float length_squared(const Vec3& v) { return glm::dot(v, v); }

inline float max_component(const Vec3& v) { return std::max(v.x, std::max(v.y, v.z)); }

inline bool is_finite(const Vec3& v) { return std::isfinite(v.x) && std::isfinite(v.y) && std::isfinite(v.z); }

// The unit vector along v, or `fallback` if v is zero or not finite.
inline Vec3 normalize_or(const Vec3& v, const Vec3& fallback) {
  const float squared = length_squared(v);
  return squared > 0 && std::isfinite(squared) ? v / std::sqrt(squared) : fallback;
}

}  // namespace etendue
