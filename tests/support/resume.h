// Checks that a render resumed from a checkpoint continues to the same bits.
#pragma once
#include <string>

#include "support/scenes.h"

namespace etendue::test {

void expect_same_bits(const film::Film& a, const film::Film& b, const std::string& what);

// Renders nine samples per pixel and compares with two renders that are resumed from a checkpoint: one stopped after
// four samples, one saved in the middle of a sample. `has_state`: the integrator has state of its own besides the film.
void expect_same_bits_after_resume(render::Document document, const std::string& what, bool has_state = true);

}  // namespace etendue::test
