// Pictures of traced paths, and of the tree of points that a sample consists of.
#pragma once
#include <functional>

#include "figures/tools.h"
#include "render/pixel_trace.h"

namespace etendue::figures {

// Rates a sample of a pixel; that with the largest number is drawn.
using SampleRating = std::function<double(const transport::PathRecord&)>;
double vertex_count(const transport::PathRecord& record);

// The best of the first samples of the pixel at a position in the unit square, y downwards.
Result<render::PixelTrace> traced_sample(render::Document document, Vec2 position, Vec2i image_size,
                                         const MakeContext& context, const SampleRating& rating = vertex_count);

// Its paths, drawn over a faded picture of the scene. Several samples: the first ones of the pixel.
Result<Part> path_part(const std::string& caption, const render::Document& document, Vec2 position,
                       const MakeContext& context, const SampleRating& rating = vertex_count);
Result<Part> paths_part(const std::string& caption, const render::Document& document, Vec2 position, int samples,
                        const MakeContext& context);

// Its vertices as a tree: the camera at the top, a row for each number of segments. The areas of the dots are in
// proportion to the throughput, 1 at the camera; the strongest branch is drawn in bold if `marks_one` is set.
Result<Part> tree_part(const std::string& caption, const render::Document& document, Vec2 position,
                       const MakeContext& context, bool marks_one = false);

}  // namespace etendue::figures
