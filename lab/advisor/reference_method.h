// The method that others are measured by, and small pictures made by it.
#pragma once
#include "render/document.h"

namespace etendue::advisor {

// The document's picture (its scene, camera, size, filter and paths) by path tracing with Sobol points as it comes,
// without limits: unbiased, and of all paths that count.
render::Document trusted(const render::Document& document);

// The same picture, each side divided by `divisor`, but the smaller one no shorter than `least` pixels (nor longer than
// it is).
render::Document smaller(const render::Document& document, int divisor, int least);

}  // namespace etendue::advisor
