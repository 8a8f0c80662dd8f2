#include "integrator/shared/light_learning.h"

#include <algorithm>
#include <cmath>

#include "integrator/shared/camera_paths.h"
#include "light/sampling/learned_light_choice.h"
#include "transport/wavefront/path_estimators.h"
#include "transport/wavefront/subsurface_scattering.h"

namespace etendue::integrator {
namespace {

using Model = transport::ScatteringMedia<false>;
using Paths = transport::PathWavefront<Model>;

// The paths of a batch are spread over the image in this number of columns and rows. The first batch shows whether it pays
// to learn.
constexpr int kColumns = 16, kRows = 8;
static_assert(kColumns * kRows <= Paths::kCapacity);
constexpr uint32_t kBatches = 4;
// Samples at each vertex, of all groups together and of each: with one sample, a rare large contribution would be all light
// of its receiver.
constexpr size_t kSamples = 12, kMostSamplesOfAGroup = 4;
// Learned choices have to reduce the mean square of light samples by this factor. They break up the order of the random
// numbers, and take a few nanoseconds.
constexpr double kLeastGain = 2;
constexpr int kRouletteStart = 4;
constexpr uint64_t kSeed = 0x6c69676874;

void launch_paths(const RenderContext& context, const Sampler& sampler, uint32_t batch, Paths& paths) {
  paths.begin(*context.scene, sampler, batch, nullptr, context.model->moving);
  const PixelSeeds seed_of(sampler, mix_bits(context.seed ^ kSeed), 0);
  for (int i = 0; i < kColumns * kRows; ++i) paths.add(seed_of(i % kColumns, i / kColumns));
  SampleTable& random =
      paths.draw_start(dimensions(camera_dimension::kPixel, 2) | dimensions(camera_dimension::kLens, 2) |
                       dimensions(camera_dimension::kTime, 1));
  auto &x = random.values[camera_dimension::kPixel], &y = random.values[camera_dimension::kPixel + 1];
  const auto& times = random.values[camera_dimension::kTime];
  const float width = static_cast<float>(context.width) / kColumns, height = static_cast<float>(context.height) / kRows;
  for (int i = 0; i < kColumns * kRows; ++i) {
    const auto path = static_cast<size_t>(i);
    x[path] = (x[path] + static_cast<float>(i % kColumns)) * width;
    y[path] = (y[path] + static_cast<float>(i / kColumns)) * height;
  }
  std::array<Ray, Paths::kCapacity> rays;
  context.camera->rays(
      {x.data(), y.data()},
      {random.values[camera_dimension::kLens].data(), random.values[camera_dimension::kLens + 1].data()},
      context.model->moving ? times.data() : nullptr, kColumns * kRows, rays.data());
  for (int i = 0; i < kColumns * kRows; ++i) {
    const auto path = static_cast<size_t>(i);
    const float time = context.model->moving ? times[path] : 0;
    paths.launch(i, rays[path], medium_at_camera<Model>(context, rays[path], time), time);
  }
  paths.stratify_channels();
}

// Adds one sample of the contribution of a group to each current hit. The radiance of the paths is lost.
void add_samples(Paths& paths, std::span<const LightSample> samples, size_t group, size_t first_receiver,
                 LightContributions& contributions) {
  using namespace transport;
  const auto uniform = 1 / static_cast<float>(contributions.groups);
  struct Densities {
    float weight, ratio;  // the MIS weight; p_b / p_l
  };
  std::array<Densities, Paths::kHitsAtATime> densities{};
  for (int i = 0; i < paths.hit_count(); ++i) paths.state_at(i).radiance = Rgb(0);
  add_light_samples_weighted(
      paths, samples, Shadows::cast, [&](int i, const LightSample& light, const auto& scattered) {
        if (light.delta)
          densities[static_cast<size_t>(i)] = {1, 0};
        else
          densities[static_cast<size_t>(i)] = {mis_weight(MisHeuristic::power, uniform * light.pdf, scattered.pdf),
                                               scattered.pdf / light.pdf};
        return 1 / light.pdf;
      });
  paths.reserve_connections(Paths::kCapacity);  // traces the shadow rays
  for (int i = 0; i < paths.hit_count(); ++i) {
    const float value = luminance(paths.state_at(i).radiance);
    if (!(value > 0) || !std::isfinite(sqr(value))) continue;
    auto& moments = contributions.moments[(first_receiver + static_cast<size_t>(i)) * contributions.groups + group];
    const auto [weight, ratio] = densities[static_cast<size_t>(i)];
    moments.mean += value;
    moments.square += sqr(value);
    moments.weighted += sqr(value * weight);
    moments.by_bsdf += sqr(value) * ratio;
  }
}

// By path, the receiver at its last vertex.
using LastReceivers = std::array<size_t, Paths::kCapacity>;

void add_contributions(Paths& paths, LightSampling sampling, uint32_t batch, LightContributions& contributions,
                       LastReceivers& last) {
  const size_t first = contributions.receivers.size();
  for (int i = 0; i < paths.hit_count(); ++i) {
    const int path = paths.path_at(i);
    last[static_cast<size_t>(path)] =
        contributions.add_receiver(paths.point(i).position, batch * kColumns * kRows + static_cast<uint32_t>(path));
  }
  const size_t samples = std::clamp<size_t>(kSamples / contributions.groups, 1, kMostSamplesOfAGroup);
  for (size_t group = 0; group < contributions.groups; ++group)
    for (size_t k = 0; k < samples; ++k)
      add_samples(paths, paths.sample_group(group, sampling, group * samples + k), group, first, contributions);
  const auto weight = 1 / static_cast<float>(samples);
  for (size_t i = first * contributions.groups; i < contributions.moments.size(); ++i) {
    auto& m = contributions.moments[i];
    m = {m.mean * weight, m.square * weight, m.weighted * weight, m.by_bsdf * weight};
  }
  paths.select_rng_stream(0);
}

// Adds the light of the environment that light samples leave out and that paths have found as they left the scene.
void add_environment_of_misses(Paths& paths, LightSampling sampling, const LastReceivers& last,
                               LightContributions& contributions) {
  if (paths.length() == 1) return;
  for (int i = 0; i < paths.miss_count(); ++i) {
    const auto& path = paths.missed_path(i);
    const auto value = paths.scene().lights().environment_value(path.from, paths.miss_direction(i), sampling);
    if (value.pdf_solid_angle > 0) continue;
    const float light = luminance(path.throughput * value.radiance);
    if (std::isfinite(sqr(light)))
      contributions.receivers[last[static_cast<size_t>(paths.path_of_miss(i))]].others += light;
  }
}

void trace_batch(const RenderContext& context, const Sampler& sampler, LightSampling sampling, int max_depth,
                 uint32_t batch, LightContributions& contributions) {
  Paths& paths = thread_wavefront<Model>();
  LastReceivers last{};
  launch_paths(context, sampler, batch, paths);
  while (paths.trace()) {
    add_environment_of_misses(paths, sampling, last, contributions);
    while (paths.next_hits()) {
      if (max_depth > 0 && paths.length() >= max_depth) continue;
      transport::scatter_below_surface(paths);
      add_contributions(paths, sampling, batch, contributions, last);
      transport::sample_bsdf(paths, kRouletteStart);
    }
  }
}

}  // namespace

std::shared_ptr<const LearnedLightChoice> learn_light_choice(const RenderContext& context, LightSampling sampling,
                                                             int max_depth) {
  const LightTable& lights = context.scene->lights();
  const size_t groups = lights.group_count(sampling);
  const bool learns =
      sampling.strategy == LightStrategy::automatic || sampling.strategy == LightStrategy::emission_auto;
  if (!learns || groups < 2) return nullptr;
  std::vector<float> usual(groups);
  for (size_t group = 0; group < groups; ++group) usual[group] = lights.usual_probability_of_group(group, sampling);
  LightContributions contributions(groups);
  const auto sampler = make_sampler("random");
  trace_batch(context, *sampler, sampling, max_depth, 0, contributions);
  if (LearnedLightChoice(contributions).gain(usual) < kLeastGain) return nullptr;
  for (uint32_t batch = 1; batch < kBatches; ++batch)
    trace_batch(context, *sampler, sampling, max_depth, batch, contributions);
  return std::make_shared<const LearnedLightChoice>(contributions);
}

}  // namespace etendue::integrator
