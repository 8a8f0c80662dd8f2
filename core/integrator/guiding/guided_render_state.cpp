#include "integrator/guiding/guided_render_state.h"

#include <algorithm>
#include <cmath>

#include "scene/compiled_scene.h"

namespace etendue::guiding {
namespace {

using integrator::PixelBlock;

// Regions with more than c sqrt(n) records in an iteration of n samples are divided [Müller et al. 2017]. Of iterations
// longer than kFullyRecorded samples, random subsets of the paths are recorded, so that the number of records grows as
// sqrt(n), and the bound stays.
constexpr double kMostRecordsOfARegion = 4000;
constexpr uint32_t kFullyRecorded = 8;
// Of larger images, a random subset of about this many paths of each sample is recorded.
constexpr double kMostRecordedPaths = 1 << 20;
// The guided fraction until it is learned. It is small, because the weights of a path whose guide is poor have a variance
// that grows exponentially with its length.
constexpr float kFirstFraction = 0.25f;
constexpr uint64_t kLayout = 0x3145444955474345;  // "ECGUIDE1"

RadianceGuide initial_guide(const scene::CompiledScene& scene, float fraction) {
  const auto& bounds = scene.bounds();
  const Vec3 size = bounds.empty() ? Vec3(0) : bounds.max - bounds.min;
  const bool learns_fraction = fraction == 0;
  return {bounds.empty() ? Vec3(0) : bounds.min, size, learns_fraction, learns_fraction ? kFirstFraction : fraction};
}

int divide_up(int size, int part) { return (size + part - 1) / part; }

}  // namespace

GuidedRenderState::GuidedRenderState(const integrator::RenderContext& context, float fraction)
    : pixels_(static_cast<double>(context.width) * context.height),
      columns_(divide_up(context.width, PixelBlock::kWidth)),
      blocks_(static_cast<size_t>(columns_ * divide_up(context.height, PixelBlock::kHeight))),
      progress_{initial_guide(*context.scene, fraction)} {}

float GuidedRenderState::recorded_share() const {
  const double of_pixels = kMostRecordedPaths / pixels_;
  const double of_samples = std::sqrt(static_cast<double>(kFullyRecorded) / progress_.iteration);
  return static_cast<float>(std::min(of_pixels, 1.0) * std::min(of_samples, 1.0));
}

void GuidedRenderState::record(const PixelBlock& block, std::span<const Record> records) {
  blocks_[static_cast<size_t>(block.y / PixelBlock::kHeight * columns_ + block.x / PixelBlock::kWidth)].assign(records);
}

// The records of the sample before are added first.
std::vector<integrator::Phase> GuidedRenderState::phases(uint32_t sample) {
  learns_ = recorded_sample_ != sample && recorded_sample_ != kNoSample;
  if (!learns_) recorded_sample_ = sample;
  sample_ = sample;
  added_.fill(false);
  if (!learns_) return {};
  return {{"learning the incident radiance", BlockRecords::kGroups}};
}

std::optional<uint64_t> GuidedRenderState::run(uint32_t, size_t, int task, const integrator::TaskContext&) {
  for (const BlockRecords& block : blocks_) block.add_to(progress_.guide, task);
  added_[static_cast<size_t>(task)] = true;
  return 0;
}

void GuidedRenderState::finish(uint32_t sample, size_t) {
  end_sample(progress_);
  for (BlockRecords& block : blocks_) block.clear();
  recorded_sample_ = sample;
  learns_ = false;
}

size_t GuidedRenderState::memory() const {
  size_t bytes = progress_.guide.memory();
  for (const BlockRecords& block : blocks_) bytes += block.memory();
  return bytes;
}

std::vector<integrator::Statistic> GuidedRenderState::statistics() const {
  return {{"regions", static_cast<double>(progress_.guide.region_count()), "",
           "Regions of space with a distribution of directions of their own"}};
}

// What was learned, and the records of the blocks of the sample that has begun.
std::vector<std::byte> GuidedRenderState::state(uint32_t) const {
  StateWriter out;
  out.value(kLayout);
  if (learns_) {
    Progress progress = progress_;
    for (int group = 0; group < BlockRecords::kGroups; ++group)
      if (!added_[static_cast<size_t>(group)])
        for (const BlockRecords& block : blocks_) block.add_to(progress.guide, group);
    end_sample(progress);
    write(out, progress, sample_, {});
  } else {
    write(out, progress_, recorded_sample_, blocks_);
  }
  return out.take();
}

bool GuidedRenderState::restore(std::span<const std::byte> state) {
  StateReader in(state);
  Progress progress = progress_;
  uint64_t layout = 0, count = 0;
  uint32_t recorded = 0;
  if (!in.value(layout) || layout != kLayout || !in.value(progress.learned) || !in.value(progress.iteration) ||
      !progress.guide.read(in) || !in.value(recorded) || !in.value(count) || (count != 0 && count != blocks_.size()))
    return false;
  std::vector<std::vector<Record>> records(count);
  for (auto& list : records)
    if (!in.list(list) ||
        std::ranges::any_of(list, [&](const Record& r) { return r.region >= progress.guide.region_count(); }))
      return false;
  if (!in.at_end()) return false;
  progress_ = std::move(progress);
  recorded_sample_ = recorded;
  for (size_t i = 0; i < count; ++i) blocks_[i].assign(records[i]);
  return true;
}

// All records of a sample have been added.
void GuidedRenderState::end_sample(Progress& progress) {
  if (++progress.learned < progress.iteration) return;
  progress.guide.end_iteration(static_cast<uint64_t>(
      kMostRecordsOfARegion * std::sqrt(static_cast<double>(std::min(progress.iteration, kFullyRecorded)))));
  progress.learned = 0;
  progress.iteration *= 2;
}

void GuidedRenderState::write(StateWriter& out, const Progress& progress, uint32_t recorded,
                              std::span<const BlockRecords> blocks) {
  out.value(progress.learned);
  out.value(progress.iteration);
  progress.guide.write(out);
  out.value(recorded);
  out.value<uint64_t>(blocks.size());
  for (const BlockRecords& block : blocks) out.list(std::span(block.records()));
}

}  // namespace etendue::guiding
