// Perturbations: small changes of a path that keep its number of edges and its specular vertices.
//                               [Lang, sec. 9.4.2, eq. 9.123, 9.124, Remark 9.22; Veach and Guibas 1997, sec. 5.3, 5.4]
//
// Vertices are retraced from one end of the path: its first ray is moved a little, specular directions are recomputed,
// and the first other vertex is connected to the unchanged rest. The displacement of the ray is symmetric in the image
// or in angle, and specular directions have probability 1, so T(x -> y) / f(y) contains only factors of f. In
// scattering media, the ends of the retraced edges are sampled by free flights, whose densities T contains as well;
// vertices on surfaces and in volumes may replace each other.
#pragma once
#include "integrator/mlt/path_space.h"

namespace etendue::integrator {

// The perturbations that are applicable to a path. Those from the camera retrace the vertices down to `end`: at 0 they
// hit the light, else they are connected to the previous vertex.
struct PathShape {
  int lens_end = -1;       // lens perturbation: ES*(D|L) and a connectible vertex beyond D; -1: not applicable
  int chain_end = -1;      // multi-chain perturbation: the same for E(S*D)+S+ D(D|L)
  int caustic_start = -1;  // caustic perturbation: (D|L)S*DE, the vertex whose ray is moved
};

template <class M>
PathShape shape_of(const LightPath<M>& x) {
  PathShape shape;
  // The next vertex toward the light that is not specular; 0 is the light.
  const auto next = [&](int i) {
    do --i;
    while (i > 0 && x[i].delta);
    return std::max(i, 0);
  };
  const auto connects = [&](int end) { return end == 0 ? x.light.extended : end == 1 || !x[end - 1].delta; };
  const int k = x.edges();
  int end = next(k);
  if (connects(end)) {
    shape.lens_end = end;
  } else if (end > 0) {
    do end = next(end);
    while (end > 1 && x[end - 1].delta);
    if (connects(end)) shape.chain_end = end;
  }
  if (k > 1 && !x[k - 1].delta) shape.caustic_start = next(k - 1);
  return shape;
}

// A direction at a random angle to another one.
inline Vec3 perturb_direction(const Vec3& direction, const LogUniform& angles, ChainRandom& random) {
  const float theta = angles.sample(random.next()), phi = 2 * kPi * random.next(), sine = std::sin(theta);
  const Frame frame(direction);
  return glm::normalize(direction * std::cos(theta) + (frame.x * std::cos(phi) + frame.y * std::sin(phi)) * sine);
}

inline Vec2 perturb_raster(Vec2 raster, const LogUniform& pixels, ChainRandom& random) {
  const float r = pixels.sample(random.next()), phi = 2 * kPi * random.next();
  return raster + r * Vec2(std::cos(phi), std::sin(phi));
}

// Retraces vertices k - 1 .. end of y through this image and lens point; between sequences of specular vertices,
// directions are turned by `angles`.
template <class M>
bool retrace_from_camera(const LightPath<M>& x, Vec2 raster, Vec2 lens, int end, const LogUniform& angles,
                         PathSpace<M>& space, ChainRandom& random, LightPath<M>& y) {
  const int k = x.edges();
  if (!space.is_in_image(raster)) return false;
  y.resize(k);
  y.copy_ends(x);
  for (int i = 0; i < end; ++i) y[i] = x[i];
  if (!space.trace_from_camera(raster, lens, random, y)) return false;
  for (int i = k - 1; i > end; --i) {
    y[i].delta = x[i].delta;
    y[i].transmitted = x[i].transmitted;
    DeltaDirection<typename M::Color> only;
    if (!y[i].delta)
      only.wi = perturb_direction(x.direction_to_light(i), angles, random);
    else if (!space.specular_direction(y[i], y.direction_to_camera(i), TransportMode::radiance, only))
      return false;
    if (!space.trace_to_light(i, only.wi, random, y)) return false;
  }
  if (end > 0 && !space.connect(end - 1, y)) return false;
  return space.evaluate(end - 1, k - 1, y) && (end == 0 || space.visible(end - 1, random, y));
}

// T / f of a path from retrace_from_camera.
template <class M>
double camera_retrace_density_over_f(int end, const LightPath<M>& y) {
  double f = y.brightness;
  for (int i = std::max(end, 1); i < y.edges(); ++i) f *= double{y[i].value};
  for (int i = end; i < y.edges(); ++i) f /= y.flight_to_light(i);
  if (end > 0)
    f *= y.cosine_to_camera(end - 1) * y.inverse_square(end - 1) * y.edge_value(end - 1) *
         (end > 1 ? double{y[end - 1].value} : 1);
  return 1 / f;
}

// Moves the ray from vertex `start` toward the camera. For lights at infinity the direction is kept and the origin
// moved by `angles` times `size`.
template <class M>
bool retrace_from_light(const LightPath<M>& x, int start, const LogUniform& angles, float size, PathSpace<M>& space,
                        ChainRandom& random, LightPath<M>& y) {
  const int k = x.edges();
  y.resize(k);
  y.copy_ends(x);
  for (int i = 0; i <= start; ++i) y[i] = x[i];
  const Vec3& direction = x[start].direction;
  if (start == 0 && x.light.infinite) {
    const Frame frame(direction);
    const Vec2 offset = perturb_raster(Vec2(0), {angles.min * size, angles.max * size}, random);
    const Vec3 origin = x[1].point.position + frame.x * offset.x + frame.y * offset.y - direction * (2 * size);
    if (!space.trace_from_light(origin, direction, random, y)) return false;
  } else {
    const Vec3 perturbed = perturb_direction(direction, angles, random);
    if (!(start == 0 ? space.trace_from_light(x[0].point.position, perturbed, random, y)
                     : space.trace_to_camera(start, perturbed, random, y)))
      return false;
  }
  for (int i = start + 1; i < k - 1; ++i) {
    y[i].delta = true;
    y[i].transmitted = x[i].transmitted;
    DeltaDirection<typename M::Color> only;
    if (!space.specular_direction(y[i], y.direction_to_light(i), TransportMode::importance, only)) return false;
    if (!space.trace_to_camera(i, only.wi, random, y)) return false;
  }
  return space.connect(k - 1, y) && space.evaluate(start, k - 1, y) && space.visible(k - 1, random, y);
}

// T / f of a path from retrace_from_light.
template <class M>
double light_retrace_density_over_f(int start, const LightPath<M>& y) {
  const int k = y.edges();
  double f = y.brightness * y.cosine_to_camera(start);
  if (start > 0) f *= double{y[start].value};
  for (int i = start + 1; i < k; ++i)
    f *= y[i].value / double{y[i].delta ? y[i].projected_ratio : 1} * y.cosine_to_camera(i) / y.cosine_to_light(i);
  for (int i = start; i < k - 1; ++i) f /= y.flight_to_camera(i);
  return 1 / (f * y.edge_value(k - 1) * double{y.importance});
}

}  // namespace etendue::integrator
