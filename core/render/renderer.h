// Renders a prepared document sample by sample: schedules the tasks of each sample on a thread pool and records the
// results in a film.
//
// One step takes one sample of every pixel. It consists of stages: the integrator's phases (tracing photons, light
// subpaths), the pixel blocks, and, for integrators that splat, the transfer of the splatted image to the film. The
// film therefore never holds a part of a sample. The tasks of a stage that may splat are handed out in batches, because
// their splats have to be merged in the order of the tasks.
#pragma once
#include <atomic>
#include <memory>

#include "render/adaptive_sampling.h"
#include "render/film_recording.h"
#include "render/prepared_document.h"
#include "render/splat_image.h"
#include "render/thread_pool.h"

namespace etendue::render {

class Renderer {
 public:
  // `previous` is the renderer of the previous image, or null. The integrator may reuse what that one computed for the
  // same scene. `layers` receives layers of the paths, or is null; it must outlive the renderer.
  Renderer(const Document& document, std::shared_ptr<const scene::CompiledScene> scene, int width, int height,
           const Renderer* previous = nullptr, integrator::PathLayerRecording* layers = nullptr);
  Renderer(const Renderer&) = delete;
  Renderer& operator=(const Renderer&) = delete;

  struct Counters {
    std::atomic<uint64_t> rays{0}, paths{0};
  };

  // Starts with a film: an empty one, or one that an equal renderer left, together with the saved state of its
  // integrator. A part of a rendering (Document::part) takes the samples of that part only. An integrator that refuses the state continues without it.
  void begin(film::Film& film, std::span<const std::byte> integrator_state = {});

  // Performs the current step until it is complete or `keep_going` returns false between two tasks. True if the step is
  // complete: one more sample of every pixel, or, with adaptive sampling, one range of samples of the allocation. The
  // next call continues where this one stopped. Tasks that were begun are finished, unless `still_needed` returns
  // false.
  bool advance(
      ThreadPool& workers, const FilmTargets& targets, const std::function<bool()>& keep_going, Counters& counters,
      const std::function<bool()>& still_needed = [] { return true; });

  // Restricts the following steps to a region of whole pixel blocks, or to all pixels of the document's part. `samples`
  // then counts those of that region. Not with adaptive sampling. Returns false, and changes nothing, while a step is in
  // progress that has to be completed.
  bool restrict_to(const std::optional<PixelRect>& region, const film::Film& film);

  // Whether a step has been begun and is not complete.
  bool is_in_step() const { return !stages_.empty(); }
  // The next step takes the sample of this number. Between steps only, and not with adaptive sampling.
  void continue_at(uint32_t sample) { first_sample_ = sample - samples_; }
  // Samples of others have been added to each pixel of the film.
  void film_has_received(uint32_t samples) { received_ += samples; }

  // Samples per pixel of the document's part after the last complete step; with adaptive sampling the average over the
  // pixels.
  uint32_t samples() const { return samples_; }

  const transport::Model& model() const { return prepared_.model(); }
  size_t memory() const;  // bytes, without the film
  // Photons or virtual lights that the integrator stores; null if none. Not while tasks run.
  std::shared_ptr<const std::vector<integrator::StoredPoint>> stored_points() const { return state_->points(); }
  std::vector<integrator::Statistic> statistics() const { return state_->statistics(); }
  std::vector<std::string> notes() const { return state_->notes(); }
  // As far as it is known; null if the integrator has none. Not while tasks run.
  std::shared_ptr<const integrator::SolutionView> solution_view() const { return state_->solution_view(); }
  // The state of the integrator after the last complete step, for `begin`.
  std::vector<std::byte> integrator_state() const { return state_->state(sample()); }

  // The phase that is running.
  struct Progress {
    const char* phase = nullptr;  // null while pixels are sampled
    double done = 0;              // fraction of the phase, 0 to 1
  };
  Progress progress() const;

 private:
  using PixelBlock = integrator::PixelBlock;
  // What all tasks of a step share.
  struct StepContext {
    const FilmTargets& targets;
    const std::function<bool()>& still_needed;
    Counters& counters;
  };
  struct Stage {
    enum class Kind { phase, blocks, deposit } kind;
    size_t phase = 0;  // number of the integrator's phase
    size_t tasks = 0;
    const char* name = nullptr;
  };

  bool samples_blocks() const { return prepared_.accumulation() != integrator::Accumulation::splats_only; }
  bool splats() const { return prepared_.accumulation() >= integrator::Accumulation::with_splats; }
  bool writes_splats(const Stage& stage) const { return splats() && stage.kind != Stage::Kind::deposit; }

  // The number of the sample that the current step takes.
  uint32_t sample() const { return first_sample_ + samples_; }
  SampleRange range() const;
  uint32_t samples_of(const film::Film& film) const;
  PixelBlock block_at(size_t tile) const;
  // The pixels of a block that are rendered: all, unless it lies on the boundary of the region.
  PixelBlock visible(const PixelBlock& block) const;

  void lay_out_tiles();

  // Scheduling of stages.
  void plan_step();
  bool run_stage(ThreadPool& workers, const StepContext& step, const std::function<bool()>& keep_going);
  void begin_batch();
  void finish_step(const film::Film& film);

  // Tasks; false if the task was cancelled.
  bool run_task(const StepContext& step, size_t index);
  bool run_phase(const StepContext& step, size_t index);
  bool sample_tile(const StepContext& step, size_t tile);
  bool sample_block(const StepContext& step, size_t tile, const PixelBlock& block);
  bool deposit_tile(const StepContext& step, size_t tile);
  film::Splats* splat_list(size_t index);
  void record(const StepContext& step, size_t tile, const PixelBlock& block, std::span<const Rgb> radiance) const;

  PreparedDocument prepared_;
  int width_, height_;
  uint32_t first_sample_;
  PixelRect part_;    // the pixels of the document's part
  PixelRect region_;  // the pixels that are rendered
  Adaptive adaptive_;
  std::unique_ptr<integrator::RenderState> state_;
  int columns_ = 0;                             // of tiles, in the region
  size_t tiles_ = 0;                            // in the region
  std::optional<SampleAllocation> allocation_;  // with adaptive sampling
  uint32_t samples_ = 0;
  uint32_t received_ = 0;  // samples per pixel in the film that others have taken

  // The current step; no stages between steps.
  std::vector<Stage> stages_;
  size_t stage_ = 0;
  size_t batch_begin_ = 0, batch_end_ = 0;  // tasks of the stage that are being handed out
  std::vector<size_t> open_tasks_;          // tasks of the batch that are not done
  SplatImage splat_image_;                  // the current sample of all pixels, for integrators that splat
};

}  // namespace etendue::render
