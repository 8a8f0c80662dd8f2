// MIS weights of bidirectional techniques, in constant time per technique.
//                                [Lang, sec. 9.3, eq. 9.104-9.110, corrected; van Antwerpen 2011; Georgiev et al. 2012]
//
// A path x_0 .. x_k can be sampled with i vertices from the light and the rest from the camera, i = 0 .. k + 1, with
// the density p_i in area measure. The weight of the technique with s vertices from the light is
//
//   w_s = 1 / (sum over i of (p_i / p_s)^beta) = 1 / (1 + S_light + S_camera)
//
// The terms with i < s differ from p_s only at the light's end of the path, those with i > s only at the camera's end.
// Ratios of neighbours are p_i / p_i+1 = back_i / ahead_i, the densities of vertex i as sampled from its neighbours on
// either side. So for a subpath with n vertices v_0 .. v_{n-1}
//
//   S_n = (back_{n-1} / ahead_{n-1})^beta (c_{n-1} + S_{n-1})
//
// where c_i is 1 if the technique with i vertices of this side exists: neither end of its connection is specular. Each
// vertex stores the partial sum of its subpath, except for the factor that depends on the next vertex: `weighted_sum`
// is to be multiplied by (reverse density per solid angle)^beta.
//
// Light samples (s = 1) of camera vertices may choose a light with another probability than light subpaths do: the light
// tree depends on the receiver. With the ratio r of these probabilities, p_1 contains the factor r. Then c is r^beta
// instead of 1 for this technique, at v_1 of a light subpath and where a camera subpath has hit the light, and the sums
// of the technique s = 1 itself are divided by r^beta. A view of the light through the camera, (s, t) = (1, 1), is part
// of a light subpath: its r is 1.
//
// A specular vertex has the density |cos| for its direction (one per projected solid angle, equal in both directions),
// which stands for the delta that all techniques have in common. The first vertex of an infinite light is a direction:
// its densities are per solid angle, those of the second vertex per area perpendicular to it.
//
// A vertex in a scattering medium has a cosine of 1. Its density per volume contains the extinction coefficient there,
// in whichever direction it is sampled. The coefficient cancels from all ratios and is left out; the probabilities that
// free flights pass the segments between the vertices remain. They are means over the colour channels, and in
// heterogeneous media approximations from the mean densities of coarse cells (approximate_depth). In homogeneous media
// without colour these are the densities. Other values do not make estimates biased: the weights are functions of the
// vertices of the path alone and sum to 1 over its techniques, because all of them use the same value for a segment.
// Let technique s sample paths with the density p_s, and let its estimate, given the path, have the mean f / p_s, as
// delta tracking and estimates of transmittance provide. The expectation of all techniques together is then
//
//   sum over s of  int w_s (f / p_s) p_s  =  int f  sum over s of w_s  =  int f
//
// Vertex merging [Georgiev et al. 2012] adds techniques. A light subpath and a camera subpath that both end at vertex i,
// within a distance r of each other, have the density p_i,merge = p_i eta ahead_i, where eta is pi r^2 times the number of
// light subpaths. The sums then also contain the merges at each vertex of the subpath that can be merged. Vertices in
// media, on specular surfaces and on surfaces that are chosen by their roughness cannot:
//
//   S_n = (back_{n-1} / ahead_{n-1})^beta (c_{n-1} + (eta ahead_{n-1})^beta + S_{n-1})
//
// The weight of a merge at vertex i, which ends subpaths of both sides, is
//
//   w = 1 / (1 + (c_i + S_i)_light / (eta ahead_i)_light^beta + (c_i + S_i)_camera / (eta ahead_i)_camera^beta)
#pragma once
#include "transport/mis/mis.h"

namespace etendue::transport {

// Combines ratios of densities: sums of powers, or the maximum.
class MisRule {
 public:
  // Where all densities are equal (a sphere seen from inside), ties would make the maximum heuristic count paths twice
  // or not at all. It prefers techniques with fewer camera vertices by a factor of 0.999 each.
  enum class Side { light, camera };

  // `merges` is eta; 0: vertices are not merged.
  MisRule(MisHeuristic heuristic, Side side, float merges = 0)
      : heuristic_(heuristic),
        merges_(merges),
        tie_break_(heuristic != MisHeuristic::maximum ? 1
                   : side == Side::light              ? 0.999f
                                                      : 1 / 0.999f) {}

  // The power of a factor of a ratio of densities.
  float power(float part) const {
    const float x = std::min(part, kMaxRatio);
    return heuristic_ == MisHeuristic::power ? x * x : x;
  }
  // The power of a ratio, or of the factor that represents the whole ratio in ties.
  float ratio(float r) const { return power(r * tie_break_); }
  // The term of merging at a vertex with this density, relative to the connection there.
  float merge(float pdf) const { return power(merges_ * pdf); }
  bool merges() const { return merges_ > 0; }
  float combine(float a, float b) const {
    return std::min(heuristic_ == MisHeuristic::maximum ? std::max(a, b) : a + b, kMaxSum);
  }
  // The product of a sum and a ratio.
  static float product(float sum, float ratio) { return std::min(sum * ratio, kMaxSum); }
  // `light` and `camera` are the sums S of both sides.
  static float weight(MisHeuristic heuristic, float light, float camera) {
    if (heuristic == MisHeuristic::maximum) return std::max(light, camera) < 1 ? 1.0f : 0.0f;
    return 1 / (1 + light + camera);
  }

 private:
  // The squares of larger ratios overflow.
  static constexpr float kMaxRatio = 1e15f;
  // Sums stay finite, since they may be multiplied by 0.
  static constexpr float kMaxSum = 1e30f;

