// One document made ready for sampling, and the loops over its pixels.
//
// A step has stages: the phases that the method has before it looks at pixels, the blocks of pixels themselves, and,
// where what is found may belong to pixels anywhere, bringing all of it into the film at once. The film never sees a
// part of a sample. Each stage is a number of tasks, handed out a group at a time: what a group has splatted is added
// up before the next one begins, so that lists stay short.
#pragma once
#include <memory>

#include "film/film.h"
#include "film/firefly_reweighting.h"
#include "integrator/integrator.h"
#include "render/adaptive_sampling.h"
#include "render/document.h"
#include "render/tail_statistics.h"
#include "render/thread_pool.h"

namespace etendue::render {

class Renderer {
 public:
  // `previous` is what rendered before, if anything did: its method may have left something to go on with.
  Renderer(const Document& document, std::shared_ptr<const scene::CompiledScene> scene, int width, int height,
           const Renderer* previous = nullptr);
  Renderer(const Renderer&) = delete;
  Renderer& operator=(const Renderer&) = delete;

  struct Counters {
    std::atomic<uint64_t> rays{0}, paths{0};
  };
  // What samples are added to: the film, and what watches them, if anything does.
  struct Sinks {
    film::Film& film;
    TailStatistics* tails = nullptr;
    film::FireflyReweighting* reweighting = nullptr;
  };
  // Takes up a film: an empty one, or one that an equal runner left, with the state of the method's work that belongs
  // to it.
  void begin(film::Film& film, std::span<const std::byte> work = {});
  // The next step, as far as `keep_going` lets it; true if it is complete: another sample of every pixel, or, in
  // adaptive sampling, a piece of the allocation. Calling again goes on where it stopped: a pixel knows its samples by
  // their number. What was begun is finished, unless `still_needed` says that nobody will look at it.
  bool advance(
      ThreadPool& workers, const Sinks& sinks, const std::function<bool()>& keep_going, Counters& counters,
      const std::function<bool()>& still_needed = [] { return true; });
  // Samples of a pixel after the last complete step; in adaptive sampling on average.
  uint32_t samples() const { return samples_; }

  const transport::Model& model() const { return model_; }
  size_t memory() const;  // bytes, beyond the film
  // What the method keeps in space; null if nothing. Not while tasks run.
  std::shared_ptr<const std::vector<integrator::StoredPoint>> points() const { return work_->points(); }
  std::vector<integrator::Statistic> statistics() const { return work_->statistics(); }
  // What the method's work has to be given to go on after the last complete step.
  std::vector<std::byte> work_state() const { return work_->state(samples_); }

  // What the running step is at.
  struct Progress {
    const char* phase = nullptr;  // null while pixels are sampled
    double done = 0;              // of the phase, 0 to 1
  };
  Progress progress() const;

 private:
  using PixelBlock = integrator::PixelBlock;
  // What all tasks of a step hear of.
  struct Task {
    const Sinks& sinks;
    const std::function<bool()>& still_needed;
    Counters& counters;
  };
  struct Stage {
    enum class Kind { phase, blocks, deposit } kind;
    size_t phase = 0;
    size_t tasks = 0;
    const char* name = nullptr;
  };

  SampleAllocation::Piece piece() const;
  void prepare(uint32_t first_of_half);
  void finish_step(const film::Film& film);
  uint32_t average(const film::Film& film) const;
  PixelBlock block_at(size_t tile) const;
  bool has_blocks() const { return sampling_ != integrator::Accumulation::splats_only; }
  bool splats() const { return sampling_ >= integrator::Accumulation::with_splats; }
  void plan();
  bool run_stage(ThreadPool& workers, const Task& task, const std::function<bool()>& keep_going);
  void open_group();
  void add_splats(ThreadPool& workers);
  // All of these are false if the task was given up.
  bool run(const Task& task, size_t index);
  bool run_phase(const Task& task, size_t index);
  bool visit(const Task& task, size_t tile);
  bool sample(const Task& task, size_t tile, const PixelBlock& block);
  bool deposit(const Task& task, size_t tile);
  void add_to_picture(const PixelBlock& block, std::span<const Rgb> radiance);
  Rgb& pixel(int x, int y);  // of the picture
  film::Splats* splat_list(size_t index);
  static bool give_up(film::Splats* splats);
  void add(const Task& task, size_t tile, const PixelBlock& block, std::span<const Rgb> radiance) const;
  static void record_tile_variance(film::Film& film, size_t tile, const PixelBlock& block,
                                   std::span<const Rgb> radiance);

  std::shared_ptr<const scene::CompiledScene> scene_;
  transport::Model model_;
  std::unique_ptr<Sampler> sampler_;
  std::unique_ptr<integrator::Integrator> integrator_;
  CameraRays camera_;
  film::Filter filter_;
  uint64_t seed_;
  int width_, height_;
  integrator::Accumulation sampling_;
  Adaptive adaptive_;
  std::unique_ptr<integrator::RenderState> work_;
  size_t tiles_ = 0;
  std::optional<SampleAllocation> allocation_;  // in adaptive sampling
  uint32_t samples_ = 0;
  uint32_t prepared_ = 0;  // samples the sampler has tables for, per half

  // The running step; no stages between steps.
  std::vector<Stage> stages_;
  size_t stage_ = 0;
  size_t group_ = 0, group_end_ = 0;    // tasks of the stage that are being handed out
  std::vector<size_t> open_;            // those of them that still have to be done
  std::vector<film::Splats> splatted_;  // by task of the group
  std::vector<Rgb> picture_;            // this sample of all pixels, where splats belong to it
};

// Samples for which the samplers make tables at a time.
inline constexpr uint32_t kTableSamples = 64;

}  // namespace etendue::render
