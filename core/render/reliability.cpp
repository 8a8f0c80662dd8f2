#include "render/reliability.h"

#include <algorithm>
#include <array>
#include <bit>

#include "base/number_text.h"

namespace etendue::render {
namespace {

constexpr uint64_t kFewestPerPixel = 8;
constexpr double kVovLimit = 0.1;
constexpr double kFalseDiscoveryRate = 0.1;
constexpr double kDoubtfulShare = 0.002, kUnreliableShare = 0.05;  // of the image
constexpr double kBrightestSamples = 1e-4, kBrightestLimit = 0.1;
constexpr double kInvalidLimit = 1e-3;

bool seems_heavy(const film::Tail& tail) { return tail.heavy() && tail.vov > kVovLimit; }

// The largest probability of chance at which a tail counts as heavy, by the procedure of [Benjamini and Hochberg 1995].
double chance_limit(const std::vector<film::Tail>& reports) {
  std::vector<double> chances;
  size_t tests = 0;
  for (const auto& r : reports) {
    if (r.khat) ++tests;
    if (seems_heavy(r)) chances.push_back(r.p_value());
  }
  std::ranges::sort(chances);
  for (size_t i = chances.size(); i-- > 0;) {
    const double limit = kFalseDiscoveryRate * static_cast<double>(i + 1) / static_cast<double>(tests);
    if (chances[i] <= limit) return limit;
  }
  return -1;
}

struct Criterion {
  bool holds;
  Verdict verdict;
  std::string reason;
};

// The criteria in the order in which they are applied. The first one that holds decides.
std::vector<Criterion> criteria(const Reliability& r, uint64_t invalid, uint64_t samples, uint64_t pixels) {
  const double invalid_share = static_cast<double>(invalid) / std::max(1.0, static_cast<double>(samples));
  const std::string heavy = format_percent(r.heavy_share) + " of the image has heavy-tailed noise: ";
  return {
      {invalid_share > kInvalidLimit, Verdict::unreliable,
       format_percent(invalid_share) +
           " of the samples are invalid (NaN, infinite or negative) and were discarded: the image is too dark there"},
      {r.samples < kFewestPerPixel * pixels, Verdict::unknown, "too few samples to assess the error estimate"},
      {r.heavy_share >= kUnreliableShare, Verdict::unreliable, heavy + "its error estimate cannot be trusted"},
      {seems_heavy(r.tail), Verdict::unreliable,
       "a few rare samples dominate the noise of the image: its error estimate cannot be trusted"},
      {r.heavy_share >= kDoubtfulShare, Verdict::doubtful, heavy + "the error there is larger than estimated"},
      {r.tail.vov > kVovLimit, Verdict::doubtful,
       "a few samples carry most of the variance: the error estimate will change with more samples"},
      {r.tail.brightest_share > kBrightestLimit, Verdict::doubtful,
       "the brightest " + format_percent(kBrightestSamples) + " of the samples carry " +
           format_percent(r.tail.brightest_share) + " of the light"},
      {invalid > 0, Verdict::doubtful,
       std::to_string(invalid) + " invalid samples (NaN, infinite or negative) were discarded"},
      {true, Verdict::healthy, "no outliers detected"},
  };
}

// A histogram of the largest deviations of all tiles, to find the sum of the largest ones.
class DeviationHistogram {
 public:
  void add(std::span<const float> deviations) {
    for (const float x : deviations) {
      Bin& bin = bins_[std::bit_cast<uint32_t>(x) >> kShift];
      ++bin.count;
      bin.sum += static_cast<double>(x);
    }
  }

  // The sum of the `count` largest deviations. The bin that is not needed as a whole contributes in proportion.
  double sum_of_largest(double count) const {
    double total = 0;
    for (size_t i = bins_.size(); i-- > 0 && count > 0;) {
      const Bin& bin = bins_[i];
      if (bin.count == 0) continue;
      total += std::min(1.0, count / bin.count) * bin.sum;
      count -= bin.count;
    }
    return total;
  }

 private:
  // The index is the leading bits of a positive float: its exponent and four bits of its mantissa, that is sixteen bins
  // per octave.
  static constexpr int kShift = 19;
  struct Bin {
    double count = 0, sum = 0;
  };
  std::vector<Bin> bins_{size_t{1} << (31 - kShift)};
};

}  // namespace

std::string_view verdict_name(Verdict verdict) {
  constexpr std::array<std::string_view, 4> kNames{"unknown", "healthy", "doubtful", "unreliable"};
  return kNames[static_cast<size_t>(verdict)];
}

std::shared_ptr<const Reliability> reliability_of(const TailStatistics& tails, const std::vector<film::Tail>& reports,
                                                  const film::InvalidSamples& invalid, uint64_t samples,
                                                  const std::function<bool()>& keep_going) {
  auto result = std::make_shared<Reliability>();
  result->columns = tails.columns();
  result->rows = tails.rows();
  const double limit = chance_limit(reports);
  film::TailAccumulator all;
  DeviationHistogram histogram;
  int heavy_pixels = 0, tile = 0;
  for (const auto& collected : tails.tails()) {
    if (!keep_going()) return nullptr;
    // The state does not depend on interruptions of the rendering.
    const film::TailAccumulator tail(collected.capacity(), collected.state());
    all.merge(tail);
    histogram.add(tail.largest());
    const film::Tail& report = reports[static_cast<size_t>(tile)];
    const bool heavy = seems_heavy(report) && report.p_value() <= limit;
    result->tiles.push_back({.tail = report, .heavy = heavy});
    if (heavy) heavy_pixels += tails.pixels_of(tile);
    ++tile;
  }
  result->tail = all.report();
  result->samples = all.samples();
  if (all.sum() > 0) {
    const double brightest = kBrightestSamples * static_cast<double>(all.samples());
    result->tail.brightest_share = histogram.sum_of_largest(brightest) / all.sum();
  }
  const auto pixels = static_cast<uint64_t>(tails.width()) * static_cast<uint64_t>(tails.height());
  result->heavy_share = static_cast<double>(heavy_pixels) / static_cast<double>(pixels);
  for (auto& criterion : criteria(*result, invalid.total(), samples, pixels))
    if (criterion.holds) {
      result->verdict = criterion.verdict;
      result->reason = std::move(criterion.reason);
      break;
    }
  return result;
}

}  // namespace etendue::render
