// The interface of integrators: a description, parameters, and the state of one rendering.
//
// An image is rendered in samples; each sample covers all pixels. An integrator may have phases before the pixels of a
// sample: tracing photons, making virtual lights, or, for integrators whose paths end at arbitrary pixels (light
// tracing, Markov chains), all of the work. The tasks of a phase run in parallel. Calls across this interface are
// virtual and process thousands of rays each; the inner loops are templates over the transport model.
#pragma once
#include <cstddef>
#include <functional>
#include <memory>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "base/stopwatch.h"
#include "camera/camera_ray.h"
#include "film/filter.h"
#include "film/splats.h"
#include "integrator/integrator_info.h"
#include "integrator/pixel_block.h"
#include "sampling/sampler.h"
#include "scene/compiled_scene.h"
#include "spectrum/wavelengths.h"
#include "transport/model.h"

namespace etendue::transport {
class PathRecorder;
}

namespace etendue::integrator {

struct SolutionView;

// The constants of one rendering.
struct RenderContext {
  const scene::CompiledScene* scene;
  const transport::Model* model;
  const Sampler* sampler;
  const CameraRays* camera;
  const film::Filter* filter;
  uint64_t seed;  // of the user
  int width, height;
  // The time of all paths, from 0 (shutter opens) to 1 (shutter closes). Empty: each path samples its own time if the
  // scene moves.
  std::optional<float> shared_time{};
  // The name and the parameters of the sampler, for integrators that need another one of its kind.
  std::string_view sampler_name = "sobol";
  std::span<const Setting> sampler_settings{};

  bool samples_time() const { return model->moving && !shared_time; }
};

// The context with one time for all paths of a sample if the scene moves. For integrators whose passes must agree on
// the time. The times of the samples of one half-buffer are stratified over the shutter interval.
RenderContext at_shared_time(RenderContext context, uint32_t sample);

// The radiance of a path at its wavelengths, relative to illuminant D65.
struct SpectralSample {
  SampledSpectrum radiance;
  Wavelengths wavelengths;
};

// The environment of a running task.
struct TaskContext {
  // Polled at intervals; the task is cancelled when it returns false.
  const std::function<bool()>* keep_going = nullptr;
  // Receives contributions to arbitrary pixels.
  film::Splats* splats = nullptr;
  // Runs while a task does neither ray tracing nor shading: the bookkeeping of Markov chains, photon lookups. Null if
  // the time is not measured. Tasks that share a stopwatch run on one thread.
  Stopwatch* overhead_timer = nullptr;
  // Follows the path of one pixel; null: none. Only integrators with Accumulation::per_pixel record their paths.
  transport::PathRecorder* recorder = nullptr;
  // Receives the radiance of the paths of pixels in spectral rendering; null: not needed.
  std::vector<SpectralSample>* spectra = nullptr;
};

// Tasks that may run in parallel. The next phase starts after all of them.
struct Phase {
  const char* name;  // for display: "tracing photons"
  int tasks;
};

// The state of one rendering, kept from sample to sample. Tasks return the number of rays traced, or nothing if they
// were cancelled; a cancelled task is repeated from its beginning.
class RenderState {
 public:
  virtual ~RenderState() = default;

  // The phases before the pixels of a sample.
  virtual std::vector<Phase> phases(uint32_t sample) { return (void)sample, std::vector<Phase>(); }
  // The number of tasks of a phase when it starts, if it was not known before; `planned` is that of `phases`.
  virtual int task_count(uint32_t sample, size_t phase, int planned) { return (void)sample, (void)phase, planned; }
  virtual std::optional<uint64_t> run(uint32_t sample, size_t phase, int task, const TaskContext& task_context);
  // Called after the last task of a phase, while no other task runs.
  virtual void finish(uint32_t sample, size_t phase) { (void)sample, (void)phase; }

  // Fills `radiance` row by row of the block. Not called for integrators with Accumulation::splats_only.
  virtual std::optional<uint64_t> sample(const PixelBlock& block, std::span<Rgb> radiance,
                                         const TaskContext& task_context);

  virtual size_t memory() const { return 0; }  // bytes of stored data

  // A snapshot of the stored photons or virtual lights, kMostPoints at most; null if there are none. Called between
  // tasks.
  static constexpr size_t kMostPoints = 200'000;
  virtual std::shared_ptr<const std::vector<StoredPoint>> points() const { return nullptr; }
  // Called between tasks.
  virtual std::vector<Statistic> statistics() const { return {}; }
  // Approximations and failures that affect the image, as sentences for people. Called between tasks.
  virtual std::vector<std::string> notes() const { return {}; }
  // The solution of the radiosity equation as far as it is known; null if the integrator has none. Called between tasks.
  virtual std::shared_ptr<const SolutionView> solution_view() const { return nullptr; }

  // The serialised state that later samples depend on (the states of Markov chains), as it was before sample `sample`,
  // which is the current or the next one. Empty if there is none. An equal rendering that restores it before its first
  // sample continues bit-identically. If `restore` returns false, the rendering starts afresh, with equally correct
  // results.
  virtual std::vector<std::byte> state(uint32_t sample) const { return (void)sample, std::vector<std::byte>(); }
  virtual bool restore(std::span<const std::byte> state) { return state.empty(); }
};

// Light paths as path expressions, as in IntegratorInfo.
struct SampledPaths {
  std::string paths, point_paths;
};

class Integrator {
 public:
  virtual ~Integrator() = default;
  virtual std::vector<ParameterInfo> parameter_infos() const = 0;
  virtual bool set(std::string_view name, const Value& value) = 0;
  // The objects that `context` refers to, and the integrator, must outlive the state. `previous` is the state of the
  // previous rendering, by any integrator, or null; data of an unchanged scene may be reused.
  virtual std::unique_ptr<RenderState> begin(const RenderContext& context, const RenderState* previous) const = 0;
  // The paths that are sampled with these settings in a scene (null: in any scene that the settings apply to): those of
  // the description, and those that settings add. A limit of their length is not part of them.
  virtual SampledPaths sampled_paths(const scene::CompiledScene* scene) const = 0;
  // Why this integrator would find no light in this scene, and how to change that; empty if it is compatible.
  virtual std::string incompatibility(const RenderContext& context) const { return (void)context, std::string(); }
};

// `settings` must have been validated; names of other integrators' parameters are ignored. Null for an unknown name.
std::unique_ptr<Integrator> make_integrator(std::string_view name, const std::vector<Setting>& settings = {});

}  // namespace etendue::integrator
