// A light path as a value: the state of Markov chains over paths.
//                                                                 [Lang, sec. 8.4.3.3, 9.4.2; Veach 1997, ch. 8 and 11]
//
// A path of k edges has vertices x_0 .. x_k, x_0 on a light and x_k on the lens. Its contribution is the product
//
//   f = L_e(x_0 -> x_1)  prod over edges 0 .. k-2 of |cos_i| / r^2  prod over i = 1 .. k-1 of F_i
//       |cos_{k-1}| d(raster) / d(area across the ray)
//
// with F_i = f_s |cos| in the direction of radiance transport, relative to the product of area measures. For an
// infinite light x_0 is a direction (per solid angle, without r^2); for a light without extent, its index. x_k is the
// point of the unit square from which the lens point is made. The integral of f is the sum over all pixels of the
// image. (A directly visible infinite light is measured per image point instead: f = L_e.)
//
// A point of a medium that emits is a light, too: L_e is the emission coefficient, the measure is that of volumes, and
// the cosine is 1. Only light subpaths find it.
//
// In media, f contains the transmittance of every edge. A vertex in a volume has a cosine of 1, F_i is the phase
// function times the scattering coefficient, and the measure is that of volumes. A free flight along an edge ends there
// with the density sigma_t T per metre, and passes the edge with the probability T; both are means over the colour
// channels, of which a flight selects one with the same probability. Densities contain them with exact transmittances,
// also in heterogeneous media.
//
// Specular vertices: F_i is the coefficient of the delta, and densities are probabilities relative to the delta of a
// subpath from the camera. The delta of a light subpath differs by the ratio of projected solid angles,
// `projected_ratio`.
//
// Densities occur only in quotients with f. They are computed factor by factor, so that long paths neither overflow nor
// underflow.
#pragma once
#include <vector>

#include "transport/path_expression/class_shares.h"
#include "transport/wavefront/path_media.h"

namespace etendue::integrator {

template <class M>
struct PathVertexData {
  using Color = typename M::Color;
  scene::SurfacePoint point;  // point lights: the position alone; infinite lights: unused
  Bsdf<M> bsdf;
  Hit hit;                                  // the ray hit that `point` was computed from
  Vec3 traced_from{0};                      // the direction toward the origin of the ray that hit it
  bool delta = false, transmitted = false;  // the kind of scattering at the vertex

  Color color{1};                     // F / value
  float value = 1;                    // largest component of F
  float to_light = 0, to_camera = 0;  // densities of the directions to both neighbours, per solid angle
  float projected_ratio = 1;

  // The edge to the next vertex toward the camera.
  Vec3 direction{0};
  float length = 0;  // metres, or infinite

  // In models with media: the solids around the vertex, and the transmittance of the edge.
  struct Media {
    scene::MediumInterface interface;
    Color transmittance{1};
  };
  // In models with scattering media also the probabilities that flights in each channel pass the edge, and the
  // coefficients at the vertex, 1/m; 1 on surfaces.
  struct ScatteringMedia : Media {
    Color survival{1};
    Color scattering{1}, extinction{1};
    bool in_volume = false;
  };
  [[no_unique_address]] std::conditional_t<M::kScattering, ScatteringMedia,
                                           std::conditional_t<M::kMedia, Media, transport::Vacuum>>
      media;
};

template <class M>
struct PathVertex : PathVertexData<M> {
  PathVertex() = default;
  PathVertex(const PathVertex& other) : PathVertexData<M>(other) { refer(); }
  PathVertex& operator=(const PathVertex& other) {
    PathVertexData<M>::operator=(other);
    refer();
    return *this;
  }

 private:
  void refer() { this->bsdf.rebind(this->point.shading, this->point.ng); }
};

template <class M>
class LightPath {
 public:
  using Color = typename M::Color;
  using Vertex = PathVertex<M>;

  struct Light {
    static constexpr uint32_t kUnlisted = scene::InstanceData::kNotALight;
    LightKind kind = LightKind::triangle;
    uint32_t number = kUnlisted;  // index in the light table; kUnlisted for the environment
    bool infinite = false, extended = true;
    float first = 0, second = 0;  // densities as in EmissionDensity
    Color emitted{0};
  };

  Light light;
  Vec2 raster{0}, lens{0};  // pixels; a point of the unit square
  float time = 0;           // from 0 at the shutter's opening to 1 at its closing
  float importance = 0;     // pixels per square metre across the last edge; infinite lights: per solid angle
  Color color{0};           // f, scaled to a luminance of one
  double brightness = 0;    // luminance of f, divided by all factors that the functions below compute

