// The same image by another integrator.
#pragma once
#include <string>

#include "render/document.h"

namespace etendue::render {

// The document with an integrator of the registry. If both integrators have a parameter "max-depth", the new one has the same
// limit on the path depth. Adaptive sampling is off if the integrator does not support it.
Document with_integrator(const Document& document, const std::string& integrator);

}  // namespace etendue::render
