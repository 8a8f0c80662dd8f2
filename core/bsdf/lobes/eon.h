// Energy-preserving Oren-Nayar (EON).                                                         [Portsmouth et al. 2025]
//
//   f    = f_ss + f_ms
//   f_ss = rho / pi A (1 + r s / t),   s = <o_t, i_t>,   t = max(cos_o, cos_i) if s > 0, else 1,   A = 1 / (1 + c r)
//   f_ms = rho_ms / pi (1 - E(o)) (1 - E(i)) / (1 - <E>),          rho_ms = rho^2 <E> / (1 - rho (1 - <E>))
//
// o_t and i_t are the tangential parts of the directions, r the roughness, c = 1/2 - 2 / (3 pi). f_ss is Fujii's form
// of the Oren-Nayar model, E its directional albedo for rho = 1 in closed form, <E> the cosine-weighted mean of E. f
// reflects all light for rho = 1. Sampled as in the paper: a linearly transformed cosine, clipped at the horizon so
// that no sample is lost, mixed with uniform directions.
#pragma once

#include "bsdf/lobes/opaque_lobe.h"

namespace etendue {

template <class ColorType>
struct Eon : OpaqueLobe<ColorType, Eon<ColorType>, ScatterType::diffuse> {
  ColorType albedo{0};
  float roughness = 0;

  ColorType f(const Vec3& o, const Vec3& i) const {
    const float s = o.x * i.x + o.y * i.y;
    const float single = kInvPi * scale() * (1 + roughness * (s > 0 ? s / std::max(o.z, i.z) : s));
    const float mean = mean_albedo();
    const float missing = std::max(0.0f, 1 - white_albedo(o.z)) * std::max(0.0f, 1 - white_albedo(i.z));
    const float multiple = mean < 1 ? kInvPi * mean * missing / (1 - mean) : 0;
    ColorType sum = albedo * single;
    for (int k = 0; k < 3; ++k) sum[k] += sqr(albedo[k]) / (1 - albedo[k] * (1 - mean)) * multiple;
    return sum;
  }

  float density(const Vec3& o, const Vec3& i) const {
    const float uniform = uniform_probability(o.z);
    return uniform * (0.5f * kInvPi) + (1 - uniform) * TransformedCosine(o, roughness).density(i);
  }
  bool sample_direction(const Vec3& o, const LobeRandom& random, Vec3& i) const {
    const float uniform = uniform_probability(o.z);
    if (random.u.x < uniform)
      i = square_to_sphere(Vec2(0.5f * random.u.x / uniform, random.u.y));
    else
      i = TransformedCosine(o, roughness).sample(Vec2((random.u.x - uniform) / (1 - uniform), random.u.y));
    return true;
  }
  float sampling_weight(const Vec3&) const { return average(albedo); }
  float alpha() const { return 1; }

  // E, the directional albedo of f_ss for rho = 1, in closed form.
  float white_albedo(float cosine) const {
    const float sine = safe_sqrt(1 - sqr(cosine));
    const float g = sine * (std::acos(std::min(cosine, 1.0f)) - sine * cosine) +
                    2.0f / 3 * (sine * cosine * (1 + sine + sqr(sine)) / (1 + sine) - sine);
    return scale() * (1 + roughness * kInvPi * g);
  }
  // <E>, its cosine-weighted mean.
  float mean_albedo() const { return scale() * (1 + (2.0f / 3 - 28 / (15 * kPi)) * roughness); }

 private:
  // A
  float scale() const { return 1 / (1 + (0.5f - 2 / (3 * kPi)) * roughness); }

  float uniform_probability(float mu) const {
    if (roughness == 0) return 0;
    return std::pow(roughness, 0.1f) * (0.162925f + mu * (-0.372058f + (0.538233f - 0.290822f * mu) * mu));
  }

  // The paper's fit of a linear transformation M with the entries a, b, c, d. Directions are w = M h, with h
  // cosine-distributed over the part of the hemisphere that M maps above the horizon.
  struct TransformedCosine {
    float a, b, c, d;
    float visible;  // that part of the projected hemisphere
    Vec2 axis;      // azimuth of o

    TransformedCosine(const Vec3& o, float r) {
      const float mu = o.z;
      a = 1 + r * (0.303392f + (-0.518982f + 0.111709f * mu) * mu + (-0.276266f + 0.335918f * mu) * r);
      b = r * (-1.16407f + 1.15859f * mu + (0.150815f - 0.150105f * mu) * r) / (mu * mu * mu - 1.43545f);
      c = 1 + r * (0.20013f + (-0.506373f + 0.261777f * mu) * mu);
      d = r * (0.540852f + (-1.01625f + 0.475392f * mu) * mu) / (-1.0743f + (0.0725628f + mu) * mu);
      visible = 0.5f * (1 + 1 / std::sqrt(sqr(d) + 1));
      const float planar = std::sqrt(sqr(o.x) + sqr(o.y));
      axis = planar > 0 ? Vec2(o.x, o.y) / planar : Vec2(1, 0);
    }

    Vec3 sample(Vec2 u) const {
      const float r = std::sqrt(u.x), phi = 2 * kPi * u.y;
      const float y = r * std::sin(phi), half = safe_sqrt(1 - sqr(y));
      const float x = -(half + visible * (r * std::cos(phi) - half));
      const float z = safe_sqrt(1 - sqr(x) - sqr(y));
      const Vec3 w = glm::normalize(Vec3(a * x + b * z, c * y, d * x + z));
      return {axis.x * w.x - axis.y * w.y, axis.y * w.x + axis.x * w.y, w.z};
    }
    float density(const Vec3& w) const {
      const float x = axis.x * w.x + axis.y * w.y, y = axis.x * w.y - axis.y * w.x;
      const float determinant = c * (a - b * d);
      const Vec3 h(c * (x - b * w.z), (a - b * d) * y, c * (a * w.z - d * x));
      return sqr(determinant / length_squared(h)) * std::max(h.z, 0.0f) / (kPi * visible);
    }
  };
};

}  // namespace etendue
