#include "light/light_table.h"

#include <algorithm>

#include "base/vectorize.h"
#include "base/warp.h"
#include "light/flux.h"
#include "light/punctual.h"
#include "light/spherical_triangle.h"

namespace etendue {
namespace {

float power_of(const AreaLightTriangle& t) { return luminance(flux_of(t)); }

// Whether a triangle looks so large from there that directions to it are sampled rather than its points: its area over
// the square of the distance to its middle. Squares of both sides, since the cross product is twice the area.
inline bool looks_large(const Vec3& to_p0, const Vec3& e1, const Vec3& e2, const Vec3& cross) {
  constexpr float kLarge = 1;
  const Vec3 to_middle = to_p0 + (e1 + e2) * (1 / 3.0f);
  return sqr(length_squared(to_middle) * (2 * kLarge)) < length_squared(cross);
}

float power_of(const PlacedLight& placed, float scene_radius) {
  const Light& light = placed.light;
  const float intensity = luminance(light.color) * light.intensity;
  switch (light.type) {
    case LightType::directional:
      return kPi * sqr(scene_radius) * intensity;
    case LightType::ambient:
      return 4 * sqr(kPi * scene_radius) * intensity;
    default:
      return luminance(flux_of(light));
  }
}

}  // namespace

// Triangles that were chosen for queries, many at once.
struct LightTable::ChosenTriangles {
  static constexpr size_t kSize = 64;
  template <class T>
  using Array = std::array<T, kSize>;

  Vec3Lanes<kSize> p0, e1, e2, cross;
  alignas(64) Array<float> probability, back;  // of the choice; what the back side counts, 0 or 1

  void set(size_t i, const AreaLightTriangle& triangle, float choice_probability) {
    p0.set(i, triangle.p0), e1.set(i, triangle.e1), e2.set(i, triangle.e2), cross.set(i, triangle.cross);
    probability[i] = choice_probability, back[i] = triangle.double_sided ? 1 : 0;
  }

  struct Points;
  void sample(const LightQueries& queries, Points& points) const;
  void sample_directions(const LightQueries& queries, size_t i, Points& points) const;
};

struct LightTable::ChosenTriangles::Points {
  Vec3Lanes<kSize> wi;
  alignas(64) Array<float> distance, pdf, b1, b2, large;

