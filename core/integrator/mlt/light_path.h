// A light path as a value: what Markov chains over whole paths keep, change and compare.   thesis 8.3.4, 9.4.4; Veach
// 1997, chapter 8 and 11
//
// A path of k edges has vertices x_0 .. x_k, x_0 on a light and x_k on the lens. Its contribution is a product,
//
//   f = L_e(x_0 -> x_1)  prod over edges 0 .. k-2 of |cos_i| / r^2  prod over i = 1 .. k-1 of F_i
//       |cos_{k-1}| d(raster) / d(area across the ray)
//
// with F_i = f_s |cos| as the camera sees it, in the product of area measures: of a light infinitely far away the
// direction stands for x_0 (per solid angle, and no r^2), of a light without extent its number; x_k is a point of the
// unit square that the lens is made from. The sum over all pixels of a picture is the integral of f. (A light of
// infinity seen directly is measured by the point of the picture instead: f = L_e.)
//
// Deltas: F_i is the coefficient and densities are probabilities, all of them against the delta as a walk from the
// camera meets it. A walk from the light meets another one, by the ratio of projected solid angles: `stretch`.
//
// Densities matter only as quotients to f. They are taken factor by factor, so that long paths do no harm to floats.
#pragma once
#include <vector>

#include "transport/path_expression/class_shares.h"
#include "transport/wavefront/path_media.h"

namespace etendue::integrator {

template <class M>
struct PathVertexData {
  using Color = typename M::Color;
  scene::SurfacePoint point;  // of a point light its position alone, of a light of infinity nothing
  Bsdf<M> bsdf;
  Hit hit;                                  // what `point` was made from, and
  Vec3 found_from{0};                       // the direction to where it was found from
  bool delta = false, transmitted = false;  // how the light goes on here

  Color tint{1};                      // F over `value`,
  float value = 1;                    // its largest component
  float to_light = 0, to_camera = 0;  // densities of the directions to both neighbours, per solid angle
  float stretch = 1;

  // The edge to the next vertex on the way to the camera.
  Vec3 direction{0};
  float length = 0;  // metres, or infinite

  // In models with media: the solids around the vertex, and the transmittance of the edge.
  struct Media {
    scene::MediumInterface interface;
    Color transmittance{1};
  };
  [[no_unique_address]] std::conditional_t<M::kMedia, Media, transport::Vacuum> media;
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
    uint32_t number = kUnlisted;  // in the table of lights, of which the environment needs none
    bool infinite = false, extended = true;
    float first = 0, second = 0;  // densities as EmissionDensity has them
    Color emitted{0};
  };

  Light light;
  Vec2 raster{0}, lens{0};  // pixels; a point of the unit square
  float time = 0;           // from 0 at the shutter's opening to 1 at its closing
  float importance = 0;     // pixels to a square metre across the last edge (to a solid angle at infinity)
  Color color{0};           // of f, with a luminance of one
  double brightness = 0;    // luminance of f over all that the functions below know of

  int edges() const { return static_cast<int>(vertices_.size()); }
  void resize(int edges) { vertices_.resize(static_cast<size_t>(edges)); }
  void clear() { vertices_.clear(); }
  Vertex& operator[](int i) { return vertices_[static_cast<size_t>(i)]; }
  const Vertex& operator[](int i) const { return vertices_[static_cast<size_t>(i)]; }

  const Vec3& direction_to_camera(int i) const { return (*this)[i].direction; }
  Vec3 direction_to_light(int i) const { return -(*this)[i - 1].direction; }
  bool is_surface(int i) const { return i > 0 || light.kind == LightKind::triangle; }

  // Takes over all but the vertices.
  void take_ends(const LightPath& other) {
    light = other.light, raster = other.raster, lens = other.lens, time = other.time, importance = other.importance;
  }

  // Cosines at vertex i of its two edges, and what falls with the square of the length of edge i.
  double cosine_to_camera(int i) const { return is_surface(i) ? cosine(i, (*this)[i].direction) : 1; }
  double cosine_to_light(int i) const { return cosine(i, (*this)[i - 1].direction); }
  double spread(int i) const { return i == 0 && light.infinite ? 1 : 1 / sqr(double{(*this)[i].length}); }

  // ---- Densities over their part of f.

  // Of a step from vertex i of the walk from the light to the next one; from -1 it is the choice of x_0.
  double step_from_light(int i) const {
    if (i < 0) return light.first;
    if (i == 0) return light.second / cosine_to_camera(0);
    const Vertex& v = (*this)[i];
    return v.to_camera / (v.value * cosine_to_camera(i)) * cosine_to_light(i);
  }
  // Of a step from vertex i of the walk from the camera; `area` is that of the picture in pixels.
  double step_from_camera(int i, double area) const {
    if (i > edges()) return 1;
    if (i == edges()) return 1 / area;
    return double{(*this)[i].to_light} / (*this)[i].value;
  }
  // One over what a connection along edge i is worth, zero if it cannot be: at -1 the walk from the camera meets the
  // light.
  double connection(int i) const {
    if (i < 0) return light.extended ? 1 : 0;
    const int last = edges() - 1;
    if ((i > 0 && (*this)[i].delta) || (i < last && (*this)[i + 1].delta)) return 0;
    double weight = cosine_to_camera(i);
    if (i > 0) weight *= (*this)[i].value / cosine_to_light(i);
    weight *= i == last ? double{importance} : spread(i) * (*this)[i + 1].value;
    return weight > 0 ? 1 / weight : 0;
  }

  // The density of all vertices between l and m, over f, summed over all ways to find them by a walk from either end
  // and a connection of the two; tried(c) is how often that by way of edge c is looked for. l = -1 and m = k + 1 are
  // the ends beyond the path. The lens is never found by chance.
  template <class Tried>
  double density_between(int l, int m, double area, Tried&& tried) const {
    double sum = 0, camera = 1;
    for (int c = m - 1; c >= l; --c) {
      if (c < m - 1) {
        camera *= step_from_camera(c + 2, area);
        sum *= step_from_light(c);
      }
      if (c < edges()) sum += connection(c) * camera * tried(c);
    }
    return sum / brightness;
  }

 private:
  double cosine(int i, const Vec3& w) const { return std::abs(double{glm::dot((*this)[i].point.ng, w)}); }

  std::vector<Vertex> vertices_;
};

}  // namespace etendue::integrator
