// Renderings that are cut, written down and taken up again.
#pragma once
#include <string>

#include "support/scenes.h"

namespace etendue::test {

void expect_same_bits(const film::Film& a, const film::Film& b, const std::string& what);

// Nine samples of each pixel, cut after four of them, and somewhere in the middle of one: by way of a checkpoint both
// go on to the same bits.
void expect_same_bits_after_a_cut(render::Document document, const std::string& what);

}  // namespace etendue::test
