// Reference images with a known error.
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
  std::string file;           // the file it was read from or is cached in; empty without one
  image::LayeredImage image;  // beauty and, if known, "variance": the squared standard error of each value
  std::optional<metrics::ReferenceNoise> noise;  // unknown for a file without a variance layer
  double mean_error = 0;                         // standard error of the mean over the image, radiance
  uint32_t samples = 0;                          // per pixel; 0 if unknown
  double seconds = 0;                            // total rendering time
  film::DisplayTransform display;                // of the measure `displayed`
  std::string integrator;                        // that rendered it; empty if it was read from a file
  int reduction = 1;                             // a pixel is the mean of reduction x reduction pixels of the file

  const std::vector<float>& rgb() const { return image.find("")->pixels; }
  double standard_error() const;  // root mean square over pixels and channels; NaN if unknown
};

// Sets `display` and the noise of the displayed values.
void set_display(Reference& reference, const film::DisplayTransform& display);

// Reads an image file, written by any renderer. A pixel that is not finite is an input error.
Result<Reference> read_reference(const std::string& file);

// The reference at this size. Where both sides of the file are the same multiple of it, blocks of pixels are averaged.
// Any other size is an input error.
Result<Reference> resized_reference(Reference reference, int width, int height);

// Renders and caches the reference of a document's image: an unbiased integrator with Sobol' points and a seed of its own.
// Without a readable or writable cache the reference is rendered again each time; an empty path disables the cache.
class ReferenceStore {
 public:
  ReferenceStore(const render::Document& base, const std::filesystem::path& cache,
                 const std::string& integrator = "path");

  const render::Document& document() const { return document_; }  // without limits
  // The cached state, which can be continued; an empty film if there is none.
  render::Checkpoint load() const;
  void save(film::Film film, double seconds) const;
  Reference reference_of(const film::Film& film, double seconds) const;

 private:
  render::Document document_;
  std::filesystem::path file_;
};

// When a reference is good enough: as soon as one limit is reached; zero is no limit.
struct ReferenceBudget {
  double seconds = 0;
  uint32_t samples = 0;
};

// Continues the cached reference up to the budget, unless it is already within it, and saves it. If `progress` returns
// false, the reference is what has been rendered so far.
Reference render_reference(render::Session& session, const render::Document& base, const ReferenceBudget& budget,
                           const std::filesystem::path& cache, const Progress& progress,
                           const std::string& integrator = "path");

}  // namespace etendue::bench
