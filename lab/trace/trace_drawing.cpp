#include "trace/trace_drawing.h"

#include "base/base64.h"
#include "camera/segment_projection.h"
#include "integrator/integrator_info.h"
#include "trace/trace_text.h"

namespace etendue::trace {
namespace {

using Kind = PathSegment::Kind;
using transport::RecordedLight;
using transport::RecordedVertex;

std::string label_of_integrator(const render::PixelTrace& trace) {
  const auto* info = integrator::find_integrator(trace.integrator);
  return info ? info->label : trace.integrator;
}

metrics::Point point(const Vec2& p) { return {double{p.x}, double{p.y}}; }

}  // namespace

std::vector<PathSegment> path_segments(const transport::PathRecord& record, float far) {
  std::vector<PathSegment> segments;
  for (const RecordedVertex& v : record.vertices) {
    const Vec3 end = v.escaped ? v.origin - far * v.wo : v.point.position;
    segments.push_back({v.escaped ? Kind::escaped : Kind::path, v.origin, end, v.parent});
  }
  for (size_t i = 0; i < record.vertices.size(); ++i) {
    const RecordedVertex& v = record.vertices[i];
    for (const RecordedLight& light : v.lights) {
      const float distance = light.sample.distance;
      const float length = distance > 0 && std::isfinite(distance) ? distance : far;
      segments.push_back({light.occluded ? Kind::occluded : Kind::shadow_ray, v.point.position,
                          v.point.position + length * light.sample.wi, static_cast<int>(i)});
    }
  }
  return segments;
}

float far_length(const scene::CompiledScene& scene) {
  const Bounds& bounds = scene.bounds();
  return bounds.empty() ? 1.0f : 0.25f * glm::distance(bounds.min, bounds.max);
}

metrics::Color color_of(Kind kind) {
  switch (kind) {
    case Kind::path:
      return {230, 159, 0};
    case Kind::shadow_ray:
      return {86, 180, 233};
    case Kind::occluded:
      return {213, 94, 0};
    case Kind::escaped:
      break;
  }
  return {204, 121, 167};
}

metrics::Drawing path_drawing(const render::PixelTrace& trace, const Camera& camera, Vec2i image_size) {
  metrics::Drawing drawing{.width = image_size.x, .height = image_size.y, .title = {}, .shapes = {}};
  drawing.title = "Paths of pixel " + std::to_string(trace.pixel.x) + "," + std::to_string(trace.pixel.y) +
                  ", sample " + std::to_string(trace.sample) + ", " + label_of_integrator(trace);
  const double width = std::max(1.0, 0.002 * std::max(image_size.x, image_size.y));
  for (const PathSegment& s : path_segments(trace.record, far_length(*trace.scene)))
    if (const auto ends = project_segment(camera, image_size, s.from, s.to))
      drawing.shapes.push_back(metrics::Polyline{.points = {point((*ends)[0]), point((*ends)[1])},
                                                 .color = color_of(s.kind),
                                                 .width = s.kind == Kind::path ? 1.5 * width : width,
                                                 .dashed = is_dashed(s.kind)});
  for (const TraceRow& row : trace_rows(trace)) {
    if (!row.event.starts_with("vertex")) continue;
    const RecordedVertex& v = trace.record.vertices[static_cast<size_t>(row.vertex)];
    if (v.escaped) continue;
    const auto ends = project_segment(camera, image_size, v.point.position, v.point.position);
    if (!ends) continue;
    drawing.shapes.push_back(metrics::Dot{.at = point((*ends)[0]),
                                          .radius = 2 * width,
                                          .color = color_of(Kind::path),
                                          .tooltip = row.event + ": " + row.details});
  }
  return drawing;
}

std::string path_figure(const render::PixelTrace& trace, const Camera& camera, Vec2i image_size,
                        std::span<const std::byte> png) {
  std::string svg = metrics::to_svg(path_drawing(trace, camera, image_size));
  if (png.empty()) return svg;
  // Over the background, the first element.
  return svg.insert(svg.find("/>") + 2, "\n<image width=\"" + std::to_string(image_size.x) + "\" height=\"" +
                                            std::to_string(image_size.y) + "\" href=\"data:image/png;base64," +
                                            base64(png) + "\"/>\n");
}

}  // namespace etendue::trace
