// The paths of a traced sample, projected to the image: camera paths, shadow rays and escaped rays.
//
// As an overlay of the picture, and as a vector graphic like the path figures of [Lang, ch. 1, 5, 8, 9].
#pragma once
#include <cstddef>
#include <span>
#include <string>
#include <vector>

#include "camera/camera.h"
#include "metrics/drawing.h"
#include "render/pixel_trace.h"

namespace etendue::trace {

struct PathSegment {
  enum class Kind { path, shadow_ray, occluded, escaped };
  Kind kind;
  Vec3 from{0}, to{0};
  int vertex;  // at which the segment starts; -1: the camera
};

// The segments of all paths. Rays that leave the scene have the length `far` metres.
std::vector<PathSegment> path_segments(const transport::PathRecord& record, float far);
// A length for rays that leave the scene: a quarter of the scene's diagonal.
float far_length(const scene::CompiledScene& scene);

metrics::Color color_of(PathSegment::Kind kind);
inline bool is_dashed(PathSegment::Kind kind) { return kind == PathSegment::Kind::occluded; }

// The segments, with dots at the vertices whose tooltips describe them.
metrics::Drawing path_drawing(const render::PixelTrace& trace, const Camera& camera, Vec2i image_size);

// The drawing as SVG over a picture of the same size, as a PNG file in memory; empty: no picture.
std::string path_figure(const render::PixelTrace& trace, const Camera& camera, Vec2i image_size,
                        std::span<const std::byte> png = {});

}  // namespace etendue::trace
