// Sampling of directions by a mixture of the BSDF and a guide, and the records from which the guide learns.
//
//   p(w) = (1 - c) p_b(w) + c p_g(w)
//
// The density p_g is that of the incident radiance, or its product with the cosine (cosine_product.h).
//
// One direction is sampled per vertex, from one of the two densities, and weighted by f_s |cos| / p. Deltas are sampled
// by the BSDF alone; their probability is (1 - c) times that of the BSDF.
#pragma once
#include <array>
#include <vector>

#include "integrator/guiding/cosine_product.h"
#include "integrator/guiding/radiance_guide.h"
#include "transport/wavefront/path_estimators.h"

namespace etendue::guiding {

// Russian roulette ends paths whose expected radiance is below 1 / kRouletteScale of that of the whole path. The scale
// is large, because expectations are averages over regions.
inline constexpr float kRouletteScale = 20, kLeastSurvival = 0.3f, kMostSurvival = 0.99f;

// The first vertices of a path are guided and recorded, the others continue by the BSDF alone. A factor p_b / p of the
// throughput is up to 1 / (1 - c), so over hundreds of vertices, as in a bright closed room, few paths would carry most of
// the light.
inline constexpr int kGuidedVertices = 12;

inline constexpr const char* kFractionDoc =
    "Fraction of directions that are sampled by what was learned, the others by the BSDF. 0: learned for each region";

// The scattering events of the paths of one wavefront. The radiance that arrives from the sampled direction is known
// when the paths have ended.
template <class M>
class PathRecords {
 public:
  using Color = typename M::Color;
  struct Event {
    uint16_t path;
    uint32_t region;  // of the vertex
    Vec3 position;    // displaced
    Vec2 direction;
    float pdf;
    float difference;  // (p_g - p_b) / p
    float weight;      // luminance of f_s cos / p
    Color throughput;  // after the event
    Color before;      // radiance of the path without light from the direction
  };

  // Records a random fraction `share` of the paths.
  void begin(float share) {
    events_.clear();
    open_ = 0;
    share_ = share;
    expected_.fill(0);
  }
  // The radiance that a path is expected to find from its first guided vertex on; 0: none yet.
  float& expected_radiance(int path) { return expected_[static_cast<size_t>(path)]; }
  // `seed` is that of the path and its sample.
  bool follows(uint32_t seed) const { return share_ >= 1 || to_unit_float(mix_bits(seed)) < share_; }
  void add(const Event& event) { events_.push_back(event); }
  // To be called after the direct light of the last vertices has been added, and before any other contribution.
  void separate_direct_light(transport::PathWavefront<M>& paths) {
    for (; open_ < events_.size(); ++open_) events_[open_].before = paths.state(events_[open_].path).radiance;
  }
  // Calls use(record) for every event, after all paths have ended.
  template <class Use>
  void collect(transport::PathWavefront<M>& paths, const RadianceGuide& guide, Use&& use) const {
    for (const Event& e : events_) {
      const Color light = paths.state(e.path).radiance - e.before;
      float radiance = 0;
      for (int k = 0; k < 3; ++k)
        if (e.throughput[k] > 0) radiance += std::max(light[k] / e.throughput[k], 0.0f) * (1.0f / 3);
      if (!std::isfinite(radiance)) continue;
      const float product = e.weight * radiance;
      const uint32_t region = radiance > 0 ? guide.region_at(e.position) : e.region;
      use(Record{region, e.direction, radiance / e.pdf, product * e.difference, product * sqr(e.difference)});
    }
  }

 private:
  std::vector<Event> events_;
  size_t open_ = 0;
  float share_ = 1;
  std::array<float, transport::PathWavefront<M>::kCapacity> expected_{};
};

struct GuidingOptions {
  bool product = false;            // directions are guided by the product of radiance and cosine
  int vertices = kGuidedVertices;  // the first vertices of a path, which are guided
};

// The guide at the current hits of a wavefront.
template <class M>
class GuidedSampling {
 public:
  using Color = typename M::Color;

  GuidedSampling(transport::PathWavefront<M>& paths, const RadianceGuide& guide, PathRecords<M>& records,
                 const GuidingOptions& options = {})
      : paths_(paths), guide_(guide), records_(records), options_(options) {}

  void begin_hits() {
    for (int i = 0; i < paths_.hit_count(); ++i) {
      const auto hit = static_cast<size_t>(i);
      indices_[hit] = guide_.region_at(paths_.point(i).position);
      const Region& region = guide_.region(indices_[hit]);
      regions_[hit] = &region;
      const bool is_guided =
          paths_.length() <= options_.vertices && region.is_ready() && paths_.bsdf(i).has_non_delta_lobe();
      fractions_[hit] = is_guided ? region.fraction : 0;
      if (is_guided && options_.product) set_product(i, region);
    }
  }

