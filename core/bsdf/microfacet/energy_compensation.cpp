#include "bsdf/microfacet/energy_compensation.h"

#include <map>
#include <memory>
#include <mutex>
#include <tuple>

namespace etendue {
namespace {

// Point k of Hammersley's set; `count` must be a power of two.
Vec2 hammersley_point(uint32_t k, uint32_t count) {
  uint32_t bits = 0;
  for (uint32_t bit = 1, rest = k; bit < count; bit <<= 1, rest >>= 1) bits = bits << 1 | (rest & 1);
  const auto n = static_cast<float>(count);
  return {(static_cast<float>(k) + 0.5f) / n, (static_cast<float>(bits) + 0.5f) / n};
}

// E(o): the mean of G2 / G1 over the normals visible from o that reflect o to a direction above the surface.
template <class Facets>
float albedo(const Facets& facets, const Vec3& o) {
  const uint32_t count = facets.alpha_x == facets.alpha_y ? 1024 : 512;
  const float projected_area = o.z + facets.projected_lambda(o);
  double sum = 0;
  for (uint32_t k = 0; k < count; ++k) {
    const Vec3 i = reflect(o, facets.sample_visible(o, hammersley_point(k, count)));
    if (i.z > 0) sum += 4 * i.z * projected_area * facet_visibility(facets, o, i);
  }
  return static_cast<float>(sum / count);
}

float albedo(MicrofacetDistribution kind, float alpha_x, float alpha_y, const Vec3& o) {
  if (kind == MicrofacetDistribution::ggx) return albedo(Ggx{alpha_x, alpha_y}, o);
  return albedo(Beckmann{alpha_x, alpha_y}, o);
}

// The direction with this cosine to the normal, whose tangential part has the cosine `along` to the rougher axis.
Vec3 direction(float cosine, float along, bool x_is_rougher) {
  const float sine = safe_sqrt(1 - sqr(cosine)), rougher = sine * along, other = sine * safe_sqrt(1 - sqr(along));
  return x_is_rougher ? Vec3(rougher, other, cosine) : Vec3(other, rougher, cosine);
}

}  // namespace

MicrofacetEnergy::MicrofacetEnergy(MicrofacetDistribution kind, float alpha_x, float alpha_y)
    : azimuths_(alpha_x == alpha_y ? 1 : 17), x_is_rougher_(alpha_x >= alpha_y) {
  const auto steps = static_cast<float>(std::max(1, azimuths_ - 1));
  for (int a = 0; a < azimuths_; ++a)
    for (int k = 0; k < kCosines; ++k) {
      const float cosine = std::max(1e-4f, sqr(static_cast<float>(k) / (kCosines - 1)));
      const float e = albedo(kind, alpha_x, alpha_y, direction(cosine, static_cast<float>(a) / steps, x_is_rougher_));
      missing_.push_back(std::clamp(1 - e, 0.0f, 1.0f));
    }
  // The mean of the interpolated table, so that both lobes together reflect all light.
  constexpr int kCosineSteps = 1024, kAzimuthSteps = 64;
  double sum = 0;
  for (int k = 0; k < kCosineSteps; ++k)
    for (int a = 0; a < kAzimuthSteps; ++a) {
      const float phi = (static_cast<float>(a) + 0.5f) / kAzimuthSteps * kPi / 2;
      const float cosine = std::sqrt((static_cast<float>(k) + 0.5f) / kCosineSteps);
      sum += missing_energy(direction(cosine, std::cos(phi), x_is_rougher_));
    }
  mean_missing_ = static_cast<float>(sum / (kCosineSteps * kAzimuthSteps));
}

float MicrofacetEnergy::missing_energy(const Vec3& w) const {
  const float x = std::sqrt(std::clamp(w.z, 0.0f, 1.0f)) * (kCosines - 1);
  const int k = std::min(static_cast<int>(x), kCosines - 2);
  const float t = x - static_cast<float>(k);
  const auto row = [&](int a) {
    const auto at = static_cast<size_t>(a * kCosines + k);
    return missing_[at] + (missing_[at + 1] - missing_[at]) * t;
  };
  if (azimuths_ == 1) return row(0);
  const float planar = sqr(w.x) + sqr(w.y), rougher = sqr(x_is_rougher_ ? w.x : w.y);
  const float y = (planar > 0 ? std::sqrt(rougher / planar) : 1) * static_cast<float>(azimuths_ - 1);
  const int a = std::min(static_cast<int>(y), azimuths_ - 2);
  return row(a) + (row(a + 1) - row(a)) * (y - static_cast<float>(a));
}

const MicrofacetEnergy& MicrofacetEnergy::of(MicrofacetDistribution kind, float alpha_x, float alpha_y) {
  using Key = std::tuple<MicrofacetDistribution, float, float>;
  static std::mutex mutex;
  static std::map<Key, std::unique_ptr<const MicrofacetEnergy>> tables;
  const std::scoped_lock lock(mutex);
  auto& table = tables[Key{kind, alpha_x, alpha_y}];
  if (!table) table = std::make_unique<const MicrofacetEnergy>(kind, alpha_x, alpha_y);
  return *table;
}

}  // namespace etendue
