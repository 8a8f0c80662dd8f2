// Whether two documents have the same samples.
#pragma once
#include <string>

namespace etendue::render {
struct Document;
}

namespace etendue::cli {

// The first setting in which two documents of one scene differ and that changes what the samples are, as
// "render.seed is 1, not 2"; empty if there is none.
std::string sample_difference(const render::Document& a, const render::Document& b);

}  // namespace etendue::cli
