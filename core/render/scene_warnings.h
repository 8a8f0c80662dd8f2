// Warnings about the scene of a document.
#pragma once
#include <string>
#include <vector>

#include "render/document.h"

namespace etendue::render {

// The warnings of the scene, without that about the studio environment if another one has replaced it, and with a
// warning about environment portals that the integrator ignores.
std::vector<std::string> current_warnings(const Document& document);

}  // namespace etendue::render
