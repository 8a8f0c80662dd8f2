// Which documents can be rendered in parts (render_part.h) that merge to the bits of one run.
#pragma once
#include <string>

#include "render/document.h"

namespace etendue::render {

// Why the document does not divide into the part that it names, with a remedy; empty if it does.
std::string division_incompatibility(const Document& document);

}  // namespace etendue::render
