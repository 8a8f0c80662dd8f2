// What an integrator is to the rest of the program: a description, parameters, and the work of making a picture.
//
// A picture is made sample by sample of all its pixels. A method that gathers answers for a block of pixels at a time,
// and for each by itself. One that sends something out first (photons, virtual lights), or whose paths end on pixels
// that it did not choose (light paths, Markov chains), has phases before that, whose tasks run side by side. All of it
// is chosen through virtual calls of tasks that trace thousands of rays; inside, the hot loops are templates over the
// transport model.
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
#include "transport/model.h"

namespace etendue::integrator {

// Everything of a picture that does not change from pixel to pixel.
struct RenderContext {
  const scene::CompiledScene* scene;
  const transport::Model* model;
  const Sampler* sampler;
  const CameraRays* camera;
  const film::Filter* filter;
  uint64_t seed;  // the user's
  int width, height;
  // When all paths are, from 0 at the shutter's opening to 1 at its closing; empty: each has a time of its own, if
  // anything moves.
  std::optional<float> shared_time{};

  bool samples_time() const { return model->moving && !shared_time; }
};

// The same with one moment for all of a sample, where anything moves: for methods whose first pass must see what the
// second does. Moments of the samples of a half lie evenly over the time that the shutter is open.
RenderContext at_shared_time(RenderContext context, uint32_t sample);

// What a task is given besides its name.
struct TaskContext {
  const std::function<bool()>* keep_going =
      nullptr;                     // asked now and then: a task is given up if nobody wants it any more
  film::Splats* splats = nullptr;  // takes what is found for pixels anywhere
  // Runs, if anybody asks, while a task is busy with neither rays nor shading: with the numbers and decisions of Markov
  // chains, or looking up photons. All tasks that it is given to run on one thread.
  Stopwatch* overhead_timer = nullptr;
};

// Tasks that may run side by side, and are done before anything else goes on.
struct Phase {
  const char* name;  // for people: "tracing photons"
  int tasks;
};

// One picture in the making: what a method keeps from one sample of its pixels to the next. Tasks return the number of
// rays traced; nothing if they were given up, and are then done again from their beginning.
class RenderState {
 public:
  virtual ~RenderState() = default;

  // What comes before sample `sample` of the pixels.
  virtual std::vector<Phase> phases(uint32_t sample) { return (void)sample, std::vector<Phase>(); }
  virtual std::optional<uint64_t> run(uint32_t sample, size_t phase, int task, const TaskContext& task_context);
  // Called alone, after the last task of a phase.
  virtual void finish(uint32_t sample, size_t phase) { (void)sample, (void)phase; }

  // Fills `radiance` row by row of the block. Of methods that only splat nobody asks it.
  virtual std::optional<uint64_t> sample(const PixelBlock& block, std::span<Rgb> radiance,
                                         const TaskContext& task_context);

  virtual size_t memory() const { return 0; }  // bytes, of what it keeps

  // A look at what it keeps in space, between two tasks: kMostPoints at most; null if it keeps nothing of the kind.
  static constexpr size_t kMostPoints = 200'000;
  virtual std::shared_ptr<const std::vector<StoredPoint>> points() const { return nullptr; }
  // Asked between tasks.
  virtual std::vector<Statistic> statistics() const { return {}; }

  // What later samples depend on besides their numbers (the states of Markov chains), as it was before anything was
  // done for sample `sample`, the present or the next one; empty if there is nothing. An equal work that takes it up
  // before its first sample goes on to the same bits; one that refuses goes on in its own way, as correctly.
  virtual std::vector<std::byte> state(uint32_t sample) const { return (void)sample, std::vector<std::byte>(); }
  virtual bool restore(std::span<const std::byte> state) { return state.empty(); }
};

class Integrator {
 public:
  virtual ~Integrator() = default;
  virtual std::vector<ParameterInfo> parameter_infos() const = 0;
  virtual bool set(std::string_view name, const Value& value) = 0;
  // What `pass` points to, and the integrator itself, must outlive the work. `previous` is what the picture before this
  // one left, by any method, or null: what it knows of the same scene may be used again.
  virtual std::unique_ptr<RenderState> begin(const RenderContext& context, const RenderState* previous) const = 0;
  // Why it finds no light at all in this picture, and what to do about it; empty if nothing stands in its way.
  virtual std::string incompatibility(const RenderContext& context) const { return (void)context, std::string(); }
};

// `settings` must have been checked; names the integrator does not have are ignored.
std::unique_ptr<Integrator> make_integrator(std::string_view name, const std::vector<Setting>& settings = {});

}  // namespace etendue::integrator
