// What errors are measured against: a picture whose own error is known.
#pragma once
#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "bench/progress.h"
#include "film/film.h"
#include "image/image.h"
#include "metrics/convergence.h"
#include "render/checkpoint.h"
#include "render/document.h"

namespace etendue::bench {

struct Reference {
  std::string file;             // where it came from or is kept; empty if nowhere
  image::LayeredImage picture;  // beauty and, if it is known, "variance": the squared standard error of each number
  std::optional<metrics::ReferenceNoise> noise;  // unknown for a file without a layer of variance
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

// How the reference of a document's picture is made, by path tracing with Sobol points and a seed of its own, and where
// it is kept. A cache that cannot be read or written costs time only; an empty path is no cache.
class ReferenceStore {
 public:
  ReferenceStore(const render::Document& base, const std::filesystem::path& cache);

  const render::Document& document() const { return document_; }  // without limits
  // What an earlier run left there, to go on from; an empty film if there is nothing.
  render::Checkpoint take_up() const;
  void keep(film::Film film, double seconds) const;
  Reference reference_of(const film::Film& film, double seconds) const;

 private:
  render::Document document_;
  std::filesystem::path file_;
};

// How much of a reference is wanted: whichever comes first; zero is no limit.
struct Effort {
  double seconds = 0;
  uint32_t samples = 0;
};

// Takes up what an earlier run left in the cache and extends it, if it is not enough; the result is kept there. `watch`
// may cut it short: what there is then is the reference.
Reference made_reference(render::Session& session, const render::Document& base, const Effort& effort,
                         const std::filesystem::path& cache, const Progress& watch);

// $XDG_CACHE_HOME/etendue or ~/.cache/etendue; empty where neither is known.
std::filesystem::path cache_folder();

}  // namespace etendue::bench
