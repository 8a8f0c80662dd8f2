#include "geometry/motion.h"

namespace etendue {
namespace {

// The step before a time, and how far the time is on the way to the next.
struct Moment {
  size_t step;
  float part;
};

Moment moment(float time, size_t steps) {
  const auto segments = static_cast<float>(steps - 1);
  const float at = time * segments, step = std::min(std::floor(at), segments - 1);
  return {static_cast<size_t>(step), at - step};
}

template <class T>
T between(const T& a, const T& b, float part) {
  return a * (1 - part) + b * part;
}

template <class T>
T weighted(const std::vector<T>& values, const Triangle& t, float u, float v) {
  return values[t[0]] * (1 - u - v) + values[t[1]] * u + values[t[2]] * v;
}

bool mirrors(const Mat4& m) { return glm::determinant(Mat3(m)) < 0; }

}  // namespace

Mat4 Motion::matrix_at(float time) const {
  const Moment m = moment(time, to_world.size());
  return between(to_world[m.step], to_world[m.step + 1], m.part);
}

Facet Motion::facet_at(const Mesh& mesh, const Triangle& t, float time) const {
  if (!deforms()) {
    const Mat4 m = matrix_at(time);
    const auto corner = [&](size_t i) { return Vec3(m * Vec4(mesh.positions[t[i]], 1)); };
    return {corner(0), corner(1), corner(2), mirrors(m) ? -1.0f : 1.0f};
  }
  const Moment m = moment(time, vertices.size());
  const auto &before = vertices[m.step].positions, &after = vertices[m.step + 1].positions;
  const auto corner = [&](size_t i) { return between(before[t[i]], after[t[i]], m.part); };
  return {corner(0), corner(1), corner(2), mirrored ? -1.0f : 1.0f};
}

Vec3 Motion::normal_at(const Mesh& mesh, const Triangle& t, float u, float v, float time) const {
  if (!deforms()) return glm::transpose(glm::inverse(Mat3(matrix_at(time)))) * weighted(mesh.normals, t, u, v);
  const Moment m = moment(time, vertices.size());
  return between(weighted(vertices[m.step].normals, t, u, v), weighted(vertices[m.step + 1].normals, t, u, v), m.part);
}

Vec4 Motion::tangent_at(const Mesh& mesh, const Triangle& t, float u, float v, float time) const {
  if (!deforms()) {
    const Vec4 tangent = weighted(mesh.tangents, t, u, v);
    return Vec4(Mat3(matrix_at(time)) * Vec3(tangent), tangent.w);
  }
  const Moment m = moment(time, vertices.size());
  return between(weighted(vertices[m.step].tangents, t, u, v), weighted(vertices[m.step + 1].tangents, t, u, v),
                 m.part);
}

}  // namespace etendue
