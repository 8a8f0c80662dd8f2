#include "integrator/path/path_layers.h"

#include <algorithm>
#include <utility>

#include "film/invalid_samples.h"
#include "integrator/path/path_tracing_parameters.h"
#include "integrator/shared/light_learning.h"
#include "transport/wavefront/equiangular_light.h"
#include "transport/wavefront/medium_light.h"
#include "transport/wavefront/subsurface_scattering.h"

namespace etendue::integrator {
namespace {

using transport::Automaton;
using transport::PathWavefront;

constexpr std::string_view kWithLightSamples = "path", kWithoutLightSamples = "path-pure";

// Distributes the contributions of the paths of a wavefront over layers. The radiance of a path holds the contributions
// that were added since the last call of `collect` only.
template <class M>
class LayerCollector {
 public:
  using Color = typename M::Color;

  void begin(const PathLayerRecording& recording, PathWavefront<M>& paths) {
    recording_ = &recording;
    paths_ = &paths;
    const size_t layers = recording.layers().size();
    totals_.fill(Color(0));
    sums_.assign(layers * kPaths, Color(0));
    class_of_.clear();
    std::vector<const Automaton*> classes{recording.image() ? recording.image()
                                                            : &transport::PathExpression::all().automaton()};
    for (const PathLayer& layer : recording.layers()) {
      class_of_.push_back(layer.paths ? classes.size() : 0);
      if (layer.paths) classes.push_back(layer.paths.get());
    }
    shares_.resize(classes.size());
    fractions_.resize(classes.size());
    for (size_t k = 0; k < classes.size(); ++k) {
      shares_[k].begin(*classes[k]);
      for (int i = 0; i < paths.size(); ++i) shares_[k].launch(i);
    }
  }

  // Contributions of paths that end at an emitter or at a light in a volume, after this number of bounces.
  void collect_emission(int path, int bounces) {
    collect(path, bounces, [&](const auto& shares) { return shares.end_share(path); });
  }
  void collect_volume_connection(int path, int bounces) {
    collect(path, bounces, [&](const auto& shares) { return shares.volume_connection_share(path); });
  }
  // Contributions of a connection from a current hit in direction wi.
  void collect_connection(int hit, const Vec3& wi) {
    const int path = paths_->path_at(hit);
    collect(path, paths_->length(), [&](const auto& shares) {
      return shares.connection_value(path, paths_->bsdf(hit), paths_->wo(hit), wi, Color(1));
    });
  }

  // The filter of BSDF samples: false if no continuation belongs to the image.
  struct Accept {
    LayerCollector* collector;
    bool operator()(PathWavefront<M>& paths, int hit, LobeSample<Color>& s) const {
      const int path = paths.path_at(hit);
      bool is_in_image = true;
      for (size_t k = 0; k < collector->shares_.size(); ++k) {
        const bool continues = collector->shares_[k].scatter(path, paths.bsdf(hit), paths.wo(hit), s);
        if (k == 0) is_in_image = continues;
      }
      return is_in_image;
    }
  };
  Accept accept() { return {this}; }

  const Color& total(int path) const { return totals_[static_cast<size_t>(path)]; }
  const Color& sum(size_t layer, int path) const { return sums_[layer * kPaths + static_cast<size_t>(path)]; }

 private:
  static constexpr size_t kPaths = PathWavefront<M>::kCapacity;

  template <class Share>
  void collect(int path, int bounces, Share&& share_of) {
    Color& radiance = paths_->state(path).radiance;
    if (is_black(radiance)) return;
    const Color value = std::exchange(radiance, Color(0));
    for (size_t k = 0; k < shares_.size(); ++k) fractions_[k] = value * share_of(shares_[k]);
    totals_[static_cast<size_t>(path)] += fractions_[0];
    const std::vector<PathLayer>& layers = recording_->layers();
    for (size_t k = 0; k < layers.size(); ++k)
      if (bounces >= layers[k].first_bounce && bounces <= layers[k].last_bounce)
        sums_[k * kPaths + static_cast<size_t>(path)] += fractions_[class_of_[k]];
  }

  const PathLayerRecording* recording_ = nullptr;
  PathWavefront<M>* paths_ = nullptr;
  std::vector<transport::ClassShares<M>> shares_;  // of the image, then of the layers with path classes
  std::vector<size_t> class_of_;                   // by layer
  std::vector<Color> fractions_;                   // by class
  std::array<Color, kPaths> totals_;               // of the image
  std::vector<Color> sums_;                        // by layer and path
};

// Traces the shadow rays of all connections.
template <class M>
void resolve_connections(PathWavefront<M>& paths) {
  paths.reserve_connections(PathWavefront<M>::kCapacity);
}

class LayeredPathTracing final : public IntegratorBase<LayeredPathTracing>, public PathTracingParameters {
 public:
  LayeredPathTracing(bool samples_lights, PathLayerRecording& recording)
      : samples_lights_(samples_lights), recording_(recording) {}

