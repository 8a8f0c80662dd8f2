// How near our pictures come to published ones, and those to each other.
#pragma once
#include <string>

namespace etendue::looks {

// Renders every file of which there are published pictures, `size` pixels on the larger side, at the exposure at which
// it is as bright as that of Cycles. Writes a sheet of ours beside Cycles' in tiles of `tile` pixels and prints a table
// of mean FLIP in Markdown. An exit code.
int make_fidelity(const std::string& data, const std::string& out, int tile, int size, uint32_t samples);

}  // namespace etendue::looks
