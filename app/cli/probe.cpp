// etendue probe: luminance, illuminance and flux at a point of the image, also in watts.
#include <cstdio>
#include <memory>
#include <optional>

#include "command.h"
#include "interrupt.h"
#include "json.h"
#include "light/light_type.h"
#include "render/light_meter.h"
#include "scene/compiled_scene.h"
#include "scene_options.h"
#include "spectrum/photometry.h"

namespace etendue::cli {
namespace {

struct ProbeArguments {
  SceneArguments scene;
  std::string efficacy = "equal-energy";
  std::vector<float> at, sensor;
  uint32_t samples = 1024;
  int threads = 0;
  bool json = false;
};

Result<Efficacy> efficacy_of(const std::string& name) {
  const auto& options = Options<Efficacy>::kOptions;
  std::string known;
  for (size_t i = 0; i < options.size(); ++i) {
    if (name == options[i].name) return static_cast<Efficacy>(i);
    known += (i ? ", " : "") + std::string(options[i].name);
  }
  return usage_error("--efficacy: '" + name + "' is unknown; give one of " + known);
}

json vector_json(const Vec3& v) { return {v.x, v.y, v.z}; }

json reading_json(const render::MeterReading& r, Efficacy efficacy) {
  const auto photometric = static_cast<double>(luminance(r.value));
  return {{"value", color_json(r.value)},
          {"standard_error", r.standard_error},
          {"photometric", photometric},
          {"radiometric", radiometric(photometric, efficacy)}};
}

constexpr LightQuantity kLuminousExitance{"Luminous exitance", "lm/m^2", "Radiant exitance", "W/m^2"};
constexpr LightQuantity kReceivedFlux{"Received flux", "lm", "Received power", "W"};

json lights_json(const render::MeterReadings& m, Efficacy efficacy) {
  json list = json::array();
  for (const render::LightIntensity& light : m.lights)
    list.push_back({{"name", light.name},
                    {"distance", light.distance},
                    {"intensity", reading_json({light.intensity, 0}, efficacy)}});
  return list;
}

json readings_json(const render::MeterReadings& m, Efficacy efficacy) {
  return {{"position", vector_json(m.point.position)},
          {"normal", vector_json(m.point.normal)},
          {"radiance", reading_json(m.radiance, efficacy)},
          {"irradiance", reading_json(m.irradiance, efficacy)},
          {"emitted_flux", reading_json({m.emitted_flux, 0}, efficacy)},
          {"emitted_exitance", reading_json({m.emitted_exitance, 0}, efficacy)},
          {"lights", lights_json(m, efficacy)},
          {"lumens_per_watt", lumens_per_watt(efficacy)},
          {"spp", m.samples}};
}

void print(const LightQuantity& quantity, const render::MeterReading& r, Efficacy efficacy) {
  const auto value = static_cast<double>(luminance(r.value));
  std::printf("%-18s %.5g ± %.2g %s   RGB %.5g %.5g %.5g\n", quantity.name, value, r.standard_error, quantity.unit,
              static_cast<double>(r.value.r), static_cast<double>(r.value.g), static_cast<double>(r.value.b));
  std::printf("%-18s %.5g ± %.2g %s\n", quantity.radiometric_name, radiometric(value, efficacy),
              radiometric(r.standard_error, efficacy), quantity.radiometric_unit);
}

void print_lights(const render::MeterReadings& m, Efficacy efficacy) {
  for (const render::LightIntensity& light : m.lights) {
    const auto candela = static_cast<double>(luminance(light.intensity));
    std::printf("%-18s %.5g cd (%.5g W/sr) towards the point, from %.4g m\n", light.name.c_str(), candela,
                radiometric(candela, efficacy), static_cast<double>(light.distance));
  }
}

int run_probe(const ProbeArguments& a) {
  const auto efficacy = efficacy_of(a.efficacy);
  if (!efficacy) return fail(efficacy.error());
  const auto document = open_document(a.scene);
  if (!document) return fail(document.error());
  const Vec2 raster = a.at.empty() ? 0.5f * Vec2(document->width, document->height) : Vec2(a.at[0], a.at[1]);
  if (!(raster.x >= 0 && raster.y >= 0 && raster.x <= static_cast<float>(document->width) &&
        raster.y <= static_cast<float>(document->height)))
    return fail(usage_error("--at: the point lies outside of the image, which has " + std::to_string(document->width) +
                            "x" + std::to_string(document->height) + " pixels"));
  const auto scene = scene::compile(document->scene, document->camera, nullptr);
  const auto point = render::meter_point_at(*document, *scene, raster);
  if (!point) return fail(usage_error("--at: there is no surface at this point; give a point on an object"));
  if (!a.sensor.empty() && !(a.sensor[0] > 0))
    return fail(usage_error("--sensor: the size has to be positive, in metres"));
  const std::atomic<bool>& interrupted = watch_interrupts();
  const render::MeterSettings settings{
      .samples = a.samples, .threads = a.threads, .sensor_size = a.sensor.empty() ? 0 : a.sensor[0]};
  render::MeterReadings readings;
  render::measure_light(*document, scene, *point, settings, [&](const render::MeterReadings& m) {
    readings = m;
    return !interrupted;
  });
  if (a.json) {
    json j = readings_json(readings, *efficacy);
    if (readings.received_flux) j["received_flux"] = reading_json(*readings.received_flux, *efficacy);
    std::printf("%s\n", j.dump(2).c_str());
  } else {
    print(kLuminance, readings.radiance, *efficacy);
    print(kIlluminance, readings.irradiance, *efficacy);
    if (!is_black(readings.emitted_flux)) print(kLuminousFlux, {readings.emitted_flux, 0}, *efficacy);
    if (!is_black(readings.emitted_exitance)) print(kLuminousExitance, {readings.emitted_exitance, 0}, *efficacy);
    if (readings.received_flux) print(kReceivedFlux, *readings.received_flux, *efficacy);
    print_lights(readings, *efficacy);
    std::printf("at %.4g lm/W (--efficacy)\n", lumens_per_watt(*efficacy));
  }
  return interrupted ? static_cast<int>(Fault::interrupted) : 0;
}

}  // namespace

Command probe_command() {
  const auto a = std::make_shared<ProbeArguments>();
  return {.name = "probe",
          .summary = "Measure luminance, illuminance and luminous flux at a point of the image",
          .options = {scene_option(a->scene.scene),
                      {.names = "--at",
                       .target = &a->at,
                       .doc = "X Y: point in the image, in pixels from the upper left corner; default: the centre",
                       .count = 2},
                      {.names = "--sensor",
                       .target = &a->sensor,
                       .doc = "Also the flux that a square of this size in metres receives at the point",
                       .count = 1},
                      {.names = "--size",
                       .target = &a->scene.size,
                       .doc = "Size of the image to which --at refers, WIDTHxHEIGHT"},
                      camera_option(a->scene.camera),
                      set_option(a->scene.settings),
                      environment_option(a->scene.environment),
                      {.names = "--spp",
                       .target = &a->samples,
                       .doc = "Samples per pixel, of 64 pixels that view the point (1024)",
                       .bounds = between(1, 1'000'000)},
                      {.names = "--efficacy",
                       .target = &a->efficacy,
                       .doc = "Luminous efficacy for the conversion from lumens to watts: equal-energy, standard, "
                              "daylight or maximal"},
                      threads_option(a->threads),
                      json_flag(a->json)},
          .run = [a] { return run_probe(*a); }};
}

}  // namespace etendue::cli