  // The density of the mixture, where the BSDF has `bsdf_pdf`.
  float pdf(int hit, const Vec3& wi, float bsdf_pdf) const {
    const float fraction = fractions_[static_cast<size_t>(hit)];
    if (fraction == 0) return bsdf_pdf;
    Densities densities;
    set_densities(hit, sphere_to_square(wi), bsdf_pdf, densities);
    return densities.mixture;
  }

  void add_direct_light(LightSampling sampling) {
    using namespace transport;
    const LightTable& lights = paths_.scene().lights();
    if (lights.empty(sampling)) return;
    if (sampling.strategy != LightStrategy::every) return add_light_samples(paths_.sample_lights(sampling));
    for (size_t source = 0; source < lights.source_count(sampling); ++source) {
      paths_.reserve_connections();
      add_light_samples(paths_.sample_source(source, sampling, source));
    }
    paths_.select_rng_stream(0);
  }

  // Samples the next direction of every current path, as transport::sample_bsdf does. sampled(i, s) is called for every
  // path that continues.
  template <class Sampled>
  void sample_directions(int roulette_start, Sampled&& sampled) {
    using namespace transport;
    const bool roulette = paths_.length() >= roulette_start;
    paths_.draw_lobes();
    paths_.draw(dimensions(vertex_dimension::kBsdfLobe, 1) |
                (roulette ? dimensions(vertex_dimension::kRoulette, 1) : 0));
    for (int i = 0; i < paths_.hit_count(); ++i) {
      LobeSample<Color> s;
      Densities densities;
      if (!sample(i, s, densities) || !AcceptAll()(paths_, i, s)) continue;
      auto& path = paths_.state_at(i);
      path.throughput *= s.weight;
      path.eta_scale *= sqr(s.eta) * densities.gain();
      const float survival = expected_survival(i, s, densities);
      if (roulette && !survives(i, s, survival, roulette_start)) continue;
      record_scattering(path, paths_.point(i).position, paths_.receiver_normal(i), s);
      if (!s.delta && paths_.length() <= kGuidedVertices) record(i, s, densities);
      sampled(i, s);
      paths_.continue_path(i, s.wi);
    }
  }
  void sample_directions(int roulette_start) {
    sample_directions(roulette_start, [](int, const auto&) {});
  }

 private:
  struct Densities {
    float mixture = 0, bsdf = 0, guide = 0;
    float radiance = 0;  // that of the guide without the cosine

    // Russian roulette estimates the remaining light by the throughput. Directions that the guide prefers have a small
    // throughput and much light, so their survival probability follows from the BSDF's density.
    float gain() const { return bsdf > 0 && mixture > bsdf ? std::min(mixture / bsdf, 1e6f) : 1.0f; }
  };

  // The survival probability of Russian roulette by the radiance that the path is expected to find, relative to the
  // radiance that was expected at its first guided vertex [Vorba and Křivánek 2016]; 0 if it is not known.
  float expected_survival(int hit, const LobeSample<Color>& s, const Densities& densities) {
    const Region& region = *regions_[static_cast<size_t>(hit)];
    if (s.delta || fractions_[static_cast<size_t>(hit)] == 0) return 0;
    const float throughput = luminance(paths_.state_at(hit).throughput);
    float& first = records_.expected_radiance(paths_.path_at(hit));
    // The reflected radiance of a diffuse surface under the mean radiance of the hemisphere.
    if (first == 0) first = throughput * densities.gain() * region.flux * (0.5f * kInvPi);
    if (!(first > 0)) return 0;
    return std::clamp(kRouletteScale * throughput * region.flux * densities.radiance / first, kLeastSurvival,
                      kMostSurvival);
  }

  // Russian roulette, by the throughput where the light is not known.
  bool survives(int hit, const LobeSample<Color>& s, float survival, int roulette_start) {
    auto& path = paths_.state_at(hit);
    const float random = paths_.random(vertex_dimension::kRoulette, hit);
    if (survival == 0) return transport::survives_roulette(paths_, roulette_start, hit, path, s, random);
    path.throughput /= survival;
    return random < survival;
  }

  // BSDFs without transmission scatter to the side of wo.
  void set_product(int hit, const Region& region) {
    const scene::SurfacePoint& point = paths_.point(hit);
    const Vec3& normal = point.shading.z;
    products_[static_cast<size_t>(hit)].set(region.guide, glm::dot(normal, paths_.wo(hit)) < 0 ? -normal : normal,
                                            point.material->is_opaque ? ScatteredSide::normal : ScatteredSide::both);
  }

