// Stability cases: small scenes, or sweeps over one parameter of a scene, for which theory predicts what each method
// does. Where theory predicts a failure, the failure is the expected result.
#pragma once
#include <string>
#include <string_view>
#include <vector>

#include "stress/test_context.h"

namespace etendue::stress {

enum class Kind {
  missing_paths,    // light paths that a method cannot sample
  heavy_tails,      // very large or infinite variance
  bias,             // means that deviate from the truth, and means that must not
  correlation,      // correlated random numbers
  parameters,       // limits of parameter ranges
  geometry,         // very large, small, distant or degenerate geometry
  broken_physics,   // models that do not conserve energy
  invalid_numbers,  // NaN and infinity
};
// The identifier of a kind in matrix.json.
std::string_view kind_name(Kind kind);
// The heading of a kind for readers.
std::string_view kind_label(Kind kind);

struct Case {
  const char* name;  // the argument of `etendue stress`
  Kind kind;
  const char* theory;  // one sentence without a full stop: the predicted behaviour and its reason
  void (*run)(TestContext& test);
};

// All cases, ordered by kind.
const std::vector<Case>& cases();
// Null if there is no such case.
const Case* find_case(std::string_view name);

}  // namespace etendue::stress
