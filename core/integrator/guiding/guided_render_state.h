// The state of renderings that learn a guide from their samples: the guide, and the records of the sample that has
// begun.
//
// The guide is learned in iterations of 2, 4, 8, ... samples; each iteration is guided by the one before. The records of a
// sample are added before the next sample begins, in an order that does not depend on threads.
#pragma once
#include <array>
#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include "integrator/guiding/block_records.h"
#include "integrator/integrator.h"

namespace etendue::guiding {

// The guide of a block of paths, and where their records are appended.
struct GuidedBlock {
  const RadianceGuide& guide;
  float recorded_share;  // the fraction of paths that are recorded
  std::vector<Record>& records;
};

// Integrators derive from it and implement sample().
class GuidedRenderState : public integrator::RenderState {
 public:
  std::vector<integrator::Phase> phases(uint32_t sample) override;
  std::optional<uint64_t> run(uint32_t sample, size_t phase, int task, const integrator::TaskContext&) override;
  void finish(uint32_t sample, size_t phase) override;
  size_t memory() const override;
  std::vector<integrator::Statistic> statistics() const override;
  std::vector<std::byte> state(uint32_t sample) const override;
  bool restore(std::span<const std::byte> state) override;

 protected:
  // `fraction` is the fraction of directions that are sampled by the guide; 0: learned for each region.
  GuidedRenderState(const integrator::RenderContext& context, float fraction);

  const RadianceGuide& guide() const { return progress_.guide; }
  // The fraction of paths that are recorded.
  float recorded_share() const;
  // Keeps the records of a block of the current sample. Blocks may be recorded at the same time.
  void record(const integrator::PixelBlock& block, std::span<const Record> records);

 private:
  static constexpr uint32_t kFirstIteration = 2;  // samples
  static constexpr uint32_t kNoSample = UINT32_MAX;

  struct Progress {
    RadianceGuide guide;
    uint32_t learned = 0;                  // samples of this iteration
    uint32_t iteration = kFirstIteration;  // length of this iteration
  };
  static void end_sample(Progress& progress);
  static void write(StateWriter& out, const Progress& progress, uint32_t recorded,
                    std::span<const BlockRecords> blocks);

  const double pixels_;
  const int columns_;
  std::vector<BlockRecords> blocks_;  // of the recorded sample
  Progress progress_;
  uint32_t recorded_sample_ = kNoSample, sample_ = kNoSample;
  bool learns_ = false;                              // the phase of `sample_` has not ended
  std::array<bool, BlockRecords::kGroups> added_{};  // by task of the phase
};

}  // namespace etendue::guiding
