#include "trace/trace_json.h"

#include <cmath>
#include <nlohmann/json.hpp>

#include "film/film.h"
#include "trace/trace_names.h"

namespace etendue::trace {
namespace {

using nlohmann::json;
using transport::RecordedEmission;
using transport::RecordedLight;
using transport::RecordedScattering;
using transport::RecordedVertex;

json number(float value) { return std::isfinite(value) ? json(value) : json(); }
json vector(const Vec3& v) { return {number(v.x), number(v.y), number(v.z)}; }
json color(const Rgb& c) { return {number(c.r), number(c.g), number(c.b)}; }

// A density with its measure.
json density(float pdf, bool delta) {
  return {{"value", number(pdf)}, {"measure", delta ? "discrete" : "solid angle, 1/sr"}};
}

json emission_json(const RecordedEmission& e) {
  return {{"radiance", color(e.radiance)}, {"mis_weight", e.mis_weight}, {"contribution", color(e.contribution)}};
}

json light_json(const scene::CompiledScene& scene, const RecordedLight& light) {
  json j = {{"light", light_name(scene, light.sample)},
            {"direction", vector(light.sample.wi)},
            {"pdf", density(light.sample.pdf, light.sample.delta)},
            {"radiance", color(light.radiance)},
            {"bsdf_cos", color(light.f_cos)},
            {"bsdf_pdf", density(light.bsdf_pdf, false)},
            {"mis_weight", light.mis_weight},
            {"unoccluded_contribution", color(light.unoccluded)},
            {"shadow_ray", light.shadow_ray},
            {"occluded", light.occluded},
            {"contribution", color(light.contribution)}};
  if (light.sample.distance > 0) j["distance"] = number(light.sample.distance);
  return j;
}

json scattering_json(const RecordedScattering& s) {
  if (s.end == transport::PathEnd::absorbed) return {{"end", end_reason(s)}};
  json j = {{"type", scattering_name(s.sample)},
            {"direction", vector(s.sample.wi)},
            {"pdf", s.sample.delta ? json{{"measure", "delta"}} : density(s.sample.pdf_solid_angle, false)},
            {"weight", color(s.sample.weight)},
            {"relative_ior", s.sample.eta}};
  if (s.roulette) j["roulette"] = {{"survival_probability", s.roulette->survival}, {"random", s.roulette->random}};
  if (s.end == transport::PathEnd::none)
    j["throughput"] = color(s.throughput);
  else
    j["end"] = end_reason(s);
  return j;
}

void add_surface(const scene::CompiledScene& scene, const RecordedVertex& v, json& j) {
  const scene::SurfacePoint& p = v.point;
  j["node"] = node_name(scene, p.instance->node);
  j["material"] = material_name(scene, p);
  j["triangle"] = p.triangle;
  j["position"] = vector(p.position);
  j["distance"] = number(glm::distance(v.origin, p.position));
  j["normal"] = vector(p.ng);
  j["shading_normal"] = vector(p.shading.z);
  j["front"] = p.front;
  j["lobes"] = lobe_names(v);
  if (p.inside || p.outside)
    j["media"] = {{"inside", medium_name(scene, p.inside)}, {"outside", medium_name(scene, p.outside)}};
}

json vertex_json(const scene::CompiledScene& scene, const RecordedVertex& v) {
  json j = {{"parent", v.parent},
            {"bsdf_sample", v.scattering},
            {"length", v.length},
            {"wo", vector(v.wo)},
            {"throughput", color(v.throughput)},
            {"escaped", v.escaped},
            {"light_samples", json::array()},
            {"bsdf_samples", json::array()}};
  if (!v.escaped) add_surface(scene, v, j);
  if (v.emission) j["emission"] = emission_json(*v.emission);
  for (const RecordedLight& light : v.lights) j["light_samples"].push_back(light_json(scene, light));
  for (const RecordedScattering& s : v.scattering_samples) j["bsdf_samples"].push_back(scattering_json(s));
  return j;
}

}  // namespace

json to_json(const render::PixelTrace& trace) {
  const transport::PathRecord& record = trace.record;
  json j = {{"integrator", trace.integrator},
            {"pixel", {trace.pixel.x, trace.pixel.y}},
            {"sample", trace.sample},
            {"half_buffer", trace.sample % film::kHalfBuffers},
            {"raster", {record.raster.x, record.raster.y}},
            {"time", record.time},
            {"camera_ray",
             {{"origin", vector(record.camera_ray.origin)}, {"direction", vector(record.camera_ray.direction)}}},
            {"vertices", json::array()},
            {"radiance", color(record.radiance)},
            {"film_sample", color(trace.radiance)}};
  if (record.lens) j["lens"] = {record.lens->x, record.lens->y};
  for (const RecordedVertex& v : record.vertices) j["vertices"].push_back(vertex_json(*trace.scene, v));
  return j;
}

}  // namespace etendue::trace
