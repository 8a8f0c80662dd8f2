// Partial results: .exr files with the samples of a part of a rendering, from which `merge` makes the image.
//
// A file holds the mean of its samples as an image, for people, and for each half-buffer (A, B) the number of samples
// and their exact sums. A sum is split into floats, the largest first: the layers A.sum, A.sum1, A.sum2 and so on. Added
// in any order and grouping, they give the sums of one run. Attributes hold the settings, a hash of everything that
// determines the samples, the samples that the file contains, and the statistics of tails and of invalid samples.
#pragma once
#include <filesystem>
#include <string>
#include <vector>

#include "base/result.h"
#include "film/film.h"
#include "film/tail_state.h"
#include "image/image.h"
#include "render/sample_coverage.h"

namespace etendue::render {

struct PartInfo {
  std::string state;        // state_json of the document, without limits and part
  std::string version;      // of the program
  uint64_t scene_hash = 0;  // of the scene and all settings that determine the samples
  int width = 0, height = 0;
  std::vector<SampleBox> blocks = {};  // the samples of the file; they do not overlap
  uint64_t rays = 0, microseconds = 0;
  film::InvalidSamples invalid_samples = {};
  uint64_t hash = 0;  // of the content; set by `write_part`
};

// Why two parts are not parts of one rendering, as "render.seed is 1, not 2" for `part` and `other`; empty if they are.
std::string difference_of(const PartInfo& part, const PartInfo& other);

// Samples with the statistics of their tails (TailStatistics), one per tile.
struct PartialSamples {
  film::Film film;
  std::vector<film::TailState> tails;
};

// Replaces the file atomically.
Result<void> write_part(const std::filesystem::path& path, PartInfo info, const PartialSamples& samples);

// Reads everything except the samples.
Result<PartInfo> read_part_info(const std::filesystem::path& path);

// The samples of a file as they are stored.
struct LoadedPart {
  image::LayeredImage image;
  std::vector<film::TailState> tails;
};

// Reads the samples of a file. `info` is that of the file. A damaged or changed file is an input error.
Result<LoadedPart> load_part(const std::filesystem::path& path, const PartInfo& info);

// Adds samples; `info` is that of their file. The tails must have one element per tile.
void add_part(const LoadedPart& part, const PartInfo& info, PartialSamples& samples);

}  // namespace etendue::render
