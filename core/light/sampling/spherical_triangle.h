// Uniform sampling of the directions to a triangle.                   [Arvo 1995; Van Oosterom and Strackee 1983]
//
// Sines and cosines of the angles at the corners are computed from products of the edges, not from differences of
// nearly equal directions. Small, distant triangles keep their precision.
#pragma once
#include "base/vec.h"

namespace etendue {

class SphericalTriangle {
 public:
  // As seen from the origin: a corner and two edges.
  SphericalTriangle(const Vec3& p0, const Vec3& e1, const Vec3& e2)
      : p0_(p0), e1_(e1), e2_(e2), a_(p0), b_(p0 + e1), c_(p0 + e2) {
    const float la = glm::length(a_), lb = glm::length(b_), lc = glm::length(c_);
    a_ /= la;
    b_ /= lb;
    c_ /= lc;
    volume_ = glm::dot(p0, glm::cross(e1, e2));
    const float sine = std::abs(volume_) / (la * lb * lc);
    solid_angle_ = 2 * std::atan2(sine, 1 + glm::dot(a_, b_) + glm::dot(b_, c_) + glm::dot(c_, a_));
  }

  float solid_angle() const { return solid_angle_; }
  // Triangles seen edge-on and triangles around the origin are sampled by area instead.
  bool can_be_sampled() const { return solid_angle_ > 0.01f && solid_angle_ < 6.2f; }

  struct Point {
    Vec3 direction;  // unit
    float distance;
    Vec2 barycentric;  // weights of vertices 1 and 2
  };
  // u.x is the share of the solid angle of a smaller triangle with the corners a and b; u.y is the position between b
  // and its third corner.
  Point sample(Vec2 u) const {
    // The angle alpha at a, between the normals of the two planes that meet there.
    const Vec3 ab = glm::cross(p0_, e1_);
    const Vec3 ac = glm::cross(p0_, e2_);
    const float cos_part = glm::dot(ab, ac);
    const float sin_part = std::abs(volume_) * glm::length(p0_);
    const float scale = 1 / std::sqrt(sqr(cos_part) + sqr(sin_part));
    const float cos_alpha = cos_part * scale;
    const float sin_alpha = sin_part * scale;
    const float area = u.x * solid_angle_;
    const float cos_area = std::cos(area);
    const float sin_area = std::sin(area);
    const float s = sin_area * cos_alpha - cos_area * sin_alpha;
    const float t = cos_area * cos_alpha + sin_area * sin_alpha;
    const float k = t - cos_alpha;
    const float v = s + sin_alpha * glm::dot(a_, b_);
    const float below = (v * s + k * t) * sin_alpha;
    const float q = below != 0 ? std::clamp(((v * t - k * s) * cos_alpha - v) / below, -1.0f, 1.0f) : 1.0f;
    const Vec3 across = q * a_ + safe_sqrt(1 - q * q) * normalize_or(c_ - glm::dot(a_, c_) * a_, b_);
    const float z = 1 - u.y * (1 - glm::dot(across, b_));
    const Vec3 w = z * b_ + safe_sqrt(1 - z * z) * normalize_or(across - glm::dot(across, b_) * b_, a_);
    return along(glm::normalize(w));
  }

 private:
  // The intersection of the direction with the triangle, limited to it against rounding.
  Point along(const Vec3& w) const {
    const Vec3 s = glm::cross(w, e2_);
    const float over = 1 / glm::dot(s, e1_);
    float b1 = std::clamp(-glm::dot(s, p0_) * over, 0.0f, 1.0f);
    float b2 = std::clamp(-glm::dot(w, glm::cross(p0_, e1_)) * over, 0.0f, 1.0f);
    if (const float sum = b1 + b2; sum > 1) {
      b1 /= sum;
      b2 /= sum;
    }
    const Vec3 to = p0_ + b1 * e1_ + b2 * e2_;
    const float distance = glm::length(to);
    return {to / distance, distance, {b1, b2}};
  }

  Vec3 p0_, e1_, e2_;
  Vec3 a_, b_, c_;  // unit directions of the corners
  float volume_;    // signed, of the parallelepiped of p0, e1, e2
  float solid_angle_;
};

}  // namespace etendue
