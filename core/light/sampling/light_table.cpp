#include "light/sampling/light_table.h"

#include "light/placed_light.h"
#include "light/sampling/triangle_batch.h"

namespace etendue {
namespace {

LightBounds bounds_of(const PlacedLight& light) {
  return light.visit([&](const auto& emitter) {
    LightBounds b;
    if constexpr (!std::decay_t<decltype(emitter)>::kIsInfinite)
      b = light.motion ? bounds_over_time(*light.motion, [&](float time) { return emitter.bounds(light.at(time)); })
                       : emitter.bounds(light.place);
    return b;
  });
}

}  // namespace

LightTable::LightTable()
    : placed_(std::make_shared<const std::vector<PlacedLight>>()),
      environment_(std::make_shared<const EnvironmentMap>()) {}

LightTable::LightTable(std::vector<AreaLightTriangle> triangles, std::vector<PlacedLight> placed,
                       const Environment& environment, const Bounds& scene_bounds)
    : LightTable(std::move(triangles), std::move(placed), std::make_shared<const EnvironmentMap>(environment),
                 scene_bounds) {}

LightTable::LightTable(std::vector<AreaLightTriangle> triangles, std::vector<PlacedLight> placed,
                       std::shared_ptr<const EnvironmentMap> environment, const Bounds& scene_bounds,
                       std::vector<MovingEmitter> movers, std::vector<AnalyticAreaLight> shapes,
                       std::vector<EnvironmentPortal> portals)
    : primitives_(std::move(triangles), std::move(movers), std::move(shapes)),
      placed_(std::make_shared<const std::vector<PlacedLight>>(std::move(placed))),
      environment_(std::move(environment)),
      portals_(std::move(portals)),
      scene_{scene_bounds.empty() ? Vec3(0) : scene_bounds.center(), std::max(scene_bounds.radius(), 1e-6f)} {
  std::vector<SelectableLight> lights;
  lights.reserve(primitives_.size() + placed_->size() + 1);
  uint32_t source = 0;
  for (uint32_t i = 0; i < primitives_.size(); ++i) {
    const AreaLightTriangle& t = primitives_[i];
    if (i > 0 && t.instance != primitives_[i - 1].instance) ++source;
    SelectableLight& light = lights.emplace_back();
    light.power = luminance(t.flux());
    light.area = t.area;
    light.source = source;
    if (light.power > 0) light.bounds = primitives_.bounds(i);
  }
  for (const PlacedLight& p : *placed_) {
    SelectableLight& light = lights.emplace_back();
    light.power = p.visit([&](const auto& emitter) { return emitter.power(scene_.radius); });
    light.source = ++source;
    light.is_infinite = p.is_infinite();
    if (light.power > 0) light.bounds = bounds_of(p);
  }
  if (!environment_->black()) {
    SelectableLight& light = lights.emplace_back();
    light.power = 4 * sqr(kPi * scene_.radius) * luminance(environment_->mean_radiance());
    light.source = ++source;
    light.is_infinite = true;
  }
  for (const SelectableLight& light : lights) power_ += light.power;
  selector_ = LightSelector(lights);
  find_points(lights);
  if (environment_->black()) return;
  lights.back().power *= environment_->compensated_share();
  compensated_selector_ = selector_.with_infinite_powers(lights);
}

void LightTable::find_points(std::span<const SelectableLight> lights) {
  std::vector<float> powers(lights.size());
  bool any = false;
  for (size_t i = primitives_.size(); i < lights.size(); ++i) {
    if (lights[i].is_infinite || !(lights[i].power > 0)) continue;
    powers[i] = lights[i].power;
    any = true;
  }
  if (any) points_by_power_ = AliasTable(powers);
}

size_t LightTable::placed_count() const { return placed_->size(); }

const PlacedLight* LightTable::placed_at(uint32_t light) const {
  const size_t i = light - primitives_.size();
  return light >= primitives_.size() && i < placed_->size() ? &(*placed_)[i] : nullptr;
}

void LightTable::sample(const LightQueries& queries, LightSample* samples, LightSampling sampling) const {
  const LightSelector& lights = selector(sampling);
  if (sampling.learned)
    sample_chosen(queries, samples, sampling, [&](size_t i) {
      return lights.choose_by_group(*sampling.learned, queries.receiver(i), queries.choice[i]);
    });
  else if (lights.uses_tree(sampling.strategy))
    sample_chosen(queries, samples, sampling,
                  [&](size_t i) { return lights.choose_by_tree(queries.receiver(i), queries.choice[i]); });
  else
    sample_chosen(queries, samples, sampling, [&](size_t i) { return lights.choose_by_power(queries.choice[i]); });
}

void LightTable::sample_source(size_t source, const LightQueries& queries, LightSample* samples,
                               LightSampling sampling) const {
  const LightSelector& lights = selector(sampling);
  sample_chosen(queries, samples, sampling,
                [&](size_t i) { return lights.choose_in_source(source, queries.choice[i]); });
}

void LightTable::sample_group(size_t group, const LightQueries& queries, LightSample* samples,
                              LightSampling sampling) const {
  const LightSelector& lights = selector(sampling);
  sample_chosen(queries, samples, sampling,
                [&](size_t i) { return lights.choose_in_group(group, queries.receiver(i), queries.choice[i]); });
}

template <class Choose>
void LightTable::sample_chosen(const LightQueries& queries, LightSample* samples, LightSampling sampling,
                               Choose&& choose) const {
  if (empty(sampling)) {
    for (size_t i = 0; i < queries.count; ++i) samples[i].pdf = 0;
    return;
  }
  TriangleBatch batch;
  for (size_t first = 0; first < queries.count; first += TriangleBatch::kSize)
    sample_batch(
        {queries.from + first, queries.choice + first, queries.u0 + first, queries.u1 + first,
         std::min(TriangleBatch::kSize, queries.count - first), queries.times ? queries.times + first : nullptr},
        batch, samples + first, sampling, [&](size_t i) { return choose(first + i); });
}

template <class Choose>
void LightTable::sample_batch(const LightQueries& queries, TriangleBatch& batch, LightSample* samples,
                              LightSampling sampling, Choose&& choose) const {
  const bool by_solid_angle = !samples_as_emission(sampling.strategy);
  const auto time_of = [&](size_t i) { return queries.times ? queries.times[i] : 0; };
  for (size_t i = 0; i < queries.count; ++i) {
    LightSample& s = samples[i];
    const LightSelector::Choice choice = choose(i);
    s.light = choice.index;
    s.choice = choice.probability;
    if (choice.index < primitives_.size()) {
      s.kind = LightKind::triangle;
      batch.set(i, primitives_[choice.index], choice.probability);
    } else {
      s.textured = false;
      const bool reached = sample_other(queries.from[i], {queries.u0[i], queries.u1[i]}, time_of(i), sampling, s);
      s.pdf = reached ? s.pdf * choice.probability : 0;
    }
  }
  for (size_t i = 0; queries.times && i < queries.count; ++i)
    if (const uint32_t light = samples[i].light;
        light < primitives_.size() && primitives_[light].moving && !primitives_[light].is_analytic())
      batch.set(i, primitives_.moved(primitives_[light], queries.times[i]), batch.probability[i]);
  TriangleBatch::Points points;
  batch.sample_area(queries, points);
  for (size_t i = 0; i < queries.count; ++i) {
    LightSample& s = samples[i];
    if (s.kind != LightKind::triangle) continue;
    const AreaLightTriangle& t = primitives_[s.light];
    if (points.large[i] != 0 && !t.is_analytic() && by_solid_angle) batch.sample_solid_angle(queries, i, points);
    points.get(i, s);
    if (points.large[i] != 0 && t.is_analytic())
      primitives_.sample_shape(t, batch.probability[i], queries.from[i], {queries.u0[i], queries.u1[i]}, time_of(i),
                               by_solid_angle, s);
    s.delta = false;
    s.radiance = t.radiance;
    s.textured = t.textured;
    if (t.cosine_exponent != 0 && s.pdf > 0) s.radiance *= t.profile(primitives_.cosine_at(s, time_of(i)));
  }
}

bool LightTable::sample_other(const Vec3& from, Vec2 u, float time, LightSampling sampling, LightSample& sample) const {
  const PlacedLight* placed = placed_at(sample.light);
  if (!placed) return sample_environment(from, u, sampling, sample);
  sample.kind = LightKind::placed;
  const LightPlace place = placed->at(time);
  return placed->visit([&](const auto& emitter) { return emitter.sample(place, from, u, sample); });
}

std::optional<LightTable::PointLight> LightTable::point_light(uint32_t light, float time) const {
  const PlacedLight* placed = placed_at(light);
  if (!placed) return {};
  return placed->visit([&](const auto& emitter) -> std::optional<PointLight> {
    if constexpr (std::decay_t<decltype(emitter)>::kIsInfinite) {
      return {};
    } else {
      const LightPlace place = placed->at(time);
      const LightBounds bounds = emitter.bounds(place);
      const float angle = std::min(bounds.normals + bounds.emission, kPi);
      return PointLight{light, points_by_power_.probability(light), place.position, bounds.axis, std::cos(angle)};
    }
  });
}

LightSample LightTable::sample_placed(uint32_t light, const Vec3& from, float time) const {
  LightSample sample;
  sample.light = light;
  if (!sample_other(from, Vec2(0), time, LightStrategy::one, sample)) sample.pdf = 0;
  return sample;
}

bool LightTable::sample_environment(const Vec3& from, Vec2 u, LightSampling sampling, LightSample& sample) const {
  const bool by_position = !samples_as_emission(sampling.strategy);
  const float through = by_position && !portals_.empty() ? portals_.probability(from) : 0;
  if (u.x < through) {
    sample.wi = portals_.sample(from, {u.x / through, u.y});
    const auto value = environment_->value(sample.wi);
    sample.pdf = (1 - through) * value.pdf_solid_angle;
    sample.radiance = value.radiance;
  } else {
    const float rest = std::min((u.x - through) / (1 - through), kOneMinusEpsilon);
    const auto direction = environment_->sample({rest, u.y}, is_compensated(sampling));
    sample.wi = direction.direction;
    sample.pdf = (1 - through) * direction.pdf_solid_angle;
    sample.radiance = direction.radiance;
  }
  if (through > 0) sample.pdf += through * portals_.pdf(from, sample.wi);
  sample.kind = LightKind::environment;
  sample.distance = kInfinity;
  sample.delta = false;
  return sample.pdf > 0;
}

float LightTable::pdf_triangle(uint32_t light, const LightReceiver& from, const Vec3& at, float time,
                               LightSampling sampling) const {
  if (empty(sampling) || light >= primitives_.size()) return 0;
  const float pdf = primitives_.pdf(light, from.position, at, time, !samples_as_emission(sampling.strategy));
  return pdf > 0 ? probability(light, from, sampling) * pdf : 0;
}

EnvironmentMap::Value LightTable::environment_value(const Vec3& from, const Vec3& direction,
                                                    LightSampling sampling) const {
  EnvironmentMap::Value value = environment_->value(direction, is_compensated(sampling));
  if (empty(sampling) || environment_->black()) return {value.radiance, 0};
  float& pdf = value.pdf_solid_angle;
  if (!samples_as_emission(sampling.strategy) && !portals_.empty()) {
    const float through = portals_.probability(from);
    pdf = (1 - through) * pdf + (through > 0 ? through * portals_.pdf(from, direction) : 0);
  }
  if (pdf > 0) pdf *= probability(environment_number(), from, sampling);
  return value;
}

float LightTable::pdf_environment(const Vec3& from, const Vec3& direction, LightSampling sampling) const {
  if (empty(sampling) || environment_->black()) return 0;
  return environment_value(from, direction, sampling).pdf_solid_angle;
}

}  // namespace etendue