  int edges() const { return static_cast<int>(vertices_.size()); }
  void resize(int edges) { vertices_.resize(static_cast<size_t>(edges)); }
  Vertex& operator[](int i) { return vertices_[static_cast<size_t>(i)]; }
  const Vertex& operator[](int i) const { return vertices_[static_cast<size_t>(i)]; }

  const Vec3& direction_to_camera(int i) const { return (*this)[i].direction; }
  Vec3 direction_to_light(int i) const { return -(*this)[i - 1].direction; }
  bool is_surface(int i) const { return i > 0 || light.kind == LightKind::triangle; }

  // Copies everything except the vertices.
  void copy_ends(const LightPath& other) {
    light = other.light;
    raster = other.raster;
    lens = other.lens;
    time = other.time;
    importance = other.importance;
  }

  // The cosines at vertex i of its two edges, and the inverse square of the length of edge i.
  double cosine_to_camera(int i) const { return is_surface(i) ? cosine(i, (*this)[i].direction) : 1; }
  double cosine_to_light(int i) const { return cosine(i, (*this)[i - 1].direction); }
  double inverse_square(int i) const { return i == 0 && light.infinite ? 1 : 1 / sqr(double{(*this)[i].length}); }

  // ---- Densities divided by their factors of f.

  // The largest component of the transmittance of edge i: the factor of f that belongs to the edge. 1 in models without
  // scattering media, where `brightness` contains it.
  double edge_value([[maybe_unused]] int i) const {
    if constexpr (M::kScattering)
      return max_component((*this)[i].media.transmittance);
    else
      return 1;
  }
  // Free flights along edge i that end at its end towards the camera, or towards the light.
  double flight_to_camera(int i) const { return i + 1 < edges() ? flight(i, i + 1) : 1; }
  double flight_to_light(int i) const { return flight(i, i); }

  // The step from vertex i of a light subpath to the next vertex; i = -1 is the choice of x_0.
  double step_from_light(int i) const {
    if (i < 0) return light.first;
    if (i == 0) return light.second / cosine_to_camera(0) * flight_to_camera(0);
    const Vertex& v = (*this)[i];
    return v.to_camera / (v.value * cosine_to_camera(i)) * cosine_to_light(i) * flight_to_camera(i);
  }
  // The step from vertex i of a camera subpath; `area` is that of the image in pixels.
  double step_from_camera(int i, double area) const {
    if (i > edges()) return 1;
    if (i == edges()) return flight_to_light(i - 1) / area;
    return double{(*this)[i].to_light} / (*this)[i].value * flight_to_light(i - 1);
  }
  // The inverse of the factors of f of a connection along edge i, zero if it is impossible; i = -1: the camera subpath
  // hits the light.
  double connection(int i) const {
    if (i < 0) return light.extended ? 1 : 0;
    const int last = edges() - 1;
    if ((i > 0 && (*this)[i].delta) || (i < last && (*this)[i + 1].delta)) return 0;
    double weight = cosine_to_camera(i);
    if (i > 0) weight *= (*this)[i].value / cosine_to_light(i);
    weight *= edge_value(i) * (i == last ? double{importance} : inverse_square(i) * (*this)[i + 1].value);
    return weight > 0 ? 1 / weight : 0;
  }

  // The density of all vertices between l and m, divided by f, summed over all ways to sample them by a subpath from
  // either end and a connection; technique_probability(c) is the probability of the connection along edge c. l = -1 and
  // m = k + 1 lie beyond the ends. The lens is never hit by a light subpath.
  template <class Tried>
  double density_between(int l, int m, double area, Tried&& technique_probability) const {
    double sum = 0, camera = 1;
    for (int c = m - 1; c >= l; --c) {
      if (c < m - 1) {
        camera *= step_from_camera(c + 2, area);
        sum *= step_from_light(c);
      }
      if (c < edges()) sum += connection(c) * camera * technique_probability(c);
    }
    return sum / brightness;
  }

 private:
  double cosine(int i, const Vec3& w) const {
    if constexpr (M::kScattering)
      if ((*this)[i].media.in_volume) return 1;
    return std::abs(double{glm::dot((*this)[i].point.ng, w)});
  }
  // A free flight along edge i that ends at vertex `end`, divided by the value of the edge.
  double flight([[maybe_unused]] int i, [[maybe_unused]] int end) const {
    if constexpr (M::kScattering)
      return double{average((*this)[i].media.survival * (*this)[end].media.extinction)} / edge_value(i);
    else
      return 1;
  }

  std::vector<Vertex> vertices_;
};

}  // namespace etendue::integrator
