// etendue probe: light meters at a point of the picture.
#include <CLI/CLI.hpp>
#include <cstdio>
#include <memory>
#include <nlohmann/json.hpp>

#include "command.h"
#include "interrupt.h"
#include "render/light_meter.h"
#include "scene/compiled_scene.h"
#include "settings.h"
#include "spectrum/photometry.h"

namespace etendue::cli {
namespace {

using nlohmann::json;

struct Options {
  std::string scene, camera, size, env, efficacy = "equal-energy";
  std::vector<std::string> sets;
  std::vector<float> at;
  uint32_t samples = 1024;
  int threads = 0;
  bool json = false;
};

Result<Efficacy> efficacy_of(const std::string& name) {
  const auto& options = etendue::Options<Efficacy>::kOptions;
  std::string known;
  for (size_t i = 0; i < options.size(); ++i) {
    if (name == options[i].name) return static_cast<Efficacy>(i);
    known += (i ? ", " : "") + std::string(options[i].name);
  }
  return usage_error("--efficacy: there is no '" + name + "'; it is one of " + known);
}

Result<render::Document> document_of(const Options& o) {
  auto d = render::new_document(o.scene, o.camera);
  if (!d) return d.error();
  if (auto r = set_size(*d, o.size); !r) return r.error();
  if (auto r = set_environment(*d, o.env); !r) return r.error();
  if (auto r = set_all(*d, o.sets); !r) return r.error();
  return d;
}

json vector_json(const Vec3& v) { return {v.x, v.y, v.z}; }

json reading_json(const render::MeterReading& r, Efficacy efficacy) {
  return {{"value", {r.value.r, r.value.g, r.value.b}},
          {"standard_error", r.standard_error},
          {"photometric", photometric(r.value, efficacy)}};
}

json readings_json(const render::MeterReadings& m, Efficacy efficacy) {
  return {{"position", vector_json(m.spot.position)},
          {"normal", vector_json(m.spot.normal)},
          {"radiance", reading_json(m.radiance, efficacy)},
          {"irradiance", reading_json(m.irradiance, efficacy)},
          {"emitted_flux", reading_json({m.emitted_flux, 0}, efficacy)},
          {"lumens_per_watt", lumens_per_watt(efficacy)},
          {"spp", m.samples}};
}

void print(const char* label, const render::MeterReading& r, const char* unit, const char* photometric_unit,
           Efficacy efficacy) {
  std::printf("%-14s %.5g %.5g %.5g %s +- %.2g   %.5g %s\n", label, static_cast<double>(r.value.r),
              static_cast<double>(r.value.g), static_cast<double>(r.value.b), unit, r.standard_error,
              photometric(r.value, efficacy), photometric_unit);
}

int run(const Options& o) {
  const auto efficacy = efficacy_of(o.efficacy);
  if (!efficacy) return fail(efficacy.error());
  const auto document = document_of(o);
  if (!document) return fail(document.error());
  const Vec2 raster = o.at.empty() ? 0.5f * Vec2(document->width, document->height) : Vec2(o.at[0], o.at[1]);
  if (!(raster.x >= 0 && raster.y >= 0 && raster.x <= static_cast<float>(document->width) &&
        raster.y <= static_cast<float>(document->height)))
    return fail(usage_error("--at lies outside of the picture, which is " + std::to_string(document->width) + "x" +
                            std::to_string(document->height)));
  const auto scene = scene::compile(document->scene, document->camera, nullptr);
  const auto spot = render::meter_point_at(*document, *scene, raster);
  if (!spot) return fail(usage_error("--at: the camera sees nothing there but the sky"));
  const std::atomic<bool>& interrupted = watch_interrupts();
  render::MeterReadings readings;
  render::measure_light(*document, scene, *spot, o.samples, o.threads, [&](const render::MeterReadings& m) {
    readings = m;
    return !interrupted;
  });
  if (o.json) {
    std::printf("%s\n", readings_json(readings, *efficacy).dump(2).c_str());
  } else {
    print("radiance", readings.radiance, "W/(m^2 sr)", "cd/m^2", *efficacy);
    print("irradiance", readings.irradiance, "W/m^2", "lx", *efficacy);
    if (!is_black(readings.emitted_flux)) print("emitted flux", {readings.emitted_flux, 0}, "W", "lm", *efficacy);
  }
  return interrupted ? static_cast<int>(Fault::interrupted) : 0;
}

}  // namespace

Command add_probe(CLI::App& app) {
  auto o = std::make_shared<Options>();
  app.add_option("scene", o->scene, "A .gltf or .glb file, or the name of a built-in scene")->required();
  app.add_option("--at", o->at,
                 "X Y: the place in the picture, pixels from the upper left corner; its middle if left out")
      ->expected(2);
  app.add_option("--size", o->size, "WIDTHxHEIGHT of the picture that --at is of");
  app.add_option("--camera", o->camera, "A camera of the scene by name or index");
  app.add_option("--set", o->sets, "NAME=VALUE: any setting by name; repeatable")->take_all();
  app.add_option("--env", o->env, "Environment map, .hdr or .exr");
  app.add_option("--spp", o->samples, "Samples of each of 64 pixels that look at the spot")
      ->check(CLI::Range(1u, 1000000u));
  app.add_option("--efficacy", o->efficacy, "How many lumens a watt has: equal-energy, standard, daylight or maximal");
  app.add_option("--threads", o->threads, "0: one per hardware thread")->check(CLI::Range(0, 1024));
  app.add_flag("--json", o->json, "Print JSON");
  return [o] { return run(*o); };
}

}  // namespace etendue::cli
