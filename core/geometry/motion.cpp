#include "geometry/motion.h"

namespace etendue {
namespace {

template <class T>
T interpolate(const T& a, const T& b, float t) {
  return a * (1 - t) + b * t;
}

template <class T>
T interpolate(const std::vector<T>& values, const Triangle& t, float u, float v) {
  return values[t[0]] * (1 - u - v) + values[t[1]] * u + values[t[2]] * v;
}

bool is_mirroring(const Mat4& m) { return glm::determinant(Mat3(m)) < 0; }

}  // namespace

Mat4 Motion::matrix_at(float time) const {
  const TimeSegment s = time_segment(time, to_world.size());
  return interpolate(to_world[s.step], to_world[s.step + 1], s.t);
}

Facet Motion::facet_at(const Mesh& mesh, const Triangle& t, float time) const {
  if (!deforms()) {
    const Mat4 m = matrix_at(time);
    const auto corner = [&](size_t i) { return Vec3(m * Vec4(mesh.positions[t[i]], 1)); };
    return {corner(0), corner(1), corner(2), is_mirroring(m) ? -1.0f : 1.0f};
  }
  const TimeSegment s = time_segment(time, vertices.size());
  const auto &before = vertices[s.step].positions, &after = vertices[s.step + 1].positions;
  const auto corner = [&](size_t i) { return interpolate(before[t[i]], after[t[i]], s.t); };
  return {corner(0), corner(1), corner(2), mirrored ? -1.0f : 1.0f};
}

Vec3 Motion::normal_at(const Mesh& mesh, const Triangle& t, float u, float v, float time) const {
  if (!deforms()) return glm::transpose(glm::inverse(Mat3(matrix_at(time)))) * interpolate(mesh.normals, t, u, v);
  const TimeSegment s = time_segment(time, vertices.size());
  return interpolate(interpolate(vertices[s.step].normals, t, u, v), interpolate(vertices[s.step + 1].normals, t, u, v),
                     s.t);
}

Vec4 Motion::tangent_at(const Mesh& mesh, const Triangle& t, float u, float v, float time) const {
  if (!deforms()) {
    const Vec4 tangent = interpolate(mesh.tangents, t, u, v);
    return Vec4(Mat3(matrix_at(time)) * Vec3(tangent), tangent.w);
  }
  const TimeSegment s = time_segment(time, vertices.size());
  return interpolate(interpolate(vertices[s.step].tangents, t, u, v),
                     interpolate(vertices[s.step + 1].tangents, t, u, v), s.t);
}

}  // namespace etendue