  MisHeuristic heuristic_;
  float merges_;
  float tie_break_;
};

// The MIS quantities of a vertex v_j of a subpath.
struct MisVertex {
  float pdf = 1;           // ahead_j: density of the vertex as sampled from the previous one, per area
  float weighted_sum = 0;  // partial sum, to be multiplied by the power of the reverse density of the previous vertex
  float connection = 0;    // c_j, as far as it is known: 0 if the previous vertex cannot be an end of a connection

  // The same in single terms, for sums over some techniques only: back_{j-1} / ahead_{j-1} without the reverse density
  // per solid angle; the ratio of vertex j - 2; c_{j-1}.
  float reverse_ratio = 0, previous_ratio = 0;
  float previous_connection = 0;

  // S of the subpath that ends at this vertex and is continued by a connection. `reverse_pdf` is the density of this
  // vertex as sampled from the other end, per area; `previous_reverse_pdf` that of the direction to the previous
  // vertex, per solid angle. `mergeable`: the other subpath can be merged with this one here.
  float sum(const MisRule& rule, float reverse_pdf, float previous_reverse_pdf, bool mergeable = false) const {
    float before = sum_before(rule, previous_reverse_pdf);
    if (mergeable && rule.merges()) before = rule.combine(before, rule.merge(pdf));
    return rule.ratio(reverse_pdf / pdf) * before;
  }
  // c_j + S_j.
  float sum_before(const MisRule& rule, float previous_reverse_pdf) const {
    return rule.combine(connection, rule.power(previous_reverse_pdf) * weighted_sum);
  }
};

// S_{j+1} summed over the techniques for which enabled(number of vertices of this side) holds; vertex(i) is v_i, 1 <= i
// <= j.
template <class VertexOf, class Enabled>
float sum_of_terms(const MisRule& rule, int j, float reverse_pdf, float previous_reverse_pdf, VertexOf&& vertex,
                   Enabled&& enabled) {
  float sum = 0, product = 1;
  const auto add = [&](int count, float ratio, float connection) {
    product *= rule.ratio(ratio);
    if (connection > 0 && enabled(count)) sum = rule.combine(sum, product * connection);
  };
  const MisVertex& last = vertex(j);
  add(j, reverse_pdf / last.pdf, last.connection);
  add(j - 1, previous_reverse_pdf * last.reverse_ratio, last.previous_connection);
  for (int i = j; i >= 2; --i) add(i - 2, vertex(i).previous_ratio, vertex(i - 1).previous_connection);
  return sum;
}

// Computes the MIS quantities of the vertices of a subpath as it is sampled.
class MisChain {
 public:
  // Starts at the first vertex. `can_be_hit`: subpaths from the other side can hit it (an emitting surface, a lens).
  // `infinite`: it is infinitely far away.
  void start(float density, bool can_be_hit, bool infinite) {
    pdf_forward_ = density;
    previous_ratio_ = 0;
    partial_sum_ = can_be_hit ? 1.0f : 0.0f;
    previous_connection_ = partial_sum_;
    connection_ = 1;
    infinite_ = infinite;
  }
  // Sets the sampled direction: its density per solid angle (`infinite`: per area perpendicular to it), and its cosine
  // to the normal.
  void sample_direction(float pdf, float cosine) {
    pdf_ = pdf;
    cosine_ = cosine;
  }

  // Adds the next vertex; `cosine` is between the direction and the normal there. `survival` is the probability that a
  // free flight passes the segment without a collision.
  MisVertex add_vertex(const MisRule& rule, float distance_squared, float cosine, float survival = 1) {
    // In very dense media, two collisions may have the same position.
    const float squared = std::max(distance_squared, 1e-30f);
    const float per_area = infinite_ ? cosine : cosine / squared;
    const float reverse_per_area = infinite_ ? 1 : cosine_ / squared;
    return advance(rule, pdf_ * per_area * survival, reverse_per_area * survival);
  }
  // Adds a vertex at infinity. Its densities are per solid angle, reverse densities per area perpendicular to the
  // direction.
  MisVertex add_vertex_at_infinity(const MisRule& rule, float survival = 1) {
    return advance(rule, pdf_ * survival, cosine_ * survival);
  }

  // Continues from the vertex. `reverse_pdf` is the density of the direction to the previous vertex, per solid angle.
  // `mergeable`: subpaths of the other side can be merged here, unless the direction is a delta.
  void scatter(const MisRule& rule, const MisVertex& vertex, float reverse_pdf, bool delta, bool mergeable) {
    previous_connection_ = delta ? 0 : vertex.connection;
    partial_sum_ = rule.combine(previous_connection_, rule.power(reverse_pdf) * vertex.weighted_sum);
    if (rule.merges() && mergeable && !delta) partial_sum_ = rule.combine(partial_sum_, rule.merge(vertex.pdf));
    previous_ratio_ = reverse_pdf * vertex.reverse_ratio;
    connection_ = delta ? 0 : 1;
    infinite_ = false;
  }

 private:
  MisVertex advance(const MisRule& rule, float pdf, float reverse_per_area) {
    const float reverse_ratio = reverse_per_area / pdf_forward_;
    pdf_forward_ = pdf;
    return {pdf,
            MisRule::product(partial_sum_, rule.ratio(reverse_ratio)),
            connection_,
            reverse_ratio,
            previous_ratio_,
            previous_connection_};
  }

  float pdf_forward_ = 1, partial_sum_ = 0, previous_ratio_ = 0, pdf_ = 0, cosine_ = 1;
  float connection_ = 0, previous_connection_ = 0;
  bool infinite_ = false;
};

}  // namespace etendue::transport
