// FLIP between renderings and published images, and between published images.
#pragma once
#include <map>
#include <optional>
#include <string>

#include "integration/looks/assets.h"
#include "integration/looks/sheet.h"

namespace etendue::looks {

// A rendering of a view and the published images of it, all of the same size.
struct BesidePublished {
  Picture ours;                             // at the exposure that matches the brightness of Cycles
  std::map<std::string, Picture> pictures;  // by renderer

  const Picture& cycles() const { return pictures.at("blender-cycles"); }
};
// Nothing if Cycles is not among the published images. `size`: pixels of the longer side. The file must open.
// `setting` is "NAME=VALUE" for all materials, or empty.
std::optional<BesidePublished> beside_published(const View& view, int size, uint32_t samples,
                                                const std::string& setting = {});
// Mean FLIP between two images.
double flip(const Picture& a, const Picture& b);

// Renders every file with published images, with `size` pixels on the longer side, at the exposure that matches the
// brightness of the Cycles image. Writes a contact sheet of both in tiles of `tile` pixels and prints a Markdown table
// of mean FLIP. `setting` is that of beside_published. Returns an exit code.
int make_fidelity(const std::string& data, const std::string& out, int tile, int size, uint32_t samples,
                  const std::string& setting);

}  // namespace etendue::looks
