// What errors are measured against: a picture whose own error is known.
#pragma once
#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "bench/watch.h"
#include "image/image.h"
#include "measure/convergence.h"
#include "render/document.h"

namespace etendue::bench {

struct Reference {
  std::string file;             // where it came from or is kept; empty if nowhere
  image::LayeredImage picture;  // beauty and, if it is known, "variance": the squared standard error of each number
  std::optional<measure::ReferenceNoise> noise;  // unknown for a file without a layer of variance
  double mean_error = 0;                         // the standard error of the mean over the image, radiance
  uint32_t samples = 0;                          // per pixel; 0 if unknown
  double seconds = 0;                            // of rendering, all times that it was extended
  int reduced = 1;                               // a pixel is the mean of so many by so many of the file

  const std::vector<float>& rgb() const { return picture.find("")->pixels; }
  double standard_error() const;  // root of the mean square over pixels and channels; NaN if unknown
};

// A picture file, of any renderer; a pixel that is not finite is an input error.
Result<Reference> read_reference(const std::string& file);

// The reference at this size: as it is, or, where both its sides are the same multiple of it, the mean of each block of
// pixels. Anything else is an input error.
Result<Reference> fitted(Reference reference, int width, int height);

// How much of a reference is wanted: whichever comes first; zero is no limit.
struct Effort {
  double seconds = 0;
  uint32_t samples = 0;
};

// Renders the document's picture by path tracing with Sobol points and a seed of its own. What an earlier run left in
// the cache is taken up and extended, if it is not enough; the result is kept there. A cache that cannot be read or
// written costs time only. `watch` may cut it short: what there is then is the reference.
Reference made_reference(render::Session& session, const render::Document& base, const Effort& effort,
                         const std::filesystem::path& cache, const Watch& watch);

// $XDG_CACHE_HOME/etendue or ~/.cache/etendue; empty where neither is known.
std::filesystem::path cache_folder();

}  // namespace etendue::bench
