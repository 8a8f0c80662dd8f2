// Runs an integrator without a film on one thread. Measures the rays, the time and the bookkeeping of each of its
// phases.
#pragma once
#include <algorithm>
#include <chrono>
#include <memory>
#include <string>
#include <vector>

#include "film/film.h"
#include "integrator/integrator.h"
#include "render/prepared_document.h"
#include "scene/compiled_scene.h"

namespace etendue {

class IntegratorHarness {
 public:
  // A phase or the sampling of pixels, including the cost of splats.
  struct Part {
    std::string name;
    uint64_t rays = 0;
    double seconds = 0, bookkeeping = 0;  // without rays, all of the time is bookkeeping
  };

  IntegratorHarness(const render::Document& document, std::shared_ptr<const scene::CompiledScene> scene)
      : prepared_(document, std::move(scene)),
        state_(prepared_.integrator().begin(prepared_.context(), nullptr)),
        image_(static_cast<size_t>(document.width) * static_cast<size_t>(document.height)) {}
  IntegratorHarness(const IntegratorHarness&) = delete;

  // Renders one sample of all pixels.
  void step() {
    prepared_.prepare_sampler(sample_ / film::kHalfBuffers);
    const std::vector<integrator::Phase> phases = state_->phases(sample_);
    for (size_t i = 0; i < phases.size(); ++i) {
      measure(phases[i].name, [&] {
        uint64_t rays = 0;
        for (int task = 0; task < phases[i].tasks; ++task) rays += *state_->run(sample_, i, task, task_context_);
        state_->finish(sample_, i);
        return rays;
      });
    }
    if (prepared_.accumulation() != integrator::Accumulation::splats_only) measure("pixels", [&] { return pixels(); });
    ++sample_;
  }

  const std::vector<Part>& parts() const { return parts_; }
  Part total() const {
    Part sum;
    for (const Part& p : parts_) {
      sum.rays += p.rays;
      sum.seconds += p.seconds;
      sum.bookkeeping += p.bookkeeping;
    }
    return sum;
  }

 private:
  uint64_t pixels() {
    using integrator::PixelBlock;
    std::array<Rgb, PixelBlock::kMostPixels> out;
    const int width = prepared_.width(), height = prepared_.height();
    uint64_t rays = 0;
    for (int y = 0; y < height; y += PixelBlock::kHeight)
      for (int x = 0; x < width; x += PixelBlock::kWidth) {
        const PixelBlock block{x, y, std::min(PixelBlock::kWidth, width - x), std::min(PixelBlock::kHeight, height - y),
                               sample_};
        rays += *state_->sample(block, out, task_context_);
      }
    return rays;
  }

  template <class Traced>
  void measure(const char* name, Traced&& traced) {
    using Clock = std::chrono::steady_clock;
    auto part = std::find_if(parts_.begin(), parts_.end(), [&](const Part& p) { return p.name == name; });
    if (part == parts_.end()) part = parts_.insert(parts_.end(), Part{name});
    const double bookkeeping = watch_.seconds();
    const auto start = Clock::now();
    const uint64_t rays = traced();
    film::add_rows({&splats_, 1}, prepared_.width(), 0, prepared_.height(), image_);
    splats_.clear();
    const double took = std::chrono::duration<double>(Clock::now() - start).count();
    part->rays += rays;
    part->seconds += took;
    part->bookkeeping += rays > 0 ? watch_.seconds() - bookkeeping : took;
  }

  render::PreparedDocument prepared_;
  std::unique_ptr<integrator::RenderState> state_;
  uint32_t sample_ = 0;
  Stopwatch watch_;
  film::Splats splats_;
  integrator::TaskContext task_context_{nullptr, &splats_, &watch_};
  std::vector<Rgb> image_;
  std::vector<Part> parts_;
};

}  // namespace etendue
