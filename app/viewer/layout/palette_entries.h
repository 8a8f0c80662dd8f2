// What the command palette finds.
#pragma once
#include <vector>

#include "viewer/layout/command_palette.h"

namespace etendue::viewer {

// Enabled actions first, then the parameters of the document, of the panels and of the preferences, then the options of
// parameters that are choices.
std::vector<PaletteEntry> palette_entries(const AppState& state);

}  // namespace etendue::viewer
