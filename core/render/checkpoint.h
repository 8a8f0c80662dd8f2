// A rendering that goes on after kill -9: the film's exact sums, the state they belong to, and that of the method.
#pragma once
#include <filesystem>
#include <string>
#include <vector>

#include "base/result.h"
#include "film/film.h"

namespace etendue::render {

struct Checkpoint {
  std::string state;  // state_json of the document
  film::Film film;
  double seconds = 0;                            // spent so far
  std::vector<std::byte> integrator_state = {};  // the state of the method's work (integrator::Work::state)
};

Result<void> write_checkpoint(const std::filesystem::path& path, const Checkpoint& checkpoint);
// Files of the version before, which knew no state of the method, are read too. A truncated, foreign or damaged file is
// an input error.
Result<Checkpoint> read_checkpoint(const std::filesystem::path& path);

}  // namespace etendue::render
