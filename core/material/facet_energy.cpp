#include "material/facet_energy.h"

#include <map>
#include <memory>
#include <mutex>
#include <tuple>

namespace etendue {
namespace {

constexpr int kStrata = 32;

// The mean of G2 / G1 over the normals that o sees, where light stays above the surface.
template <class Facets>
float albedo(const Facets& facets, const Vec3& o) {
  const float masked = o.z + facets.projected_lambda(o);
  double sum = 0;
  for (int a = 0; a < kStrata; ++a)
    for (int b = 0; b < kStrata; ++b) {
      const Vec2 u((static_cast<float>(a) + 0.5f) / kStrata, (static_cast<float>(b) + 0.5f) / kStrata);
      const Vec3 i = reflect(o, facets.sample_visible(o, u));
      if (i.z > 0) sum += 4 * i.z * masked * facet_visibility(facets, o, i);
    }
  return static_cast<float>(sum / (kStrata * kStrata));
}

float albedo(FacetKind kind, float alpha_x, float alpha_y, const Vec3& o) {
  if (kind == FacetKind::ggx) return albedo(Ggx{alpha_x, alpha_y}, o);
  return albedo(Beckmann{alpha_x, alpha_y}, o);
}

// A direction by its cosine and the square of its azimuth's.
Vec3 direction(float cosine, float azimuth2) {
  const float sine = safe_sqrt(1 - sqr(cosine));
  return {sine * std::sqrt(azimuth2), sine * safe_sqrt(1 - azimuth2), cosine};
}

}  // namespace

FacetEnergy::FacetEnergy(FacetKind kind, float alpha_x, float alpha_y) : azimuths_(alpha_x == alpha_y ? 1 : 9) {
  const auto steps = static_cast<float>(std::max(1, azimuths_ - 1));
  for (int a = 0; a < azimuths_; ++a)
    for (int k = 0; k < kCosines; ++k) {
      const float cosine = std::max(1e-4f, sqr(static_cast<float>(k) / (kCosines - 1)));
      const float e = albedo(kind, alpha_x, alpha_y, direction(cosine, static_cast<float>(a) / steps));
      lost_.push_back(std::clamp(1 - e, 0.0f, 1.0f));
    }
  // Of the table as it is read: then the two lobes add up.
  constexpr int kCosineSteps = 1024, kAzimuthSteps = 64;
  double sum = 0;
  for (int k = 0; k < kCosineSteps; ++k)
    for (int a = 0; a < kAzimuthSteps; ++a) {
      const float phi = (static_cast<float>(a) + 0.5f) / kAzimuthSteps * kPi / 2;
      sum += lost(direction(std::sqrt((static_cast<float>(k) + 0.5f) / kCosineSteps), sqr(std::cos(phi))));
    }
  mean_lost_ = static_cast<float>(sum / (kCosineSteps * kAzimuthSteps));
}

float FacetEnergy::lost(const Vec3& w) const {
  const float x = std::sqrt(std::clamp(w.z, 0.0f, 1.0f)) * (kCosines - 1);
  const int k = std::min(static_cast<int>(x), kCosines - 2);
  const float t = x - static_cast<float>(k);
  const auto row = [&](int a) {
    const auto at = static_cast<size_t>(a * kCosines + k);
    return lost_[at] + (lost_[at + 1] - lost_[at]) * t;
  };
  if (azimuths_ == 1) return row(0);
  const float planar = sqr(w.x) + sqr(w.y);
  const float y = (planar > 0 ? sqr(w.x) / planar : 1) * static_cast<float>(azimuths_ - 1);
  const int a = std::min(static_cast<int>(y), azimuths_ - 2);
  return row(a) + (row(a + 1) - row(a)) * (y - static_cast<float>(a));
}

const FacetEnergy& FacetEnergy::of(FacetKind kind, float alpha_x, float alpha_y) {
  using Key = std::tuple<FacetKind, float, float>;
  const Key key{kind, alpha_x, alpha_y};
  // Surfaces ask once a hit where their base colour is a picture.
  thread_local Key last_key{};
  thread_local const FacetEnergy* last = nullptr;
  if (last && last_key == key) return *last;
  static std::mutex mutex;
  static std::map<Key, std::unique_ptr<const FacetEnergy>> tables;
  const std::scoped_lock lock(mutex);
  auto& table = tables[key];
  if (!table) table = std::make_unique<const FacetEnergy>(kind, alpha_x, alpha_y);
  last = table.get(), last_key = key;
  return *last;
}

}  // namespace etendue
