// Checkpoints: files from which a rendering continues to the same image bit for bit.
#pragma once
#include <filesystem>
#include <string>
#include <vector>

#include "base/result.h"
#include "film/film.h"
#include "film/tail_state.h"

namespace etendue::render {

struct Checkpoint {
  std::string state;  // state_json of the document
  film::Film film;
  double seconds = 0;                            // of rendering so far
  std::vector<std::byte> integrator_state = {};  // integrator::RenderState::state
  std::vector<film::TailState> tails = {};       // of the tiles (TailStatistics); empty if they are not known
};

// The name of the checkpoint that belongs to an image file: "out.exr.checkpoint".
std::string checkpoint_of_image(const std::string& image);

Result<void> write_checkpoint(const std::filesystem::path& path, const Checkpoint& checkpoint);

// Reads files of this version and of the three before. Version 4 has no statistics of tails, version 3 no rounding errors
// of the film either, and version 2 no integrator state. A truncated, foreign or damaged file is an input error.
Result<Checkpoint> read_checkpoint(const std::filesystem::path& path);

}  // namespace etendue::render
