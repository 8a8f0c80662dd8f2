// etendue probe: luminance, illuminance and flux at a point of the image, also in watts.
#include <cstdio>
#include <memory>
#include <optional>

#include "base/json_text.h"
#include "command.h"
#include "interrupt.h"
#include "json.h"
#include "light/light_type.h"
#include "render/light_meter.h"
#include "scene/compiled_scene.h"
#include "scene_options.h"
#include "spectrum/photometry.h"
#include "transport/model.h"

namespace etendue::cli {
namespace {

struct ProbeArguments {
  SceneArguments scene;
  std::string efficacy = "equal-energy";
  std::vector<float> at, sensor;
  uint32_t samples = 1024;
  int threads = 0;
  bool spectrum = false;
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

// The luminous efficacies that convert a reading to watts, lm/W.
struct Efficacies {
  double radiance, irradiance;  // of measured spectra in spectral rendering
  double other;                 // the chosen one
};

json reading_json(const render::MeterReading& r, double lumens_per_watt) {
  const auto photometric = static_cast<double>(luminance(r.value));
  return {{"value", color_json(r.value)},
          {"standard_error", r.standard_error},
          {"photometric", photometric},
          {"radiometric", photometric / lumens_per_watt},
          {"lumens_per_watt", lumens_per_watt}};
}

constexpr LightQuantity kLuminousExitance{"Luminous exitance", "lm/m^2", "Radiant exitance", "W/m^2"};
constexpr LightQuantity kReceivedFlux{"Received flux", "lm", "Received power", "W"};

json lights_json(const render::MeterReadings& m, double lumens_per_watt) {
  json list = json::array();
  for (const render::LightIntensity& light : m.lights)
    list.push_back({{"name", light.name},
                    {"distance", light.distance},
                    {"intensity", reading_json({light.intensity, 0}, lumens_per_watt)}});
  return list;
}

json readings_json(const render::MeterReadings& m, const Efficacies& efficacies) {
  return {{"position", vector_json(m.point.position)},
          {"normal", vector_json(m.point.normal)},
          {"radiance", reading_json(m.radiance, efficacies.radiance)},
          {"irradiance", reading_json(m.irradiance, efficacies.irradiance)},
          {"emitted_flux", reading_json({m.emitted_flux, 0}, efficacies.other)},
          {"emitted_exitance", reading_json({m.emitted_exitance, 0}, efficacies.other)},
          {"lights", lights_json(m, efficacies.other)},
          {"lumens_per_watt", efficacies.other},
          {"spp", m.samples}};
}

json spectrum_json(const render::MeasuredSpectrum& spectrum) {
  json list = json::array();
  for (size_t i = 0; i < render::MeasuredSpectrum::kBins; ++i)
    list.push_back({{"wavelength", render::MeasuredSpectrum::wavelength(i)},
                    {"radiance", spectrum.radiance[i]},
                    {"standard_error", spectrum.standard_error[i]}});
  return {{"luminance", spectrum.luminance()},
          {"radiance", spectrum.total_radiance()},
          {"lumens_per_watt", spectrum.luminous_efficacy()},
          {"samples", std::move(list)}};
}

void print(const LightQuantity& quantity, const render::MeterReading& r, double lumens_per_watt) {
  const auto value = static_cast<double>(luminance(r.value));
  std::printf("%-18s %.5g ± %.2g %s   RGB %.5g %.5g %.5g\n", quantity.name, value, r.standard_error, quantity.unit,
              static_cast<double>(r.value.r), static_cast<double>(r.value.g), static_cast<double>(r.value.b));
  std::printf("%-18s %.5g ± %.2g %s at %.4g lm/W\n", quantity.radiometric_name, value / lumens_per_watt,
              r.standard_error / lumens_per_watt, quantity.radiometric_unit, lumens_per_watt);
}

void print_lights(const render::MeterReadings& m, double lumens_per_watt) {
  for (const render::LightIntensity& light : m.lights) {
    const auto candela = static_cast<double>(luminance(light.intensity));
    std::printf("%-18s %.5g cd (%.5g W/sr) towards the point, from %.4g m\n", light.name.c_str(), candela,
                candela / lumens_per_watt, static_cast<double>(light.distance));
  }
}

void print(const render::MeasuredSpectrum& spectrum) {
  std::printf("wavelength, nm   radiance, W/(m^2 sr nm)\n");
  for (size_t i = 0; i < render::MeasuredSpectrum::kBins; ++i)
    std::printf("%14.1f   %.4g ± %.1g\n", render::MeasuredSpectrum::wavelength(i), spectrum.radiance[i],
                spectrum.standard_error[i]);
}

void print(const render::MeterReadings& m, const Efficacies& efficacies) {
  print(kLuminance, m.radiance, efficacies.radiance);
  print(kIlluminance, m.irradiance, efficacies.irradiance);
  if (!is_black(m.emitted_flux)) print(kLuminousFlux, {m.emitted_flux, 0}, efficacies.other);
  if (!is_black(m.emitted_exitance)) print(kLuminousExitance, {m.emitted_exitance, 0}, efficacies.other);
}

// The spectra of radiance and irradiance.
struct MeasuredSpectra {
  render::MeasuredSpectrum radiance, irradiance;

