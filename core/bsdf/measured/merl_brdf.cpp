#include "bsdf/measured/merl_brdf.h"

#include <cstring>

#include "base/file.h"
#include "bsdf/measured/value_limit.h"
#include "bsdf/microfacet/half_vector.h"

namespace etendue {
namespace {

constexpr int kMaxCells = 1000;  // along one axis

// Interpolation between the midpoints of two cells: t = 0 at `first`, 1 at `second`.
struct CellPair {
  int first, second;
  float t;

  static CellPair clamped(float x, int cells) {
    const float at = std::clamp(x - 0.5f, 0.0f, static_cast<float>(cells - 1));
    const int first = std::min(static_cast<int>(at), std::max(0, cells - 2));
    return {first, std::min(first + 1, cells - 1), at - static_cast<float>(first)};
  }
  static CellPair periodic(float x, int cells) {
    const float at = x - 0.5f, floor = std::floor(at);
    const int first = (static_cast<int>(floor) % cells + cells) % cells;
    return {first, (first + 1) % cells, at - floor};
  }
};

}  // namespace

Result<MerlBrdf> MerlBrdf::read(const std::filesystem::path& path) {
  const auto bytes = read_file(path);
  if (!bytes) return bytes.error();
  const auto wrong = [&](const std::string& what) { return input_error(path.string() + ": " + what); };
  int32_t sizes[3] = {};
  if (bytes->size() < sizeof sizes) return wrong("the file is too short for a MERL measurement (.binary)");
  std::memcpy(sizes, bytes->data(), sizeof sizes);
  for (const int32_t size : sizes)
    if (size < 1 || size > kMaxCells)
      return wrong("the sizes in the header are not those of a MERL measurement (90, 90, 180)");
  const size_t cells = static_cast<size_t>(sizes[0]) * static_cast<size_t>(sizes[1]) * static_cast<size_t>(sizes[2]);
  if (bytes->size() != sizeof sizes + 3 * cells * sizeof(double))
    return wrong("the length of the file does not match the " + std::to_string(cells) +
                 " cells in three colours that its header declares");

  MerlBrdf brdf;
  brdf.theta_h_count_ = sizes[0];
  brdf.theta_d_count_ = sizes[1];
  brdf.phi_d_count_ = sizes[2];
  brdf.values_.resize(cells);
  const double scales[3] = {1.0 / 1500, 1.15 / 1500, 1.66 / 1500};
  for (size_t band = 0; band < 3; ++band)
    for (size_t k = 0; k < cells; ++k) {
      double value;
      std::memcpy(&value, bytes->data() + sizeof sizes + (band * cells + k) * sizeof value, sizeof value);
      if (!(std::abs(value) <= kMostTabulated)) return wrong("a value is not between -1e12 and 1e12");
      brdf.values_[k][static_cast<int>(band)] = static_cast<float>(std::max(0.0, value * scales[band]));
    }
  return brdf;
}

Rgb MerlBrdf::f(const Vec3& o, const Vec3& i) const {
  const HalfVector half(o, i);
  const Vec3& h = half.h;
  const float planar = std::sqrt(sqr(h.x) + sqr(h.y));
  const Vec2 azimuth = planar > 0 ? Vec2(h.x, h.y) / planar : Vec2(1, 0);
  // The tangential part of the difference vector, in the frame whose z axis is h and whose x axis lies in the plane of
  // h and the normal. The sign chooses phi_d in [0, pi].
  const Vec3 across = 0.5f * (i - o);
  const float x_d = h.z * (azimuth.x * across.x + azimuth.y * across.y) - planar * across.z;
  const float y_d = azimuth.x * across.y - azimuth.y * across.x;
  const float sign = y_d < 0 || (y_d == 0 && x_d < 0) ? -1.0f : 1.0f;
  const float phi_d = std::atan2(sign * y_d, sign * x_d);

  const float theta_h = std::atan2(planar, h.z), theta_d = std::acos(std::min(half.cosine, 1.0f));
  const auto x = CellPair::clamped(std::sqrt(theta_h * (2 / kPi)) * static_cast<float>(theta_h_count_), theta_h_count_);
  const auto y = CellPair::clamped(theta_d * (2 / kPi) * static_cast<float>(theta_d_count_), theta_d_count_);
  const auto z = CellPair::periodic(phi_d * kInvPi * static_cast<float>(phi_d_count_), phi_d_count_);
  const auto at = [&](int a, int b, int c) {
    return values_[static_cast<size_t>((a * theta_d_count_ + b) * phi_d_count_ + c)];
  };
  const auto line = [&](int a, int b) { return mix(at(a, b, z.first), at(a, b, z.second), z.t); };
  const auto plane = [&](int a) { return mix(line(a, y.first), line(a, y.second), y.t); };
  return mix(plane(x.first), plane(x.second), x.t);
}

}  // namespace etendue
