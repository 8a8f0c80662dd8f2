#include "render/reliability.h"

#include <algorithm>
#include <array>
#include <bit>
#include <cstdio>

namespace etendue::render {
namespace {

constexpr uint64_t kFewestPerPixel = 8;
constexpr double kVovLimit = 0.1;
constexpr double kFalseAmongFound = 0.1;
constexpr double kSomeOfThePicture = 0.002, kMuchOfThePicture = 0.05;
constexpr double kBrightestLimit = 0.1;
constexpr double kManyRejected = 1e-3;

bool looks_heavy(const film::Tail& tail) { return tail.heavy() && tail.vov > kVovLimit; }

// The largest probability that still counts among so many looks (Benjamini & Hochberg 1995).
double chance_limit(const std::vector<film::Tail>& reports) {
  std::vector<double> chances;
  size_t looks = 0;
  for (const auto& r : reports) {
    if (r.khat) ++looks;
    if (looks_heavy(r)) chances.push_back(r.chance());
  }
  std::ranges::sort(chances);
  for (size_t i = chances.size(); i-- > 0;) {
    const double limit = kFalseAmongFound * static_cast<double>(i + 1) / static_cast<double>(looks);
    if (chances[i] <= limit) return limit;
  }
  return -1;
}

std::string percent(double share) {
  char text[32];
  std::snprintf(text, sizeof text, share < 0.0995 ? "%.2g %%" : "%.0f %%", 100 * share);
  return text;
}

struct Finding {
  bool holds;
  Verdict verdict;
  std::string reason;
};

// The first that holds is the verdict.
std::vector<Finding> findings(const Reliability& h, uint64_t rejected, uint64_t samples, uint64_t pixels) {
  const double refused = static_cast<double>(rejected) / std::max(1.0, static_cast<double>(samples));
  const std::string heavy = percent(h.heavy_share) + " of the picture has samples so rare and so bright that ";
  return {
      {refused > kManyRejected, Verdict::unreliable,
       percent(refused) + " of the samples were no radiance and were left out: the picture is too dark there"},
      {h.watched < kFewestPerPixel * pixels, Verdict::unknown, "there are too few samples to tell"},
      {h.heavy_share >= kMuchOfThePicture, Verdict::unreliable, heavy + "its stated error cannot be trusted"},
      {looks_heavy(h.tail), Verdict::unreliable,
       "so few samples carry the noise of the picture that its stated error cannot be trusted"},
      {h.heavy_share >= kSomeOfThePicture, Verdict::doubtful, heavy + "the error there is larger than it seems"},
      {h.tail.vov > kVovLimit, Verdict::doubtful,
       "a few samples carry most of the noise: the stated error will still change with more samples"},
      {h.tail.brightest > kBrightestLimit, Verdict::doubtful,
       "one sample in ten thousand carries " + percent(h.tail.brightest) + " of the light"},
      {rejected > 0, Verdict::doubtful, std::to_string(rejected) + " samples were no radiance and were left out"},
      {true, Verdict::healthy, "no sample weighs so much that the stated error could not be trusted"},
  };
}

// What the largest deviations of all tiles carry: their sum, up to a bin where only a part of it counts.
class Brightest {
 public:
  void add(std::span<const float> deviations) {
    for (const float x : deviations) {
      Bin& bin = bins_[std::bit_cast<uint32_t>(x) >> kShift];
      ++bin.count, bin.sum += static_cast<double>(x);
    }
  }

  double sum(double count) const {
    double total = 0;
    for (size_t i = bins_.size(); i-- > 0 && count > 0;) {
      const Bin& bin = bins_[i];
      if (bin.count == 0) continue;
      const double part = std::min(1.0, count / bin.count);
      total += part * bin.sum, count -= bin.count;
    }
    return total;
  }

 private:
  // Sixteen bins to a power of two; deviations that are kept are above zero.
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
                                                  const film::InvalidSamples& rejected, uint64_t samples,
                                                  const std::function<bool()>& keep_going) {
  auto health = std::make_shared<Reliability>();
  health->columns = tails.across(), health->rows = tails.down();
  const double limit = chance_limit(reports);
  film::TailAccumulator all;
  Brightest brightest;
  int heavy = 0, tile = 0;
  for (const auto& tail : tails.tails()) {
    if (!keep_going()) return nullptr;
    all.merge(tail);
    brightest.add(tail.kept());
    const film::Tail& report = reports[static_cast<size_t>(tile)];
    health->tiles.push_back({report, looks_heavy(report) && report.chance() <= limit});
    if (health->tiles.back().heavy) heavy += tails.pixels_of(tile);
    ++tile;
  }
  health->tail = all.report();
  health->watched = all.samples();
  if (all.sum() > 0) health->tail.brightest = brightest.sum(1e-4 * static_cast<double>(all.samples())) / all.sum();
  const auto pixels = static_cast<uint64_t>(tails.width()) * static_cast<uint64_t>(tails.height());
  health->heavy_share = static_cast<double>(heavy) / static_cast<double>(pixels);
  for (auto& finding : findings(*health, rejected.total(), samples, pixels))
    if (finding.holds) {
      health->verdict = finding.verdict, health->reason = std::move(finding.reason);
      break;
    }
  return health;
}

}  // namespace etendue::render
