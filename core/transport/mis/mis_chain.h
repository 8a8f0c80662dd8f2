// Weights of bidirectional sampling, in a time that does not depend on the path's length.
//                thesis 9.3, (9.104)-(9.110), errata E25, E26; van Antwerpen 2011; Georgiev et al. 2012
//
// A path x_0 .. x_k can be found with i vertices from the light and the rest from the camera, i = 0 .. k + 1, with the
// density p_i in area measure. For the one that found it with s vertices from the light the weight is
//
//   w_s = 1 / (sum over i of (p_i / p_s)^beta) = 1 / (1 + S_light + S_camera)
//
// The terms with i < s differ from p_s at the light's end of the path alone, those with i > s at the camera's. Ratios
// of neighbours are p_{i} / p_{i+1} = back_i / ahead_i, densities of vertex i as its neighbours on either side find it.
// So a subpath with n vertices v_0 .. v_{n-1} has
//
//   S_n = (back_{n-1} / ahead_{n-1})^beta (c_{n-1} + S_{n-1})
//
// where c_i is 1 if there is a technique that takes i vertices of this side: if neither end of its connection scatters
// into single directions. What the next vertices decide is left open until they are known: `open` is what
// (density back per solid angle)^beta is to be multiplied by.
//
// A vertex that scatters into a single direction has the density |cos| for it (one per projected solid angle, the same
// both ways), which stands for the delta that all techniques share. Of lights infinitely far away, the first vertex is
// a direction: its densities are per solid angle, those of the second vertex per area across it.
#pragma once
#include "transport/mis/mis.h"

namespace etendue::transport {

// How ratios are summed up: powers of the heuristic, or the largest.
class MisRule {
 public:
  // Ties between techniques would count twice, or not at all, where all densities are the same (a sphere seen from
  // inside): the maximum heuristic prefers the one with fewer vertices from the camera by a thousandth each.
  enum class Side { light, camera };

  MisRule(MisHeuristic heuristic, Side side)
      : heuristic_(heuristic),
        tie_break_(heuristic != MisHeuristic::maximum ? 1
                   : side == Side::light              ? 0.999f
                                                      : 1 / 0.999f) {}

  // Of a part of a ratio of two densities.
  float power(float part) const {
    const float x = std::min(part, kMaxRatio);
    return heuristic_ == MisHeuristic::power ? x * x : x;
  }
  // Of a ratio, or of the part of it that stands for the whole.
  float ratio(float r) const { return power(r * tie_break_); }
  float combine(float a, float b) const { return heuristic_ == MisHeuristic::maximum ? std::max(a, b) : a + b; }
  // `light` and `camera` are the S of both sides.
  static float weight(MisHeuristic heuristic, float light, float camera) {
    if (heuristic == MisHeuristic::maximum) return std::max(light, camera) < 1 ? 1.0f : 0.0f;
    return 1 / (1 + light + camera);
  }

 private:
  // The squares of larger ones are no floats.
  static constexpr float kMaxRatio = 1e15f;

  MisHeuristic heuristic_;
  float tie_break_;
};

// What a vertex v_j knows of the subpath behind it.
struct MisVertex {
  float pdf = 1;             // density of the vertex as the one before it finds it, per area
  float weighted_sum = 0;    // what the power of the density back to the vertex before is to be multiplied by
  bool connectible = false;  // the vertex before can be an end of a connection: c_j, as far as it is decided

  // The same in single terms, for sums that leave some out: what back_{j-1} / ahead_{j-1} lacks of the density back per
  // solid angle; the ratio of vertex j - 2; c_{j-1}.
  float reverse_ratio = 0, previous_ratio = 0;
  bool previous_connectible = false;

  // S of the subpath that ends here, and is continued by a connection. `back` is the density of this vertex as the
  // other end finds it, per area; `further_back` that of the direction to the vertex before, per solid angle.
  float sum(const MisRule& rule, float reverse_pdf, float previous_reverse_pdf) const {
    const float c = connectible ? 1.0f : 0.0f;
    return rule.ratio(reverse_pdf / pdf) * rule.combine(c, rule.power(previous_reverse_pdf) * weighted_sum);
  }
};

// S_{j+1} term by term, of those that counts(number of vertices of this side) admits; vertex(i) gives v_i, 1 <= i <= j.
template <class VertexOf, class Enabled>
float sum_of_terms(const MisRule& rule, int j, float reverse_pdf, float previous_reverse_pdf, VertexOf&& vertex,
                   Enabled&& enabled) {
  float sum = 0, product = 1;
  const auto add = [&](int count, float ratio, bool connectible) {
    product *= rule.ratio(ratio);
    if (connectible && enabled(count)) sum = rule.combine(sum, product);
  };
  const MisVertex& last = vertex(j);
  add(j, reverse_pdf / last.pdf, last.connectible);
  add(j - 1, previous_reverse_pdf * last.reverse_ratio, last.previous_connectible);
  for (int i = j; i >= 2; --i) add(i - 2, vertex(i).previous_ratio, vertex(i - 1).previous_connectible);
  return sum;
}

// The same while a walk goes on.
class MisChain {
 public:
  // At the first vertex. `reached`: the other side can do without it (a light that is hit, a lens that is).
  // `far`: it is infinitely far away.
  void start(float density, bool can_be_hit, bool infinite) {
    pdf_forward_ = density;
    previous_ratio_ = 0;
    partial_sum_ = can_be_hit ? 1.0f : 0.0f;
    previous_connectible_ = can_be_hit;
    connectible_ = true;
    infinite_ = infinite;
  }
  // A direction was chosen with this density per solid angle (per area across it if `far`); its cosine to the normal.
  void sample_direction(float pdf, float cosine) {
    pdf_ = pdf;
    cosine_ = cosine;
  }

  // At the next vertex: so far away, and the cosine to its normal there.
  MisVertex add_vertex(const MisRule& rule, float distance_squared, float cosine) {
    const float per_area = infinite_ ? cosine : cosine / distance_squared;
    const float reverse_per_area = infinite_ ? 1 : cosine_ / distance_squared;
    return advance(rule, pdf_ * per_area, reverse_per_area);
  }
  // The next vertex is infinitely far away. Densities there are per solid angle; those back from it are per area
  // across.
  MisVertex add_vertex_at_infinity(const MisRule& rule) { return advance(rule, pdf_, cosine_); }

  // The walk goes on from the vertex. `back` is the density of the direction to the vertex before, per solid angle.
  void scatter(const MisRule& rule, const MisVertex& vertex, float reverse_pdf, bool delta) {
    previous_connectible_ = vertex.connectible && !delta;
    partial_sum_ = rule.combine(previous_connectible_ ? 1.0f : 0.0f, rule.power(reverse_pdf) * vertex.weighted_sum);
    previous_ratio_ = reverse_pdf * vertex.reverse_ratio;
    connectible_ = !delta;
    infinite_ = false;
  }

 private:
  MisVertex advance(const MisRule& rule, float pdf, float reverse_per_area) {
    const float reverse_ratio = reverse_per_area / pdf_forward_;
    pdf_forward_ = pdf;
    return {pdf,
            partial_sum_ * rule.ratio(reverse_ratio),
            connectible_,
            reverse_ratio,
            previous_ratio_,
            previous_connectible_};
  }

  float pdf_forward_ = 1, partial_sum_ = 0, previous_ratio_ = 0, pdf_ = 0, cosine_ = 1;
  bool connectible_ = false, infinite_ = false, previous_connectible_ = false;
};

}  // namespace etendue::transport
