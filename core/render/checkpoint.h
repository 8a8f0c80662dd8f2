// A rendering that goes on after kill -9: the film's exact sums and the state they belong to.
#pragma once
#include <filesystem>
#include <string>

#include "base/result.h"
#include "film/film.h"

namespace etendue::render {

struct Checkpoint {
  std::string state;  // state_json of the document
  film::Film film;
  double seconds = 0;  // spent so far
};

Result<void> write_checkpoint(const std::filesystem::path& path, const Checkpoint& checkpoint);
// A truncated, foreign or damaged file is an input error.
Result<Checkpoint> read_checkpoint(const std::filesystem::path& path);

}  // namespace etendue::render
