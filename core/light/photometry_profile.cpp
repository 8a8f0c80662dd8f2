#include "light/photometry_profile.h"

#include <algorithm>
#include <cmath>

namespace etendue {
namespace {

// The interval of ascending angles that contains x, and the position in it; `inside` is false beyond the angles.
struct Position {
  size_t first = 0, second = 0;
  float t = 0;
  bool inside = false;
};

Position position_in(const std::vector<float>& angles, float x) {
  constexpr float kRounding = 1e-5f;
  if (!(x >= angles.front() - kRounding && x <= angles.back() + kRounding)) return {};
  const auto above = std::upper_bound(angles.begin(), angles.end(), x);
  const auto second = std::clamp<size_t>(static_cast<size_t>(above - angles.begin()), 1, angles.size() - 1);
  const size_t first = second - 1;
  const float width = angles[second] - angles[first];
  return {first, second, width > 0 ? std::clamp((x - angles[first]) / width, 0.0f, 1.0f) : 0, true};
}

// The integral of f sin over [p, q], where f is linear from fp to fq.
double integral_times_sine(double p, double q, double fp, double fq) {
  if (!(q > p)) return 0;
  const double slope = (fq - fp) / (q - p);
  return fp * std::cos(p) - fq * std::cos(q) + slope * (std::sin(q) - std::sin(p));
}

}  // namespace

PhotometryProfile::PhotometryProfile(Type type, std::vector<float> polar, std::vector<float> azimuths,
                                     std::vector<float> values)
    : type_(type), polar_(std::move(polar)), azimuths_(std::move(azimuths)), values_(std::move(values)) {
  integrate();
}

void PhotometryProfile::integrate() {
  double sum = 0;
  for (size_t a = 0; a + 1 < azimuths_.size(); ++a)
    for (size_t p = 0; p + 1 < polar_.size(); ++p) {
      const double low = 0.5 * (double{value(a, p)} + double{value(a + 1, p)});
      const double high = 0.5 * (double{value(a, p + 1)} + double{value(a + 1, p + 1)});
      sum += (double{azimuths_[a + 1]} - double{azimuths_[a]}) *
             integral_times_sine(double{polar_[p]}, double{polar_[p + 1]}, low, high);
    }
  flux_ = static_cast<float>(std::max(sum, 0.0));
  largest_ = *std::ranges::max_element(values_);
  solid_angle_ =
      (azimuths_.back() - azimuths_.front()) * std::max(std::cos(polar_.front()) - std::cos(polar_.back()), 1e-6f);
}

float PhotometryProfile::intensity(const Vec3& d) const {
  float along = 0, azimuth = 0;
  switch (type_) {
    case Type::c:
      along = -d.z;
      azimuth = std::atan2(d.y, d.x);
      if (azimuth < azimuths_.front()) azimuth += 2 * kPi;
      break;
    case Type::b:
      along = d.x;
      azimuth = std::atan2(d.y, -d.z);
      break;
    case Type::a:
      along = d.y;
      azimuth = std::atan2(d.x, -d.z);
      break;
  }
  const Position p = position_in(polar_, std::acos(std::clamp(along, -1.0f, 1.0f)));
  const Position a = position_in(azimuths_, azimuth);
  if (!p.inside || !a.inside) return 0;
  const float low = value(a.first, p.first) * (1 - p.t) + value(a.first, p.second) * p.t;
  const float high = value(a.second, p.first) * (1 - p.t) + value(a.second, p.second) * p.t;
  return low * (1 - a.t) + high * a.t;
}

float PhotometryProfile::tilt_factor(float angle) const {
  if (tilt_angles_.empty()) return 1;
  const float within = std::clamp(angle, tilt_angles_.front(), tilt_angles_.back());
  if (tilt_angles_.size() == 1) return tilt_factors_.front();
  const Position p = position_in(tilt_angles_, within);
  return tilt_factors_[p.first] * (1 - p.t) + tilt_factors_[p.second] * p.t;
}

Vec3 PhotometryProfile::sample_direction(Vec2 u) const {
  const float low = std::cos(polar_.back()), high = std::cos(polar_.front());
  const float along = low + u.x * (high - low);
  const float across = safe_sqrt(1 - along * along);
  const float azimuth = azimuths_.front() + u.y * (azimuths_.back() - azimuths_.front());
  const float x = across * std::cos(azimuth), y = across * std::sin(azimuth);
  if (type_ == Type::c) return {x, y, -along};
  return type_ == Type::b ? Vec3(along, y, -x) : Vec3(y, along, -x);
}

PhotometryProfile PhotometryProfile::sampled(float (*intensity)(float, float)) {
  constexpr int kPolar = 181, kAzimuths = 37;
  std::vector<float> polar, azimuths, values;
  for (int p = 0; p < kPolar; ++p) polar.push_back(kPi * static_cast<float>(p) / (kPolar - 1));
  for (int a = 0; a < kAzimuths; ++a) azimuths.push_back(2 * kPi * static_cast<float>(a) / (kAzimuths - 1));
  for (const float a : azimuths)
    for (const float p : polar) values.push_back(intensity(p, a));
  return {Type::c, std::move(polar), std::move(azimuths), std::move(values)};
}

}  // namespace etendue
