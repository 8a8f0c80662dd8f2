#include "trace/trace_text.h"

#include <cmath>

#include "base/number_text.h"
#include "film/film.h"
#include "trace/trace_names.h"

namespace etendue::trace {
namespace {

using transport::RecordedLight;
using transport::RecordedScattering;
using transport::RecordedVertex;

// Negative zero is shown without its sign.
std::string number(float value) { return format_number(static_cast<double>(value + 0.0f), 4); }
std::string vector(const Vec3& v) { return "(" + number(v.x) + ", " + number(v.y) + ", " + number(v.z) + ")"; }
std::string color(const Rgb& c) { return number(c.r) + " " + number(c.g) + " " + number(c.b); }
std::string density(float pdf) { return number(pdf) + "/sr"; }

std::string lobes(const RecordedVertex& v) {
  std::string text;
  for (const std::string& name : lobe_names(v)) text += (text.empty() ? "" : ", ") + name;
  return text.empty() ? "no lobes" : text;
}

std::string surface_details(const scene::CompiledScene& scene, const RecordedVertex& v) {
  const scene::SurfacePoint& p = v.point;
  std::string text =
      place_name(scene, p) + ", " + material_name(scene, p) + " (" + lobes(v) + "), position " + vector(p.position);
  if (!p.in_volume) text += ", normal " + vector(p.shading.z);
  text += ", distance " + number(glm::distance(v.origin, p.position)) + " m, throughput " + color(v.throughput);
  if (p.in_volume) return text;
  if (!p.front) text += ", back side";
  if (p.inside || p.outside)
    text += ", between " + medium_name(scene, p.inside) + " and " + medium_name(scene, p.outside);
  return text;
}

TraceRow vertex_row(const scene::CompiledScene& scene, const RecordedVertex& v, int index) {
  TraceRow row;
  row.vertex = index;
  row.event = "vertex " + std::to_string(index + 1);
  if (v.parent >= 0 && v.parent != index - 1) row.event += ", from vertex " + std::to_string(v.parent + 1);
  row.details = v.escaped ? "leaves the scene in direction " + vector(-v.wo) + ", throughput " + color(v.throughput)
                          : surface_details(scene, v);
  return row;
}

TraceRow light_row(const scene::CompiledScene& scene, const RecordedLight& light, int vertex) {
  TraceRow row{.vertex = vertex, .event = "light sample"};
  row.details = light_name(scene, light.sample) + ", direction " + vector(light.sample.wi);
  if (light.sample.distance > 0 && std::isfinite(light.sample.distance))
    row.details += ", distance " + number(light.sample.distance) + " m";
  row.details +=
      ", radiance " + color(light.radiance) + ", f cos " + color(light.f_cos) + ", BSDF pdf " + density(light.bsdf_pdf);
  if (light.occluded) row.details += ", occluded";
  if (!light.shadow_ray) row.details += ", without a shadow ray";
  row.pdf = light.sample.delta ? number(light.sample.pdf) : density(light.sample.pdf);
  row.mis_weight = number(light.mis_weight);
  row.contribution = color(light.contribution);
  row.rejected = light.occluded;
  return row;
}

TraceRow scattering_row(const RecordedScattering& s, int vertex) {
  TraceRow row{.vertex = vertex, .event = "BSDF sample"};
  row.rejected = s.end != transport::PathEnd::none;
  if (s.end == transport::PathEnd::absorbed) {
    row.details = end_reason(s);
    return row;
  }
  row.details = scattering_name(s.sample) + ", direction " + vector(s.sample.wi) + ", weight " + color(s.sample.weight);
  if (s.sample.eta != 1) row.details += ", relative index " + number(s.sample.eta);
  if (s.roulette)
    row.details +=
        ", survival probability " + number(s.roulette->survival) + ", random number " + number(s.roulette->random);
  row.details += row.rejected ? ", " + end_reason(s) : ", throughput " + color(s.throughput);
  row.pdf = s.sample.delta ? "delta" : density(s.sample.pdf_solid_angle);
  return row;
}

void add_vertex_rows(const scene::CompiledScene& scene, const RecordedVertex& v, int index,
                     std::vector<TraceRow>& rows) {
  rows.push_back(vertex_row(scene, v, index));
  if (v.medium_emission)
    rows.push_back({.vertex = index,
                    .event = "emission of media",
                    .details = "radiance " + color(v.medium_emission->radiance),
                    .mis_weight = number(v.medium_emission->mis_weight),
                    .contribution = color(v.medium_emission->contribution)});
  if (v.emission)
    rows.push_back({.vertex = index,
                    .event = v.escaped ? "environment" : "emission",
                    .details = "radiance " + color(v.emission->radiance),
                    .mis_weight = number(v.emission->mis_weight),
                    .contribution = color(v.emission->contribution)});
  for (const RecordedLight& light : v.lights) rows.push_back(light_row(scene, light, index));
  for (const RecordedScattering& s : v.scattering_samples) rows.push_back(scattering_row(s, index));
  if (!v.escaped && v.scattering_samples.empty())
    rows.push_back({.vertex = index, .event = "end", .details = kNoScattering, .rejected = true});
}

}  // namespace

std::vector<TraceRow> trace_rows(const render::PixelTrace& trace) {
  const transport::PathRecord& record = trace.record;
  TraceRow camera{.vertex = -1, .event = "camera"};
  camera.details = "position in the image (" + number(record.raster.x) + ", " + number(record.raster.y) + "), origin " +
                   vector(record.camera_ray.origin) + ", direction " + vector(record.camera_ray.direction);
  if (record.lens) camera.details += ", lens " + number(record.lens->x) + " " + number(record.lens->y);
  if (record.time != 0) camera.details += ", time " + number(record.time);
  std::vector<TraceRow> rows{camera};
  for (size_t i = 0; i < record.vertices.size(); ++i)
    add_vertex_rows(*trace.scene, record.vertices[i], static_cast<int>(i), rows);
  return rows;
}

std::string to_text(const render::PixelTrace& trace) {
  std::string text = format_text("%s, pixel %d,%d, sample %u (half-buffer %u)\n", trace.integrator.c_str(),
                                 trace.pixel.x, trace.pixel.y, trace.sample, trace.sample % film::kHalfBuffers);
  for (const TraceRow& row : trace_rows(trace)) {
    const bool heads = row.event.starts_with("vertex") || row.vertex < 0;
    text += (heads ? "\n" : "    ") + row.event + ": " + row.details;
    if (!row.pdf.empty()) text += ", pdf " + row.pdf;
    if (!row.mis_weight.empty()) text += ", MIS weight " + row.mis_weight;
    if (!row.contribution.empty()) text += "; adds " + row.contribution;
    text += '\n';
  }
  const bool equal = trace.record.radiance == trace.radiance;
  return text + "\nsum of the contributions: " + color(trace.record.radiance) + " cd/m^2, " +
         (equal ? "equal to" : "different from") + " the sample of the film\n";
}

}  // namespace etendue::trace