  auto parameters() { return std::tuple_cat(std::tie(max_depth), path_parameters()); }

  static IntegratorInfo info() { return *find_integrator("path"); }
  SampledPaths sampled_paths(const scene::CompiledScene*) const override {
    const IntegratorInfo& divided = *find_integrator(samples_lights_ ? "path" : "path-pure");
    return {divided.paths, divided.point_paths};
  }

  std::unique_ptr<RenderState> begin(const RenderContext& context, const RenderState*) const override {
    return std::make_unique<Blocks>(*this, context);
  }

 private:
  class Blocks final : public RenderState {
   public:
    Blocks(const LayeredPathTracing& integrator, const RenderContext& context)
        : integrator_(integrator),
          context_(context),
          learned_(learn_light_choice(context, integrator.light_sampling(), integrator.max_depth)) {}

    std::optional<uint64_t> sample(const PixelBlock& block, std::span<Rgb> radiance,
                                   const TaskContext& task_context) override {
      const auto sampling = integrator_.light_sampling().with(learned_.get());
      return integrator_.sample(context_, sampling, block, radiance, task_context);
    }

   private:
    const LayeredPathTracing& integrator_;
    const RenderContext context_;
    const std::shared_ptr<const LearnedLightChoice> learned_;  // null: nothing to learn
  };

  std::optional<uint64_t> sample(const RenderContext& context, LightSampling sampling, const PixelBlock& block,
                                 std::span<Rgb> radiance, const TaskContext& task_context) const {
    if (context.model->spectral)
      return sample_in<transport::Spectral>(context, sampling, block, radiance, task_context);
    return sample_in<transport::ScatteringMedia<true>>(context, sampling, block, radiance, task_context);
  }

  template <class M>
  std::optional<uint64_t> sample_in(const RenderContext& given_context, LightSampling sampling, const PixelBlock& block,
                                    std::span<Rgb> radiance, const TaskContext& task_context) const {
    // The wavefront follows all paths; the collector takes the shares of classes.
    transport::Model model = *given_context.model;
    model.paths =
        std::shared_ptr<const transport::PathExpression>(std::shared_ptr<void>(), &transport::PathExpression::all());
    RenderContext context = given_context;
    context.model = &model;
    PathWavefront<M>& paths = thread_wavefront<M>();
    static thread_local const auto collector = std::make_unique<LayerCollector<M>>();
    const PixelOrder order(block);
    launch_camera_paths(context, block, order, task_context, paths);
    paths.stratify_channels();
    collector->begin(recording_, paths);
    estimate(paths, sampling, *collector);
    if (paths.cancelled()) return {};
    std::vector<Rgb> values(recording_.layers().size() * PixelBlock::kMostPixels, Rgb(0));
    for (int i = 0; i < paths.size(); ++i) {
      radiance[order.index(i)] = paths.color().to_rgb(i, collector->total(i));
      for (size_t k = 0; k < recording_.layers().size(); ++k)
        values[k * PixelBlock::kMostPixels + order.index(i)] = paths.color().to_rgb(i, collector->sum(k, i));
    }
    recording_.add(block, radiance, values);
    return paths.rays_traced();
  }

  // The estimators of path tracing, whose connections are resolved at once.
  template <class M>
  void estimate(PathWavefront<M>& paths, LightSampling sampling, LayerCollector<M>& collector) const {
    using namespace transport;
    const Combination combination = samples_lights_ ? Combination(mis()) : Combination();
    // The direction of a light sample in an emitting medium is not known here, so with classes only paths find them.
    MediumLight<M> media(paths, recording_.has_classes() ? Combination() : combination);
    EquiangularLight<M> segments(paths, sampling, mis());
    const bool on_segments = samples_lights_ && equiangular;
    while (paths.trace()) {
      add_environment(paths, combination, sampling);
      media.add_emission_of_misses();
      for (int i = 0; i < paths.miss_count(); ++i)
        collector.collect_emission(paths.path_of_miss(i), paths.length() - 1);
      if (on_segments && !at_max_depth(paths.length())) {
        segments.add_light_of_misses();
        resolve_connections(paths);
        for (int i = 0; i < paths.miss_count(); ++i)
          collector.collect_volume_connection(paths.path_of_miss(i), paths.length());
      }
      while (paths.next_hits()) {
        media.add_emission_before_hits();
        add_emission(paths, combination, sampling);
        for (int i = 0; i < paths.hit_count(); ++i) collector.collect_emission(paths.path_at(i), paths.length() - 1);
        if (at_max_depth(paths.length())) continue;
        if (on_segments) {
          segments.add_light_before_hits();
          resolve_connections(paths);
          for (int i = 0; i < paths.hit_count(); ++i)
            collector.collect_volume_connection(paths.path_at(i), paths.length());
        }
        scatter_below_surface(paths);
        if (samples_lights_) {
          add_light(paths, collector, sampling, on_segments ? &segments : nullptr);
          media.add_light_samples();
          for (int i = 0; i < paths.hit_count(); ++i) collector.collect_connection(i, paths.wo(i));
        }
        sample_bsdf(paths, roulette(), TransportMode::radiance, collector.accept());
      }
    }
  }

