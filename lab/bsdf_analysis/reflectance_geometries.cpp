#include "bsdf_analysis/reflectance_geometries.h"

#include <algorithm>
#include <cmath>

#include "base/frame.h"
#include "base/hash.h"
#include "base/warp.h"
#include "bsdf_analysis/replicates.h"

namespace etendue::bsdf_analysis {
namespace {

constexpr double kPiD = 3.14159265358979323846;

// The part of a hemisphere that a cone covers. Its side is that of the axis.
class Cone {
 public:
  Cone(const Vec3& axis, double half_angle_degrees)
      : axis_(axis), frame_(axis), cosine_(static_cast<float>(std::cos(half_angle_degrees * kPiD / 180))) {}

  bool contains(const Vec3& w) const { return w.z * axis_.z > 0 && glm::dot(w, axis_) >= cosine_; }
  // A uniform direction of the full cone; those below the horizon have to be rejected.
  Vec3 sample(Vec2 random) const {
    const float z = 1 - random.x * (1 - cosine_), r = safe_sqrt(1 - z * z), phi = 2 * kPi * random.y;
    return frame_.to_world({r * std::cos(phi), r * std::sin(phi), z});
  }
  // Of a sample, per solid angle.
  float pdf() const { return 1 / (2 * kPi * (1 - cosine_)); }
  // By a fine grid; pi sin^2 of the half angle times the cosine of the axis if the cone is above the horizon.
  double projected_solid_angle() const {
    constexpr int kSteps = 512;
    double sum = 0;
    for (int i = 0; i < kSteps; ++i)
      for (int k = 0; k < kSteps; ++k) {
        const Vec3 w = sample({(static_cast<float>(i) + 0.5f) / kSteps, (static_cast<float>(k) + 0.5f) / kSteps});
        if (w.z * axis_.z > 0) sum += std::abs(static_cast<double>(w.z));
      }
    return sum / (kSteps * kSteps) * 2 * kPiD * (1 - static_cast<double>(cosine_));
  }

 private:
  Vec3 axis_;
  Frame frame_;
  float cosine_;
};

// Random numbers of a sample besides those of its lobes, whose points have three dimensions only.
class IndependentNumbers {
 public:
  IndependentNumbers(uint32_t replicate, uint32_t i) : seed_(mix_bits((uint64_t{replicate} << 32 | i) + 1)) {}
  float operator()(uint64_t dimension) const {
    return to_unit_float(static_cast<uint32_t>(mix_bits(seed_ + dimension) >> 32));
  }

 private:
  uint64_t seed_;
};

// Incident directions with the weight of their cosine.
struct Incident {
  Vec3 direction;
  float weight;
};

class Measurement {
 public:
  Measurement(const Lobes& lobes, const ReflectanceGeometry& g)
      : lobes_(lobes),
        geometry_(g),
        incident_(direction(g.degrees)),
        leaving_(g.transmission ? -incident_ : Vec3(-incident_.x, -incident_.y, incident_.z)),
        source_(incident_, g.half_angle),
        detector_(leaving_, g.half_angle),
        detector_solid_angle_(detector_.projected_solid_angle()) {}

  Reflectance measure(Extent from, Extent to) const {
    const uint32_t each = std::max(1U, geometry_.samples / kReplicates);
    Replicates replicates;
    Rgb total(0);
    for (uint32_t r = 0; r < kReplicates; ++r) {
      Rgb sum(0);
      float weights = 0;
      for (uint32_t i = 0; i < each; ++i) {
        const LobeRandom random = draw_of(r, i);
        const IndependentNumbers numbers(r, i);
        const Incident light = incident(from, {numbers(0), numbers(1)});
        if (light.weight == 0) continue;
        weights += light.weight;
        const Vec2 in_cone{numbers(2), numbers(3)};
        sum += light.weight * (to == Extent::conical ? conical_factor(light.direction, random, in_cone)
                                                     : factor(light.direction, to, random));
      }
      if (weights == 0) continue;
      const Rgb mean = sum / weights;
      total += mean / static_cast<float>(kReplicates);
      replicates.add(static_cast<double>(max_component(mean)));
    }
    const float share = to == Extent::directional ? 0
                        : to == Extent::conical   ? static_cast<float>(detector_solid_angle_ / kPiD)
                                                  : 1;
    return {.from = from, .to = to, .factor = total, .fraction = total * share, .error = replicates.standard_error()};
  }

 private:
  Incident incident(Extent from, Vec2 random) const {
    if (from == Extent::directional) return {incident_, 1};
    if (from == Extent::hemispherical) return {square_to_cosine_hemisphere(random), 1};
    const Vec3 w = source_.sample(random);
    return {w, std::max(w.z, 0.0f)};
  }

  // An estimate of the reflectance factor for light from this direction, into a direction or a hemisphere.
  Rgb factor(const Vec3& from, Extent to, const LobeRandom& random) const {
    if (to == Extent::directional) return kPi * lobes_.eval(from, leaving_, TransportMode::importance);
    LobeSample<Rgb> s;
    if (!lobes_.sample(from, random, TransportMode::importance, s)) return Rgb(0);
    if ((s.wi.z * from.z < 0) != geometry_.transmission) return Rgb(0);
    return s.weight;
  }

  // The same into the cone of the detector: a sample of the lobes and one of the cone, combined by multiple importance sampling.
  Rgb conical_factor(const Vec3& from, const LobeRandom& random, Vec2 in_cone) const {
    const float cone_pdf = detector_.pdf();
    Rgb sum(0);
    LobeSample<Rgb> s;
    if (lobes_.sample(from, random, TransportMode::importance, s) && detector_.contains(s.wi))
      sum += s.weight * (s.delta ? 1 : s.pdf_solid_angle / (s.pdf_solid_angle + cone_pdf));
    const Vec3 wi = detector_.sample(in_cone);
    if (detector_.contains(wi)) {
      const float pdf = lobes_.pdf(from, wi, TransportMode::importance);
      sum += lobes_.eval(from, wi, TransportMode::importance) * (std::abs(wi.z) / (cone_pdf + pdf));
    }
    return sum * static_cast<float>(kPiD / detector_solid_angle_);
  }

  const Lobes& lobes_;
  ReflectanceGeometry geometry_;
  Vec3 incident_, leaving_;
  Cone source_, detector_;
  double detector_solid_angle_;
};

}  // namespace

std::array<Reflectance, 9> reflectances(const Lobes& lobes, const ReflectanceGeometry& geometry) {
  const Measurement measurement(lobes, geometry);
  std::array<Reflectance, 9> all;
  for (size_t from = 0; from < 3; ++from)
    for (size_t to = 0; to < 3; ++to)
      all[3 * from + to] = measurement.measure(static_cast<Extent>(from), static_cast<Extent>(to));
  return all;
}

}  // namespace etendue::bsdf_analysis
