// Whether the estimated error of an image can be trusted, judged from the tails of its samples' distribution per tile.
//
//   unknown     fewer than 8 samples per pixel in the statistics
//   unreliable  at least 5 % of the image has a heavy tail; or the image as a whole has one; or more than one sample in
//               a thousand is invalid
//   doubtful    at least 0.2 % of the image has a heavy tail; or few samples dominate the sum of squares of the whole
//               image (vov above 0.1) [Estes and Cashwell 1978]; or the brightest 0.01 % of the samples carry more than
//               a tenth of the light; or any sample is invalid
//   healthy     otherwise
//
// A tile has a heavy tail if three conditions hold: khat is above its limit (film/tail.h), vov is above 0.1, and the
// large khat is not due to chance. khat alone gives false alarms in tiles that contain two kinds of pixels, such as the
// edge of a light in front of a wall. The samples of such tiles are bounded and their vov falls as 1/n, whereas for a
// tail with k = 0.7 vov stays near 0.29. Among a thousand tiles with k = 1/2, khat exceeds 0.7 in about thirty by
// chance. The limit on the probability of chance is chosen so that one reported tile in ten is expected to be a false
// alarm [Benjamini and Hochberg 1995].
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
  std::string reason;                  // one sentence for users
  film::Tail tail;                     // of all tiles together
  double heavy_share = 0;              // fraction of the pixels that lie in tiles with a heavy tail
  uint64_t samples = 0;                // in the statistics; those of a resumed film are not among them
  int columns = 0, rows = 0;           // of tiles with TailStatistics::kWidth x kHeight pixels
  std::vector<TileReliability> tiles;  // row by row from the top
};

// `reports` are the fitted tails of the tiles. `invalid` are the invalid ones of `samples` samples of the film. Null if
// `keep_going`, which is called now and then, returned false.
std::shared_ptr<const Reliability> reliability_of(const TailStatistics& tails, const std::vector<film::Tail>& reports,
                                                  const film::InvalidSamples& invalid, uint64_t samples,
                                                  const std::function<bool()>& keep_going);

}  // namespace etendue::render