  template <class M>
  void add_light(PathWavefront<M>& paths, LayerCollector<M>& collector, LightSampling sampling,
                 const transport::EquiangularLight<M>* segments) const {
    const LightTable& table = paths.scene().lights();
    if (table.empty(sampling)) return;
    const auto add = [&](std::span<const LightSample> samples) {
      transport::add_light_samples(paths, samples, mis(), transport::Shadows::cast, 1,
                                   [&](int hit, const LightSample& light) {
                                     return segments ? segments->weight_of_light_sample(hit, light) : 1.0f;
                                   });
      resolve_connections(paths);
      for (int i = 0; i < paths.hit_count(); ++i) collector.collect_connection(i, samples[static_cast<size_t>(i)].wi);
    };
    const bool every = sampling.strategy == LightStrategy::every;
    const size_t sources = every ? table.source_count(sampling) : 1;
    for (size_t stream = 0; stream < sources * static_cast<size_t>(light_samples.value); ++stream) {
      paths.select_light_stream(stream);
      add(every ? paths.sample_source(stream % sources, sampling, stream) : paths.sample_lights(sampling));
    }
    paths.select_rng_stream(0);
  }

  bool samples_lights_;
  PathLayerRecording& recording_;
};

}  // namespace

bool PathLayerRecording::has_classes() const {
  return image_ || std::ranges::any_of(layers_, [](const PathLayer& layer) { return layer.paths != nullptr; });
}

void PathLayerRecording::clear(int width, int height) {
  width_ = width;
  height_ = height;
  const size_t pixels = static_cast<size_t>(width) * static_cast<size_t>(height);
  sums_.assign(layers_.size(), std::vector<double>(3 * pixels));
  counts_.assign(pixels, 0);
}

void PathLayerRecording::add(const PixelBlock& block, std::span<const Rgb> radiance, std::span<const Rgb> values) {
  for (int y = 0; y < block.height; ++y)
    for (int x = 0; x < block.width; ++x) {
      const auto in_block = static_cast<size_t>(y * block.width + x);
      const size_t pixel =
          static_cast<size_t>(block.y + y) * static_cast<size_t>(width_) + static_cast<size_t>(block.x + x);
      ++counts_[pixel];
      if (!film::is_radiance(radiance[in_block])) continue;
      for (size_t k = 0; k < layers_.size(); ++k) {
        const Rgb& value = values[k * PixelBlock::kMostPixels + in_block];
        for (int c = 0; c < 3; ++c) sums_[k][3 * pixel + static_cast<size_t>(c)] += double{value[c]};
      }
    }
}

std::vector<float> PathLayerRecording::mean(size_t layer) const {
  std::vector<float> mean(sums_[layer].size());
  for (size_t i = 0; i < mean.size(); ++i)
    if (const uint32_t count = counts_[i / 3]; count > 0) mean[i] = static_cast<float>(sums_[layer][i] / count);
  return mean;
}

std::string path_layers_incompatibility(std::string_view integrator) {
  if (integrator == kWithLightSamples || integrator == kWithoutLightSamples) return {};
  return "the layers of light paths are recorded by the integrators " + std::string(kWithLightSamples) + " and " +
         std::string(kWithoutLightSamples) + ", not by " + std::string(integrator) +
         ": use one of them, or film.paths for one class at a time";
}

std::unique_ptr<Integrator> make_layered_integrator(std::string_view name, const std::vector<Setting>& settings,
                                                    PathLayerRecording& recording) {
  auto layered = std::make_unique<LayeredPathTracing>(name == kWithLightSamples, recording);
  for (const Setting& setting : settings) layered->set(setting.name, setting.value);
  return layered;
}

}  // namespace etendue::integrator