  void get(size_t i, LightSample& sample) const {
    sample.wi = wi[i];
    sample.distance = distance[i], sample.pdf = pdf[i];
    sample.barycentric = {b1[i], b2[i]};
  }
};

// A uniform point has density 1 / area; distance^2 / cosine turns it into a solid angle. `cross` is 2 area long.
ETENDUE_VECTORIZE void LightTable::ChosenTriangles::sample(const LightQueries& queries, Points& points) const {
#pragma GCC ivdep
  for (size_t i = 0; i < whole_registers(queries.count); ++i) {
    const Vec2 b = square_to_triangle({queries.u0[i], queries.u1[i]});
    const Vec3 to_p0 = p0[i] - queries.from[i];
    const Vec3 to_light = to_p0 + b.x * e1[i] + b.y * e2[i];
    const float distance2 = length_squared(to_light);
    const float distance = std::sqrt(distance2), scale = 1 / distance;
    const Vec3 wi = to_light * scale;
    // The side that faces the receiver, negative for the back.
    const float facing = -glm::dot(cross[i], wi);
    const float seen = std::max(facing, 0.0f) + std::max(-facing, 0.0f) * back[i];
    const float pdf = 2 * distance2 * probability[i] / seen;
    points.wi.set(i, wi);
    points.distance[i] = distance, points.b1[i] = b.x, points.b2[i] = b.y;
    points.pdf[i] = seen > 0 && pdf < kInfinity ? pdf : 0;
    points.large[i] = looks_large(to_p0, e1[i], e2[i], cross[i]) ? 1 : 0;
  }
}

// Of one that looks large. What is not seen is left as it is.
void LightTable::ChosenTriangles::sample_directions(const LightQueries& queries, size_t i, Points& points) const {
  const SphericalTriangle seen(p0[i] - queries.from[i], e1[i], e2[i]);
  if (points.pdf[i] == 0 || !seen.can_be_sampled()) return;
  const auto point = seen.sample({queries.u0[i], queries.u1[i]});
  points.wi.set(i, point.direction);
  points.distance[i] = point.distance;
  points.b1[i] = point.barycentric.x, points.b2[i] = point.barycentric.y;
  points.pdf[i] = probability[i] / seen.solid_angle();
}

LightTable::LightTable(std::vector<AreaLightTriangle> triangles, std::vector<PlacedLight> placed,
                       const Environment& environment, const Bounds& scene_bounds, std::vector<MovingEmitter> movers,
                       std::vector<RoundLight> rounds)
    : triangles_(std::move(triangles)),
      placed_(std::move(placed)),
      movers_(std::move(movers)),
      rounds_(std::move(rounds)),
      centre_(scene_bounds.empty() ? Vec3(0) : scene_bounds.center()),
      radius_(std::max(scene_bounds.radius(), 1e-6f)),
      environment_(environment) {
  std::vector<float> powers;
  powers.reserve(triangles_.size() + placed_.size() + 1);
  for (const auto& t : triangles_) powers.push_back(power_of(t));
  for (const auto& l : placed_) powers.push_back(power_of(l, radius_));
  if (!environment_.black()) powers.push_back(4 * sqr(kPi * radius_) * luminance(environment_.mean_radiance()));
  bool any = false;
  for (const float p : powers) any = any || p > 0;
  if (!any) return;
  choice_ = AliasTable(powers);
  find_sources();
  plant_tree(powers);
}

void LightTable::find_sources() {
  mass_.resize(triangles_.size());
  const auto lights = static_cast<uint32_t>(choice_.size()), triangles = static_cast<uint32_t>(triangles_.size());
  for (uint32_t first = 0, end = 0; first < lights; first = end) {
    Source source{first, 0, 0};
    do {
      source.probability += choice_.probability(end);
      if (end < triangles) mass_[end] = source.probability;
      ++end;
    } while (end < triangles && triangles_[end].instance == triangles_[first].instance);
    source.count = end - first;
    if (source.probability > 0) sources_.push_back(source);
  }
}

size_t LightTable::source_of(uint32_t light) const {
  const auto after = std::upper_bound(sources_.begin() + 1, sources_.end(), light,
                                      [](uint32_t l, const Source& source) { return l < source.first; });
  return static_cast<size_t>(after - sources_.begin()) - 1;
}

AliasTable::Choice LightTable::choose_within(const Source& source, float u) const {
  if (source.count == 1) return {source.first, 1};
  const auto begin = mass_.begin() + source.first, last = begin + (source.count - 1);
  const auto index = static_cast<uint32_t>(std::upper_bound(begin, last, u * source.probability) - mass_.begin());
  return {index, choice_.probability(index) / source.probability};
}

void LightTable::sample(const LightQueries& queries, LightSample* samples, LightStrategy strategy) const {
  if (uses_tree(strategy))
    sample_chosen(queries, samples, true, [&](size_t i) { return choose_by_tree(queries.from[i], queries.choice[i]); });
  else
    sample_chosen(queries, samples, strategy != LightStrategy::emission_pdf,
                  [&](size_t i) { return choice_.sample(queries.choice[i]); });
}

void LightTable::sample_source(size_t source, const LightQueries& queries, LightSample* samples) const {
  sample_chosen(queries, samples, true, [&](size_t i) { return choose_within(sources_[source], queries.choice[i]); });
}

template <class Choose>
void LightTable::sample_chosen(const LightQueries& queries, LightSample* samples, bool solid_angles,
                               Choose&& choose) const {
  ChosenTriangles triangles;
  for (size_t first = 0; first < queries.count; first += ChosenTriangles::kSize)
    sample_batch(
        {queries.from + first, queries.choice + first, queries.u0 + first, queries.u1 + first,
         std::min(ChosenTriangles::kSize, queries.count - first), queries.times ? queries.times + first : nullptr},
        triangles, samples + first, solid_angles, [&](size_t i) { return choose(first + i); });
}

template <class Choose>
void LightTable::sample_batch(const LightQueries& queries, ChosenTriangles& triangles, LightSample* samples,
                              bool solid_angles, Choose&& choose) const {
  for (size_t i = 0; i < queries.count; ++i) {
    LightSample& sample = samples[i];
    sample.pdf = 0;
    if (choice_.empty()) continue;
    const auto choice = choose(i);
    sample.light = choice.index;
    sample.kind = choice.index < triangles_.size() ? LightKind::triangle : LightKind::placed;
    if (sample.kind == LightKind::triangle)
      triangles.set(i, triangles_[choice.index], choice.probability);
    else
      sample_other(choice, queries.from[i], {queries.u0[i], queries.u1[i]}, queries.times ? queries.times[i] : 0,
                   sample);
  }
  for (size_t i = 0; queries.times && !choice_.empty() && i < queries.count; ++i)
    if (const uint32_t light = samples[i].light;
        light < triangles_.size() && triangles_[light].moving && triangles_[light].round < 0)
      triangles.set(i, moved(triangles_[light], queries.times[i]), triangles.probability[i]);
  ChosenTriangles::Points points;
  triangles.sample(queries, points);
  for (size_t i = 0; i < queries.count; ++i) {
    LightSample& sample = samples[i];
    if (choice_.empty() || sample.kind != LightKind::triangle) continue;
    const AreaLightTriangle& triangle = triangles_[sample.light];
    if (points.large[i] != 0 && triangle.round < 0 && solid_angles) triangles.sample_directions(queries, i, points);
    points.get(i, sample);
    if (points.large[i] != 0 && triangle.round >= 0)
      sample_round(triangle, triangles.probability[i], queries.from[i], {queries.u0[i], queries.u1[i]},
                   queries.times ? queries.times[i] : 0, solid_angles, sample);
    sample.delta = false;
    sample.radiance = triangle.radiance, sample.textured = triangle.textured;
    if (triangle.cosine_exponent != 0 && sample.pdf > 0)
      sample.radiance *= triangle.beam(cosine_at(sample, queries.times ? queries.times[i] : 0));
  }
}

void LightTable::sample_other(const AliasTable::Choice& choice, const Vec3& from, Vec2 u, float time,
                              LightSample& sample) const {
  const size_t placed = choice.index - triangles_.size();
  sample.textured = false;
  const bool reached =
      placed < placed_.size() ? sample_placed(placed_[placed], from, u, time, sample) : sample_environment(u, sample);
  sample.pdf = reached ? sample.pdf * choice.probability : 0;
}

bool LightTable::sample_environment(Vec2 u, LightSample& sample) const {
  const auto direction = environment_.sample(u);
  sample.kind = LightKind::environment;
  sample.wi = direction.direction;
  sample.distance = kInfinity;
  sample.pdf = direction.pdf_solid_angle;
  sample.delta = false;
  sample.radiance = environment_.radiance(direction.direction);
  return sample.pdf > 0;
}

bool LightTable::sample_placed(const PlacedLight& placed, const Vec3& from, Vec2 u, float time,
                               LightSample& sample) const {
  const Light& light = placed.light;
  const LightPlace place = placed.at(time);
  sample.kind = LightKind::placed;
  sample.delta = true;
  sample.pdf = 1;
  sample.radiance = light.color * light.intensity;
  if (light.type == LightType::ambient) {
    sample.wi = square_to_sphere(u);
    sample.distance = 0, sample.pdf = 1 / (4 * kPi);
    return true;
  }
  if (light.type == LightType::directional) {
    sample.wi = -place.direction;
    sample.distance = kInfinity;
    return true;
  }
  const Vec3 to_light = place.position - from;
  const float distance2 = length_squared(to_light);
  if (!(distance2 > 0)) return false;
  sample.distance = std::sqrt(distance2);
  sample.wi = to_light / sample.distance;
  sample.radiance *= etendue::range_window(light, sample.distance) / distance2;
  if (light.type == LightType::spot) sample.radiance *= spot_falloff(light, -glm::dot(sample.wi, place.direction));
  return !is_black(sample.radiance);
}

AreaLightTriangle LightTable::moved(const AreaLightTriangle& triangle, float time) const {
  AreaLightTriangle t = triangle;
  const MovingEmitter& emitter = movers_[t.instance];
  t.place(emitter.motion->facet_at(*emitter.mesh, emitter.mesh->triangles[t.triangle], time));
  return t;
}

float LightTable::probability(uint32_t light, const Vec3& from, LightStrategy strategy) const {
  if (uses_tree(strategy)) return probability_by_tree(light, from);
  const float p = choice_.probability(light);
  return strategy == LightStrategy::every && p > 0 ? p / sources_[source_of(light)].probability : p;
}

float LightTable::pdf_triangle(uint32_t light, const Vec3& from, const Vec3& at, float time,
                               LightStrategy strategy) const {
  if (choice_.empty() || light >= triangles_.size()) return 0;
  const Vec3 to_light = at - from;
  const float distance2 = length_squared(to_light);
  const bool solid_angles = strategy != LightStrategy::emission_pdf;
  if (const AreaLightTriangle& t = triangles_[light]; t.round >= 0)
    return probability(light, from, strategy) * pdf_of_point_on_round(t, from, at, time, solid_angles);
  const float per_solid_angle = with_triangle(light, time, [&](const AreaLightTriangle& t) {
    const float facing = std::abs(glm::dot(t.cross, to_light));
    if (!(facing > 0)) return 0.0f;
    if (solid_angles && looks_large(t.p0 - from, t.e1, t.e2, t.cross))
      if (const SphericalTriangle seen(t.p0 - from, t.e1, t.e2); seen.can_be_sampled()) return 1 / seen.solid_angle();
    return 2 * distance2 * std::sqrt(distance2) / facing;
  });
  return per_solid_angle > 0 ? probability(light, from, strategy) * per_solid_angle : 0;
}

float LightTable::pdf_environment(const Vec3& direction, LightStrategy strategy) const {
  if (choice_.empty() || environment_.black()) return 0;
  return probability(environment_light(), Vec3(0), strategy) * environment_.pdf_solid_angle(direction);
}

}  // namespace etendue