  // Black spectra have no efficacy.
  Efficacies efficacies(double other) const {
    const auto known = [&](double efficacy) { return efficacy > 0 ? efficacy : other; };
    return {known(radiance.luminous_efficacy()), known(irradiance.luminous_efficacy()), other};
  }
};
Result<MeasuredSpectra> measure_spectra(const ProbeArguments& a, const render::Document& document,
                                        const std::shared_ptr<const scene::CompiledScene>& scene,
                                        const render::MeterPoint& point, const std::atomic<bool>& interrupted) {
  const auto keep_going = [&] { return !interrupted; };
  const auto radiance = render::measure_radiance_spectrum(document, scene, point, a.samples, keep_going);
  if (!radiance) return radiance.error();
  const auto irradiance = render::measure_irradiance_spectrum(document, *scene, point, a.samples, keep_going);
  if (!irradiance) return irradiance.error();
  return MeasuredSpectra{*radiance, *irradiance};
}

bool renders_spectra(const render::Document& document, const scene::CompiledScene& scene) {
  return transport::model_for(scene, {}, {}, document.method.color).spectral;
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
  const double chosen = lumens_per_watt(*efficacy);
  Efficacies efficacies{chosen, chosen, chosen};
  std::optional<MeasuredSpectra> spectra;
  if ((a.spectrum || renders_spectra(*document, *scene)) && !interrupted) {
    const auto measured = measure_spectra(a, *document, scene, *point, interrupted);
    if (!measured && !interrupted) return fail(measured.error());
    if (measured) spectra = *measured, efficacies = measured->efficacies(chosen);
  }
  if (a.json) {
    json j = readings_json(readings, efficacies);
    if (readings.received_flux) j["received_flux"] = reading_json(*readings.received_flux, efficacies.irradiance);
    if (spectra) j["spectrum"] = spectrum_json(spectra->radiance);
    std::printf("%s\n", json_text(j, 2).c_str());
  } else {
    print(readings, efficacies);
    if (readings.received_flux) print(kReceivedFlux, *readings.received_flux, efficacies.irradiance);
    print_lights(readings, chosen);
    if (a.spectrum && spectra) print(spectra->radiance);
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
                              "daylight or maximal. Spectral rendering measures that of luminance and illuminance"},
                      {.names = "--spectrum",
                       .target = &a->spectrum,
                       .doc = "Also the spectral radiance from the point, by wavelength"},
                      threads_option(a->threads),
                      json_flag(a->json)},
          .run = [a] { return run_probe(*a); }};
}

}  // namespace etendue::cli
