// Opens a glTF file and renders it.
#pragma once
#include "integration/fuzz/target.h"

namespace etendue::fuzz {

// Loads the file. One of eight inputs is also compiled and rendered with 8 x 8 pixels and one sample, by an integrator
// that the input selects. A sample that is NaN, infinite or negative is a finding.
void open_and_render(Input input);

}  // namespace etendue::fuzz
