// FLIP between renderings and published images, and between published images.
#pragma once
#include <string>

namespace etendue::looks {

// Renders every file with published images, with `size` pixels on the longer side, at the exposure that matches the
// brightness of the Cycles image. Writes a contact sheet of both in tiles of `tile` pixels and prints a Markdown table
// of mean FLIP. Returns an exit code.
int make_fidelity(const std::string& data, const std::string& out, int tile, int size, uint32_t samples);

}  // namespace etendue::looks
