// The GGX distribution of microfacet normals with Smith's height-correlated masking and shadowing, anisotropic.
//
//   D(h)      = 1 / (pi a_x a_y (h_x^2 / a_x^2 + h_y^2 / a_y^2 + h_z^2)^2)
//   Lambda(w) = (sqrt(1 + (a_x^2 w_x^2 + a_y^2 w_y^2) / w_z^2) - 1) / 2
//   G1(w)     = 1 / (1 + Lambda(w)),   G2(o, i) = 1 / (1 + Lambda(o) + Lambda(i))
//
// [Walter et al. 2007; Heitz 2014]; normals are sampled in proportion to their visible area [Heitz 2018]. Reflected
// directions are sampled by those visible normals that reflect wo to a spherical cap around the upper hemisphere [Eto
// and Tokuyoshi 2023], so that few samples lie below the surface. Directions are in the shading frame, z is the
// macroscopic normal.
#pragma once
#include "base/vec.h"

namespace etendue {

// Surfaces of a smaller roughness are treated as smooth: float directions do not resolve a narrower lobe.
inline constexpr float kSmoothAlpha = 1e-4f;

struct Ggx {
  float alpha_x = 1, alpha_y = 1;
  Vec2 along{1, 0};  // unit direction of alpha_x in the tangent plane

  // D, area of microfacets per solid angle of their normal and unit surface area: the integral of D(h) cos_h is 1.
  float d(const Vec3& any_h) const {
    const Vec3 h = turned(any_h);
    const float e = sqr(h.x / alpha_x) + sqr(h.y / alpha_y) + sqr(h.z);
    return 1 / (kPi * alpha_x * alpha_y * sqr(e));
  }

  // Smith's Lambda, for directions on either side of the surface.
  float lambda(const Vec3& any_w) const {
    const Vec3 w = turned(any_w);
    const float slope2 = (sqr(alpha_x * w.x) + sqr(alpha_y * w.y)) / sqr(w.z);
    return 0.5f * (std::sqrt(1 + slope2) - 1);
  }

  // |cos| Lambda, which stays finite at grazing angles.
  float projected_lambda(const Vec3& any_w) const {
    const Vec3 w = turned(any_w);
    const float spread2 = sqr(alpha_x * w.x) + sqr(alpha_y * w.y), z = std::abs(w.z);
    return 0.5f * spread2 / std::max(std::sqrt(sqr(z) + spread2) + z, 1e-30f);
  }

  float g1(const Vec3& w) const { return 1 / (1 + lambda(w)); }

  // Masking and shadowing of two directions, on the same or on opposite sides of the surface.
  float g2(const Vec3& wo, const Vec3& wi) const { return 1 / (1 + lambda(wo) + lambda(wi)); }

  // Density of the normals visible from wo, per solid angle of h. wo.z must be positive.
  float visible_pdf(const Vec3& wo, const Vec3& h) const {
    return g1(wo) * std::max(0.0f, glm::dot(wo, h)) * d(h) / wo.z;
  }

  // Samples a normal with density visible_pdf(wo, h).
  Vec3 sample_visible(const Vec3& any_wo, Vec2 u) const {
    const Vec3 wo = turned(any_wo);
    const Vec3 v = glm::normalize(Vec3(alpha_x * wo.x, alpha_y * wo.y, wo.z));
    const float planar = v.x * v.x + v.y * v.y;
    const Vec3 t1 = planar > 0 ? Vec3(-v.y, v.x, 0) / std::sqrt(planar) : Vec3(1, 0, 0);
    const Vec3 t2 = glm::cross(v, t1);
    const float r = std::sqrt(u.x);
    const float phi = 2 * kPi * u.y;
    const float p1 = r * std::cos(phi);
    const float s = 0.5f * (1 + v.z);
    const float p2 = (1 - s) * safe_sqrt(1 - p1 * p1) + s * r * std::sin(phi);
    const Vec3 n = p1 * t1 + p2 * t2 + safe_sqrt(1 - p1 * p1 - p2 * p2) * v;
    const Vec3 h = glm::normalize(Vec3(alpha_x * n.x, alpha_y * n.y, std::max(1e-7f, n.z)));
    return Vec3(along.x * h.x - along.y * h.y, along.y * h.x + along.x * h.y, h.z);
  }

  // Samples the mirror direction of wo about a visible normal. wo.z must be positive; the result can lie below the
  // surface.
  Vec3 sample_reflection(const Vec3& any_wo, Vec2 u) const {
    const Vec3 wo = turned(any_wo);
    const Vec3 v = glm::normalize(Vec3(alpha_x * wo.x, alpha_y * wo.y, wo.z));
    const float cap = cap_factor(wo) * v.z;
    const float z = (1 - u.x) * (1 + cap) - cap, r = safe_sqrt(1 - z * z), phi = 2 * kPi * u.y;
    const Vec3 n(v.x + r * std::cos(phi), v.y + r * std::sin(phi), std::max(v.z + z, 1e-7f));
    const Vec3 h = glm::normalize(Vec3(alpha_x * n.x, alpha_y * n.y, n.z));
    const Vec3 wi = 2 * glm::dot(wo, h) * h - wo;
    return Vec3(along.x * wi.x - along.y * wi.y, along.y * wi.x + along.x * wi.y, wi.z);
  }

  // Density of `sample_reflection` per solid angle of wi. h is the half vector, above the surface.
  float reflection_pdf(const Vec3& any_wo, const Vec3& h) const {
    const Vec3 wo = turned(any_wo);
    const float stretched = std::sqrt(sqr(alpha_x * wo.x) + sqr(alpha_y * wo.y) + sqr(wo.z));
    return d(h) / (2 * (cap_factor(wo) * wo.z + stretched));
  }

  // The roughness alpha in the plane of w and the normal.
  float alpha_along(const Vec3& any_w) const {
    if (alpha_x == alpha_y) return alpha_x;
    const Vec3 w = turned(any_w);
    const float planar2 = sqr(w.x) + sqr(w.y);
    return planar2 > 0 ? std::sqrt((sqr(alpha_x * w.x) + sqr(alpha_y * w.y)) / planar2) : std::sqrt(alpha_x * alpha_y);
  }

 private:
  // k of [Eto and Tokuyoshi 2023, eq. 5]: the cap reaches down to -k v_z, with the stretched direction v of wo.
  float cap_factor(const Vec3& wo) const {
    const float a2 = sqr(std::min(alpha_x, alpha_y)), s2 = sqr(1 + std::sqrt(sqr(wo.x) + sqr(wo.y)));
    return (1 - a2) * s2 / (s2 + a2 * sqr(wo.z));
  }

  // The direction in the frame whose x axis is the axis of alpha_x.
  Vec3 turned(const Vec3& w) const { return Vec3(along.x * w.x + along.y * w.y, along.x * w.y - along.y * w.x, w.z); }
};

// The mirror direction of wo about h.
inline Vec3 reflect(const Vec3& wo, const Vec3& h) { return 2 * glm::dot(wo, h) * h - wo; }

}  // namespace etendue