  float cosine_factor(int hit, Vec2 direction) const {
    return options_.product ? products_[static_cast<size_t>(hit)].factor(direction) : 1;
  }
  // Sets the densities of a guided hit where the BSDF has `bsdf_pdf`.
  void set_densities(int hit, Vec2 direction, float bsdf_pdf, Densities& densities) const {
    const Region& region = *regions_[static_cast<size_t>(hit)];
    densities.bsdf = bsdf_pdf;
    densities.radiance = region.guide_pdf(direction);
    densities.guide = densities.radiance * cosine_factor(hit, direction);
    densities.mixture = region.mixture(bsdf_pdf, densities.guide);
  }

  void add_light_samples(std::span<const LightSample> samples) {
    using namespace transport;
    add_light_samples_weighted(
        paths_, samples, Shadows::cast, [&](int i, const LightSample& light, const auto& scattered) {
          if (light.delta) return 1 / light.pdf;
          return mis_weight_over_pdf(MisHeuristic::power, light.pdf, pdf(i, light.wi, scattered.pdf));
        });
  }

  // False if the light is absorbed.
  bool sample(int hit, LobeSample<Color>& s, Densities& densities) const {
    const float fraction = fractions_[static_cast<size_t>(hit)];
    const auto& bsdf = paths_.bsdf(hit);
    LobeRandom random = paths_.lobe_draw(hit);
    const float choice = paths_.random(vertex_dimension::kBsdfLobe, hit);
    if (choice < fraction) return sample_guide(hit, random.u, s, densities);
    random.choice = std::min((choice - fraction) / (1 - fraction), kOneMinusEpsilon);
    if (!bsdf.sample(paths_.wo(hit), random, TransportMode::radiance, s)) return false;
    if (s.delta) {
      s.weight /= 1 - fraction;
      return true;
    }
    if (fraction > 0)
      set_densities(hit, sphere_to_square(s.wi), s.pdf_solid_angle, densities);
    else
      densities.bsdf = densities.mixture = s.pdf_solid_angle;
    s.weight *= densities.bsdf / densities.mixture;
    s.pdf_solid_angle = densities.mixture;
    return true;
  }

  bool sample_guide(int hit, Vec2 u, LobeSample<Color>& s, Densities& densities) const {
    const Vec2 direction = options_.product ? products_[static_cast<size_t>(hit)].sample(u)
                                            : regions_[static_cast<size_t>(hit)]->guide.sample(u);
    s.wi = square_to_sphere(direction);
    const auto scattered = paths_.bsdf(hit).evaluate(paths_.wo(hit), s.wi);
    if (is_black(scattered.f_cos)) return false;
    set_densities(hit, direction, scattered.pdf, densities);
    s.weight = scattered.f_cos / densities.mixture;
    s.pdf_solid_angle = densities.mixture;
    return true;
  }

  // Records the event in the region of a point that is displaced at random within a box of the size of the vertex's
  // region, so that regions have no visible boundaries [Müller 2019].
  void record(int hit, const LobeSample<Color>& s, const Densities& densities) {
    const auto& path = paths_.state_at(hit);
    const uint32_t path_and_sample = path_seed(path.seed, paths_.sample());
    if (!records_.follows(path_and_sample)) return;
    const uint32_t seed = hash_combine(path_and_sample, static_cast<uint32_t>(paths_.length()));
    const auto random = [seed](uint32_t k) { return to_unit_float(hash_combine(seed, k)) - 0.5f; };
    const Vec3 shift = Vec3(random(0), random(1), random(2)) * regions_[static_cast<size_t>(hit)]->size;
    records_.add({.path = static_cast<uint16_t>(paths_.path_at(hit)),
                  .region = indices_[static_cast<size_t>(hit)],
                  .position = paths_.point(hit).position + shift,
                  .direction = sphere_to_square(s.wi),
                  .pdf = densities.mixture,
                  .difference = (densities.guide - densities.bsdf) / densities.mixture,
                  .weight = luminance(s.weight),
                  .throughput = path.throughput,
                  .before = Color(0)});
  }

  transport::PathWavefront<M>& paths_;
  const RadianceGuide& guide_;
  PathRecords<M>& records_;
  const GuidingOptions options_;
  std::array<CosineProduct, transport::PathWavefront<M>::kHitsAtATime> products_;  // of guided hits
  std::array<uint32_t, transport::PathWavefront<M>::kHitsAtATime> indices_{};
  std::array<const Region*, transport::PathWavefront<M>::kHitsAtATime> regions_{};
  std::array<float, transport::PathWavefront<M>::kHitsAtATime> fractions_{};
};

}  // namespace etendue::guiding
