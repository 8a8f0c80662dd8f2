#include "viewer/tasks/pixel_samples_task.h"

#include <algorithm>
#include <chrono>
#include <cmath>

#include "render/renderer.h"

namespace etendue::viewer {
namespace {

// Whole renderings of the pixel besides the one that is shown: their spread is the error, also where a sampler's points
// depend on each other.
constexpr size_t kHalves = 8;
constexpr double kStudent = 2.3646;  // the 97.5 % quantile of Student's t with as many degrees of freedom, less one

constexpr uint32_t kWindow = film::kHalves * render::kTableSamples;
constexpr double kSlice = 0.15;  // seconds between two looks at what there is so far

// Even numbers, eight to an octave: where the course of the mean is noted down.
uint32_t next_noted(uint32_t samples) {
  const uint32_t step = std::max(2u, static_cast<uint32_t>(samples * 0.09) & ~1u);
  // Powers of two are always among them.
  uint32_t power = 2;
  while (power <= samples) power *= 2;
  return std::min(samples + step, power);
}

}  // namespace

Histogram histogram_of(const std::vector<float>& values) {
  Histogram h;
  std::vector<float> positive;
  for (const float v : values)
    if (v > 0) positive.push_back(v);
  h.zeros = static_cast<uint32_t>(values.size() - positive.size());
  if (positive.empty()) return h;
  std::ranges::sort(positive);
  const auto share = [&](double q) {
    return double{positive[static_cast<size_t>(q * static_cast<double>(positive.size() - 1))]};
  };
  // Far apart are the ends of most of the samples, or the largest from all others.
  h.logarithmic = share(0.95) > 30 * share(0.05) || share(1) > 5 * share(0.95);
  h.low = h.logarithmic ? share(0) : 0;
  h.high = std::max(share(1), h.low * 1.01);
  const size_t bins = std::clamp<size_t>(static_cast<size_t>(std::sqrt(static_cast<double>(positive.size()))), 8, 48);
  h.counts.resize(bins);
  for (const float v : positive) {
    const double at = h.logarithmic ? std::log(v / h.low) / std::log(h.high / h.low) : (v - h.low) / (h.high - h.low);
    ++h.counts[std::min(static_cast<size_t>(at * static_cast<double>(bins)), bins - 1)];
  }
  return h;
}

// Samples as far as they were drawn, and what has been told from them.
struct PixelProbe::RenderState {
  RenderState(const render::Document& document, const Key& key) : samples(document, key.scene, key.pixel) {
    study.pixel = key.pixel, study.wanted = key.wanted;
  }

  // The next samples, as many as a slice of time holds.
  std::shared_ptr<const PixelStudy> go_on() {
    const auto start = std::chrono::steady_clock::now();
    while (drawn < study.wanted &&
           std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count() < kSlice)
      if (!window(std::min(study.wanted, (drawn / kWindow + 1) * kWindow))) return nullptr;
    study.histogram = histogram_of(luminances);
    study.tail = tail.report();
    study.mean = Rgb(static_cast<float>(colors[0] / drawn), static_cast<float>(colors[1] / drawn),
                     static_cast<float>(colors[2] / drawn));
    const double mean = (halves[0] + halves[1]) / drawn;
    study.deviation = std::sqrt(std::max(0.0, squares / drawn - mean * mean));
    auto so_far = std::make_shared<PixelStudy>(study);
    if (study.course.empty() || study.course.back().samples != drawn) so_far->course.push_back(moment());
    return so_far;
  }

  bool window(uint32_t end) {
    for (uint32_t r = 0; r < drawings.size(); ++r) {
      drawings[r].resize(end - drawn);
      if (!samples.draw(drawn, r, drawings[r], [this] { return wanted.load(); })) return false;
    }
    for (const size_t first = drawn; drawn < end;) take(drawn - first);
    return true;
  }

  void take(size_t i) {
    const Rgb& sample = drawings[0][i];
    const double y = std::max(0.0f, luminance(sample));
    watch(y);
    for (int c = 0; c < 3; ++c) colors[static_cast<size_t>(c)] += double{sample[c]};
    halves[drawn % 2] += y, squares += y * y;
    for (size_t r = 0; r < kHalves; ++r) others[r] += double{luminance(drawings[r + 1][i])};
    luminances.push_back(static_cast<float>(y));
    study.largest = std::max(study.largest, y);
    ++drawn;
    if (drawn == next || drawn == study.wanted) study.course.push_back(moment()), next = next_noted(drawn);
  }

  // As in a rendering: what a sample has above the mean before it; the first two have nothing to be compared with.
  void watch(double y) {
    if (drawn < 2) return;
    const auto deviation = static_cast<float>(y - (halves[0] + halves[1]) / drawn);
    tail.add(std::span(&deviation, 1), y);
  }

  PixelStudy::Moment moment() const {
    double sum = 0, sum_of_squares = 0;
    for (const double other : others) sum += other / drawn, sum_of_squares += sqr(other / drawn);
    const double variance = std::max(0.0, sum_of_squares - sum * sum / kHalves) / (kHalves - 1);
    const double a = (drawn + 1) / 2, b = drawn / 2;
    return {drawn,
            (halves[0] + halves[1]) / drawn,
            kStudent * std::sqrt(variance),
            {halves[0] / a, b > 0 ? halves[1] / b : 0}};
  }

  render::PixelSamples samples;
  std::atomic<bool> wanted{true};
  std::array<std::vector<Rgb>, kHalves + 1> drawings;  // of one window
  uint32_t drawn = 0, next = 2;
  std::array<double, 3> colors{};
  std::array<double, 2> halves{};
  std::array<double, kHalves> others{};
  double squares = 0;
  std::vector<float> luminances;
  film::TailAccumulator tail;
  PixelStudy study;
};

void PixelProbe::drop() {
  if (work_) work_->wanted = false;
  job_.abandon();
  work_.reset();
  key_.reset();
  settled_ = false;
}

bool PixelProbe::advance(uint32_t wanted) {
  bool fresh = settled_ = false;
  if (auto made = job_.take(); made && *made) study_ = std::move(*made), fresh = true;
  const auto& d = editor_.document();
  if (pixel_ && (pixel_->x >= d.width || pixel_->y >= d.height)) pixel_.reset(), drop();
  const auto scene = session_.scene();
  if (!render::PixelSamples::possible(d)) return drop(), study_.reset(), fresh;
  if (!pixel_ || !scene || session_.status().version != editor_.version()) return fresh;
  const Key key{scene, *pixel_, wanted, d.camera, d.width, d.height, d.filter, d.method, d.forced_flags, d.seed};
  if (!key_ || !(*key_ == key)) {
    drop();
    if (study_ && study_->pixel != *pixel_) study_.reset();
    key_ = key;
    work_ = std::make_shared<RenderState>(d, key);
  }
  if (job_.running()) return fresh;
  settled_ = work_->drawn >= wanted;
  if (!settled_) job_.start([work = work_] { return work->go_on(); });
  return fresh;
}

}  // namespace etendue::viewer
