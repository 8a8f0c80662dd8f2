// A place where methods are known to fail, or just do not: a small scene or a sweep over one, what theory says each
// method does there, and a measured expectation. That a method fails is an expectation too.
#pragma once
#include <string>
#include <string_view>
#include <vector>

#include "stress/lab.h"

namespace etendue::stress {

enum class Kind {
  missing_paths,   // light paths that a method cannot sample
  heavy_tails,     // huge or infinite variance
  bias,            // means that are off, and those that must not be
  correlation,     // random numbers that know of each other
  parameters,      // the ends of their ranges
  geometry,        // huge, tiny, far away, degenerate
  broken_physics,  // models that make energy
  bad_numbers      // NaN and infinity
};
std::string_view kind_name(Kind kind);

struct Case {
  const char* name;  // as `etendue stress NAME` takes it
  Kind kind;
  const char* theory;  // one sentence: what should happen, and why
  void (*run)(Lab& lab);
};

// Every case, by kind.
const std::vector<Case>& cases();
const Case* find_case(std::string_view name);

}  // namespace etendue::stress
