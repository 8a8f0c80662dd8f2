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

json number_json(float value) { return std::isfinite(value) ? json(value) : json(); }
json vector_json(const Vec3& v) { return {number_json(v.x), number_json(v.y), number_json(v.z)}; }
json color_json(const Rgb& c) { return {number_json(c.r), number_json(c.g), number_json(c.b)}; }

// A density with its measure.
json density_json(float pdf, bool delta) {
  return {{"value", number_json(pdf)}, {"measure", delta ? "discrete" : "solid angle, 1/sr"}};
}

json emission_json(const RecordedEmission& e) {
  return {
      {"radiance", color_json(e.radiance)}, {"mis_weight", e.mis_weight}, {"contribution", color_json(e.contribution)}};
}

json light_json(const scene::CompiledScene& scene, const RecordedLight& light) {
  json j = {{"light", light_name(scene, light.sample)},
            {"direction", vector_json(light.sample.wi)},
            {"pdf", density_json(light.sample.pdf, light.sample.delta)},
            {"radiance", color_json(light.radiance)},
            {"bsdf_cos", color_json(light.f_cos)},
            {"bsdf_pdf", density_json(light.bsdf_pdf, false)},
            {"mis_weight", light.mis_weight},
            {"unoccluded_contribution", color_json(light.unoccluded)},
            {"shadow_ray", light.shadow_ray},
            {"occluded", light.occluded},
            {"contribution", color_json(light.contribution)}};
  if (light.sample.distance > 0) j["distance"] = number_json(light.sample.distance);
  return j;
}

json scattering_json(const RecordedScattering& s) {
  if (s.end == transport::PathEnd::absorbed) return {{"end", end_reason(s)}};
  json j = {{"type", scattering_name(s.sample)},
            {"direction", vector_json(s.sample.wi)},
            {"pdf", s.sample.delta ? json{{"measure", "delta"}} : density_json(s.sample.pdf_solid_angle, false)},
            {"weight", color_json(s.sample.weight)},
            {"relative_ior", s.sample.eta}};
  if (s.roulette) j["roulette"] = {{"survival_probability", s.roulette->survival}, {"random", s.roulette->random}};
  if (s.end == transport::PathEnd::none)
    j["throughput"] = color_json(s.throughput);
  else
    j["end"] = end_reason(s);
  return j;
}

void add_surface(const scene::CompiledScene& scene, const RecordedVertex& v, json& j) {
  const scene::SurfacePoint& p = v.point;
  j["node"] = place_name(scene, p);
  j["material"] = material_name(scene, p);
  j["triangle"] = p.triangle;
  j["position"] = vector_json(p.position);
  j["distance"] = number_json(glm::distance(v.origin, p.position));
  j["normal"] = vector_json(p.ng);
  j["shading_normal"] = vector_json(p.shading.z);
  j["front"] = p.front;
  j["lobes"] = lobe_names(v);
  if (p.in_volume) j["in_volume"] = true;
  if (p.inside || p.outside)
    j["media"] = {{"inside", medium_name(scene, p.inside)}, {"outside", medium_name(scene, p.outside)}};
}

json vertex_json(const scene::CompiledScene& scene, const RecordedVertex& v) {
  json j = {{"parent", v.parent},
            {"bsdf_sample", v.scattering},
            {"length", v.length},
            {"wo", vector_json(v.wo)},
            {"throughput", color_json(v.throughput)},
            {"escaped", v.escaped},
            {"light_samples", json::array()},
            {"bsdf_samples", json::array()}};
  if (!v.escaped) add_surface(scene, v, j);
  if (v.medium_emission) j["medium_emission"] = emission_json(*v.medium_emission);
  if (v.emission) j["emission"] = emission_json(*v.emission);
  for (const RecordedLight& light : v.lights) j["light_samples"].push_back(light_json(scene, light));
  for (const RecordedScattering& s : v.scattering_samples) j["bsdf_samples"].push_back(scattering_json(s));
  return j;
}

}  // namespace

json to_json(const render::PixelTrace& trace) {
  const transport::PathRecord& record = trace.record;
  json j = {
      {"integrator", trace.integrator},
      {"pixel", {trace.pixel.x, trace.pixel.y}},
      {"sample", trace.sample},
      {"half_buffer", trace.sample % film::kHalfBuffers},
      {"raster", {record.raster.x, record.raster.y}},
      {"time", record.time},
      {"camera_ray",
       {{"origin", vector_json(record.camera_ray.origin)}, {"direction", vector_json(record.camera_ray.direction)}}},
      {"vertices", json::array()},
      {"radiance", color_json(record.radiance)},
      {"film_sample", color_json(trace.radiance)}};
  if (record.lens) j["lens"] = {record.lens->x, record.lens->y};
  for (const RecordedVertex& v : record.vertices) j["vertices"].push_back(vertex_json(*trace.scene, v));
  return j;
}

}  // namespace etendue::trace
