#include "bsdf_analysis/albedo.h"

#include <algorithm>
#include <cmath>

#include "bsdf_analysis/replicates.h"

namespace etendue::bsdf_analysis {
namespace {

constexpr double kTabulatedAngles[] = {0,  10, 20, 30, 40, 45, 50, 55, 60,   65, 70,  75,
                                       78, 80, 82, 84, 85, 86, 87, 88, 88.5, 89, 89.5};

}  // namespace

// Light arrives from the given direction and leaves in the sampled ones, so the lobes are sampled as for importance.
Albedo albedo_at(const Lobes& lobes, double degrees, const AlbedoOptions& options) {
  const Vec3 from = direction(degrees, options.azimuth);
  Albedo albedo;
  albedo.degrees = degrees;
  const uint32_t each = std::max(1U, options.samples / kReplicates);
  const float share = 1 / static_cast<float>(each * kReplicates);
  Replicates sums;
  for (uint32_t r = 0; r < kReplicates; ++r) {
    Rgb sum(0);
    for (uint32_t i = 0; i < each; ++i) {
      LobeSample<Rgb> s;
      if (!lobes.sample(from, draw_of(r, i), TransportMode::importance, s)) continue;
      const Rgb part = s.weight * share;
      Rgb& kind = s.type == ScatterType::diffuse  ? albedo.diffuse
                  : s.type == ScatterType::glossy ? albedo.glossy
                                                  : albedo.specular;
      kind += part;
      albedo.value += part;
      sum += s.weight;
      if (s.wi.z * from.z < 0) albedo.transmitted += part;
    }
    sums.add(static_cast<double>(max_component(sum)) / each);
  }
  albedo.error = sums.standard_error();
  return albedo;
}

std::vector<Albedo> albedo_curve(const Lobes& lobes, bool inside, const AlbedoOptions& options,
                                 const KeepGoing& keep_going) {
  std::vector<Albedo> curve;
  for (const double degrees : kTabulatedAngles) {
    if (!should_continue(keep_going)) break;
    curve.push_back(albedo_at(lobes, inside ? 180 - degrees : degrees, options));
  }
  return curve;
}

double hemispherical_albedo(const std::vector<Albedo>& curve) {
  constexpr double kRadians = 3.14159265358979323846 / 180;
  double sum = 0, total = 0;
  // Trapezoidal rule in sin^2(theta), in which the cosine-weighted hemisphere has a constant density.
  for (size_t i = 0; i + 1 < curve.size(); ++i) {
    const double a = std::pow(std::sin(curve[i].degrees * kRadians), 2),
                 b = std::pow(std::sin(curve[i + 1].degrees * kRadians), 2);
    sum += 0.5 * (b - a) * static_cast<double>(average(curve[i].value) + average(curve[i + 1].value));
    total += b - a;
  }
  return total > 0 ? sum / total : 0;
}

}  // namespace etendue::bsdf_analysis
