// Can the picture's stated error be believed? One verdict of what the tails of its tiles say.
//
// unknown     fewer than eight watched samples per pixel
// unreliable  5 % of the picture or more has a heavy tail; or the picture as a whole has one; or one sample in a
//             thousand was no radiance
// doubtful    0.2 % of the picture or more has a heavy tail; or the sum of squares of the whole picture lies in a few
//             hands (vov above 0.1: Estes & Cashwell 1978); or the brightest 0.01 % of the samples carry a tenth of the
//             light; or any sample was no radiance
// healthy     otherwise
//
// A tail is heavy if three things agree: khat is above its limit (measure/tail.h), vov is above 0.1, and khat is not so
// by chance. khat alone cries wolf where a tile has two kinds of pixels, such as the edge of a lamp before a wall,
// whose samples are bounded; their vov falls as 1/n. Of a tail with k = 0.7 vov stays near 0.29. Among a thousand
// tiles, khat is above 0.7 in some thirty by chance alone even if all of them have a k of 1/2: which ones count is
// decided so that one in ten of them is a false alarm in expectation (Benjamini & Hochberg 1995).
#pragma once
#include <functional>
#include <memory>
#include <string>
#include <string_view>
#include <vector>

#include "render/tail_statistics.h"

namespace etendue::render {

enum class Verdict { unknown, healthy, doubtful, unreliable };
std::string_view verdict_name(Verdict verdict);

struct TileReliability {
  film::Tail tail;
  bool heavy = false;
};

struct Reliability {
  Verdict verdict = Verdict::unknown;
  std::string reason;         // one sentence for people
  film::Tail tail;            // of all tiles together
  double heavy_share = 0;     // of the pixels, in tiles with a heavy tail
  uint64_t watched = 0;       // samples looked at; a rendering that goes on from a file starts from none
  int columns = 0, rows = 0;  // tiles of TailStatistics::kWidth x kHeight pixels, row by row from the top
  std::vector<TileReliability> tiles;
};

// `reports` are those of the tails, tile by tile; `rejected` are of so many samples. Nothing if `keep_going` cut it
// short: it is asked now and then.
std::shared_ptr<const Reliability> reliability_of(const TailStatistics& tails, const std::vector<film::Tail>& reports,
                                                  const film::InvalidSamples& rejected, uint64_t samples,
                                                  const std::function<bool()>& keep_going);

}  // namespace etendue::render
