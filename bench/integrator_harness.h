// A method's work without a film, on one thread, for benchmarks that look into it: what each of its phases traces, how
// long that takes, and how much of it is bookkeeping.
#pragma once
#include <algorithm>
#include <chrono>
#include <memory>
#include <string>
#include <vector>

#include "film/film.h"
#include "integrator/integrator.h"
#include "render/document.h"
#include "scene/compiled_scene.h"

namespace etendue {

class WorkRig {
 public:
  // A phase, or the pixels; what splats cost is part of it.
  struct Part {
    std::string name;
    uint64_t rays = 0;
    double seconds = 0, apart = 0;  // `apart`: bookkeeping; all of it where no rays are traced
  };

  WorkRig(const render::Document& document, std::shared_ptr<const scene::CompiledScene> scene)
      : width_(document.width),
        height_(document.height),
        scene_(std::move(scene)),
        model_(transport::model_for(*scene_, document.forced_flags, document.method.paths)),
        sampler_(make_sampler(document.method.sampler, document.method.settings_of(document.method.sampler))),
        integrator_(integrator::make_integrator(document.method.integrator,
                                                document.method.settings_of(document.method.integrator))),
        camera_(document.camera, width_, height_, scene_->camera_motion()),
        filter_(document.filter),
        splats_only_(integrator::find_integrator(document.method.integrator)->accumulation ==
                     integrator::Accumulation::splats_only),
        picture_(static_cast<size_t>(width_) * static_cast<size_t>(height_)) {
    work_ = integrator_->begin(
        {scene_.get(), &model_, sampler_.get(), &camera_, &filter_, document.seed, width_, height_}, nullptr);
  }
  WorkRig(const WorkRig&) = delete;

  // One sample of all pixels.
  void step() {
    constexpr uint32_t kTable = 64;
    const uint32_t of_half = sample_ / film::kHalfBuffers;
    if (of_half % kTable == 0) sampler_->prepare(of_half, kTable);
    const std::vector<integrator::Phase> phases = work_->phases(sample_);
    for (size_t i = 0; i < phases.size(); ++i) {
      measure(phases[i].name, [&] {
        uint64_t rays = 0;
        for (int task = 0; task < phases[i].tasks; ++task) rays += *work_->run(sample_, i, task, task_context_);
        work_->finish(sample_, i);
        return rays;
      });
    }
    if (!splats_only_) measure("pixels", [&] { return pixels(); });
    ++sample_;
  }

  const std::vector<Part>& parts() const { return parts_; }
  Part total() const {
    Part sum;
    for (const Part& p : parts_) sum.rays += p.rays, sum.seconds += p.seconds, sum.apart += p.apart;
    return sum;
  }

 private:
  uint64_t pixels() {
    using integrator::PixelBlock;
    std::array<Rgb, PixelBlock::kMostPixels> out;
    uint64_t rays = 0;
    for (int y = 0; y < height_; y += PixelBlock::kHeight)
      for (int x = 0; x < width_; x += PixelBlock::kWidth) {
        const PixelBlock block{x, y, std::min(PixelBlock::kWidth, width_ - x),
                               std::min(PixelBlock::kHeight, height_ - y), sample_};
        rays += *work_->sample(block, out, task_context_);
      }
    return rays;
  }

  template <class Traced>
  void measure(const char* name, Traced&& traced) {
    using Clock = std::chrono::steady_clock;
    auto part = std::find_if(parts_.begin(), parts_.end(), [&](const Part& p) { return p.name == name; });
    if (part == parts_.end()) part = parts_.insert(parts_.end(), Part{name});
    const double apart = watch_.seconds();
    const auto start = Clock::now();
    const uint64_t rays = traced();
    film::add_rows({&splats_, 1}, width_, 0, height_, picture_);
    splats_.clear();
    const double took = std::chrono::duration<double>(Clock::now() - start).count();
    part->rays += rays, part->seconds += took;
    part->apart += rays > 0 ? watch_.seconds() - apart : took;
  }

  int width_, height_;
  std::shared_ptr<const scene::CompiledScene> scene_;
  transport::Model model_;
  std::unique_ptr<Sampler> sampler_;
  std::unique_ptr<integrator::Integrator> integrator_;
  CameraRays camera_;
  film::Filter filter_;
  bool splats_only_;
  std::unique_ptr<integrator::RenderState> work_;
  uint32_t sample_ = 0;
  Stopwatch watch_;
  film::Splats splats_;
  integrator::TaskContext task_context_{nullptr, &splats_, &watch_};
  std::vector<Rgb> picture_;
  std::vector<Part> parts_;
};

}  // namespace etendue
