// Rays that leave lights.                                                                  (sampling/emission.h)
#include "light/placed_light.h"
#include "light/sampling/light_table.h"

namespace etendue {

void LightTable::sample_emission(const EmissionRandom& random, Emission& e) const {
  if (!empty()) sample_emission_of(selector_.choose_by_power(random.choice), random, e);
}

void LightTable::sample_emission_by_tree(const LightReceiver& receiver, const EmissionRandom& random,
                                         Emission& e) const {
  if (empty()) return;
  const LightSelector::Choice choice = selector_.choose_by_tree(receiver, random.choice);
  if (choice.probability > 0) sample_emission_of(choice, random, e);
}

void LightTable::sample_emission_of(LightSelector::Choice choice, const EmissionRandom& random, Emission& e) const {
  e.light = choice.index;
  e.time = random.time;
  if (choice.index < primitives_.size())
    primitives_.sample_emission(random, choice.probability, e);
  else if (placed_at(choice.index))
    sample_placed_emission(random, choice.probability, e);
  else
    sample_environment_emission(random, choice.probability, e);
}

void LightTable::sample_placed_emission(const EmissionRandom& random, float probability, Emission& e) const {
  const PlacedLight& light = *placed_at(e.light);
  light.visit([&](const auto& emitter) {
    const EmissionDensity density = emitter.emission_density(scene_);
    if (!(density.second > 0)) return;  // no ray leaves this light
    e.kind = LightKind::placed;
    e.density = density;
    e.density.first *= probability;
    emitter.sample_emission(light.at(e.time), scene_, random, e);
    e.weight = 1 / (e.density.first * e.density.second);
  });
}

void LightTable::sample_environment_emission(const EmissionRandom& random, float probability, Emission& e) const {
  const auto sample = environment_->sample(random.direction);
  e.kind = LightKind::environment;
  e.direction = -sample.direction;
  e.density = {probability * sample.pdf_solid_angle, scene_.entry_pdf(), false, true};
  e.radiance = environment_->radiance(sample.direction);
  e.position = scene_.entry_point(e.direction, random.point);
  if (e.density.first > 0) e.weight = 1 / (e.density.first * e.density.second);
}

void LightTable::resample_emission(Vec2 u, Emission& e) const {
  if (e.kind == LightKind::triangle) {
    primitives_.resample_emission(u, square_to_cosine_hemisphere(u), selector_.probability_by_power(e.light), e);
  } else if (e.kind == LightKind::environment) {
    e.position = scene_.entry_point(e.direction, u);
  } else {
    const PlacedLight& light = *placed_at(e.light);
    light.visit([&](const auto& emitter) { emitter.resample_emission(light.at(e.time), scene_, u, e); });
  }
}

EmissionDensity LightTable::environment_emission_density(const Vec3& direction) const {
  return {pdf_environment(Vec3(0), direction, LightStrategy::emission_pdf), scene_.entry_pdf(), false, true};
}

EmissionDensity LightTable::emission_density_of_other(const LightSample& sample) const {
  const PlacedLight* light = placed_at(sample.light);
  if (!light || sample.kind == LightKind::environment) return environment_emission_density(sample.wi);
  EmissionDensity density = light->visit([&](const auto& emitter) { return emitter.emission_density(scene_); });
  density.first *= selector_.probability_by_power(sample.light);
  return density;
}

Rgb LightTable::emitted_by_placed(uint32_t number, const Vec3& direction, float distance, float time) const {
  const PlacedLight* light = placed_at(number);
  if (!light) return Rgb(0);
  return light->visit([&](const auto& emitter) { return emitter.emitted(light->at(time), direction, distance); });
}

float LightTable::range_window(uint32_t number, float distance) const {
  const PlacedLight* light = placed_at(number);
  return light ? light->visit([&](const auto& emitter) { return emitter.range_window(distance); }) : 1;
}

}  // namespace etendue
