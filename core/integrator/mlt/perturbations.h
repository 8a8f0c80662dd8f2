// Perturbations: small changes of a path that keep its number of edges and where it is specular.    thesis 9.4.4,
// (9.123), (9.124), Remark 9.22; Veach & Guibas 1997, 5.3, 5.4
//
// From one end of a path vertices are found anew: the end's ray is moved a little, deltas are followed as they were
// before, and the first vertex that scatters otherwise is connected to the kept rest. What moves a ray is symmetric in
// picture or angle, and a delta has one direction, so that of T(X -> Y) / f(Y) the factors of f alone are left.
#pragma once
#include "integrator/mlt/path_space.h"

namespace etendue::integrator {

// Which perturbations a path admits. Those that walk from the camera end at vertex `end`, found anew: at 0 they meet
// the light, else they are connected to the vertex before.
struct PathShape {
  int lens_end = -1;       // ES*(D|L) and what the first D is connected to; -1 if there is no such thing
  int chain_end = -1;      // the same of E(S*D)+S+ D(D|L): several chains
  int caustic_start = -1;  // (D|L)S*DE: the vertex whose ray is moved
};

template <class M>
PathShape shape_of(const LightPath<M>& x) {
  PathShape shape;
  // The next vertex on the way to the light that is not specular; 0 is the light.
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

// A direction at an angle of the law to another one.
inline Vec3 turned(const Vec3& direction, const Octaves& angles, ChainRandom& random) {
  const float theta = angles.at(random.next()), phi = 2 * kPi * random.next(), across = std::sin(theta);
  const Frame frame(direction);
  return glm::normalize(direction * std::cos(theta) + (frame.x * std::cos(phi) + frame.y * std::sin(phi)) * across);
}

inline Vec2 moved(Vec2 raster, const Octaves& pixels, ChainRandom& random) {
  const float r = pixels.at(random.next()), phi = 2 * kPi * random.next();
  return raster + r * Vec2(std::cos(phi), std::sin(phi));
}

// Finds vertices k - 1 .. end of y anew, through these points of the picture and the lens; between chains of deltas
// directions are turned by `angles`.
template <class M>
bool retrace_from_camera(const LightPath<M>& x, Vec2 raster, Vec2 lens, int end, const Octaves& angles,
                         PathSpace<M>& space, ChainRandom& random, LightPath<M>& y) {
  const int k = x.edges();
  if (!space.in_picture(raster)) return false;
  y.resize(k);
  y.take_ends(x);
  for (int i = 0; i < end; ++i) y[i] = x[i];
  if (!space.leave_camera(raster, lens, random, y)) return false;
  for (int i = k - 1; i > end; --i) {
    y[i].delta = x[i].delta, y[i].transmitted = x[i].transmitted;
    DeltaDirection<typename M::Color> only;
    if (!y[i].delta)
      only.wi = turned(x.direction_to_light(i), angles, random);
    else if (!y[i].bsdf.delta_direction(y.direction_to_camera(i), y[i].transmitted, TransportMode::radiance, only))
      return false;
    if (!space.step_to_light(i, only.wi, random, y)) return false;
  }
  if (end > 0 && !space.connect(end - 1, y)) return false;
  return space.settle(end - 1, k - 1, y) && (end == 0 || space.visible(end - 1, random, y));
}

// T / f of what retrace_from_camera finds.
template <class M>
double retraced_from_camera(int end, const LightPath<M>& y) {
  double f = y.brightness;
  for (int i = std::max(end, 1); i < y.edges(); ++i) f *= double{y[i].value};
  if (end > 0) f *= y.cosine_to_camera(end - 1) * y.spread(end - 1) * (end > 1 ? double{y[end - 1].value} : 1);
  return 1 / f;
}

// Moves the ray that leaves vertex `start` for the camera. That of a light of infinity keeps its direction, and is
// moved across by as much of `size` as the angles say.
template <class M>
bool retrace_from_light(const LightPath<M>& x, int start, const Octaves& angles, float size, PathSpace<M>& space,
                        ChainRandom& random, LightPath<M>& y) {
  const int k = x.edges();
  y.resize(k);
  y.take_ends(x);
  for (int i = 0; i <= start; ++i) y[i] = x[i];
  const Vec3& direction = x[start].direction;
  if (start == 0 && x.light.infinite) {
    const Frame frame(direction);
    const Vec2 across = moved(Vec2(0), {angles.least * size, angles.most * size}, random);
    const Vec3 origin = x[1].point.position + frame.x * across.x + frame.y * across.y - direction * (2 * size);
    if (!space.leave_light(origin, direction, random, y)) return false;
  } else {
    const Vec3 other = turned(direction, angles, random);
    if (!(start == 0 ? space.leave_light(x[0].point.position, other, random, y)
                     : space.step_to_camera(start, other, random, y)))
      return false;
  }
  for (int i = start + 1; i < k - 1; ++i) {
    y[i].delta = true, y[i].transmitted = x[i].transmitted;
    DeltaDirection<typename M::Color> only;
    if (!y[i].bsdf.delta_direction(y.direction_to_light(i), y[i].transmitted, TransportMode::importance, only))
      return false;
    if (!space.step_to_camera(i, only.wi, random, y)) return false;
  }
  return space.connect(k - 1, y) && space.settle(start, k - 1, y) && space.visible(k - 1, random, y);
}

// T / f of what retrace_from_light finds.
template <class M>
double retraced_from_light(int start, const LightPath<M>& y) {
  const int k = y.edges();
  double f = y.brightness * y.cosine_to_camera(start);
  if (start > 0) f *= double{y[start].value};
  for (int i = start + 1; i < k; ++i)
    f *= y[i].value / double{y[i].delta ? y[i].stretch : 1} * y.cosine_to_camera(i) / y.cosine_to_light(i);
  return 1 / (f * double{y.importance});
}

}  // namespace etendue::integrator
