#include "viewer/tools/light_meter_tool.h"

#include <imgui.h>

#include <algorithm>
#include <nlohmann/json.hpp>

#include "camera/segment_projection.h"
#include "light/light_type.h"
#include "viewer/state/app_state.h"
#include "viewer/state/editor.h"
#include "viewer/widgets/action_widgets.h"
#include "viewer/widgets/basic_widgets.h"
#include "viewer/widgets/parameter_widgets.h"
#include "viewer/widgets/spectrum_plot.h"
#include "viewer/widgets/value_text.h"

namespace etendue::viewer {
namespace {

constexpr uint32_t kSamples = 2048, kSpectralSamples = 512;

void draw_reading(const UiContext& ui, const LightQuantity& quantity, const render::MeterReading& reading,
                  Efficacy efficacy, const char* tooltip_text) {
  const auto value = static_cast<double>(luminance(reading.value));
  const double error = reading.standard_error;
  labelled_value(ui, quantity.name,
                 formatted("%.4g \u00b1 %.1g %s", value, error, with_superscripts(quantity.unit).c_str()),
                 tooltip_text);
  labelled_value(ui, quantity.radiometric_name,
                 formatted("%.4g \u00b1 %.1g %s", radiometric(value, efficacy), radiometric(error, efficacy),
                           with_superscripts(quantity.radiometric_unit).c_str()),
                 tooltip_text);
}

void draw_spectrum(UiContext& ui, const render::MeasuredSpectrum& spectrum) {
  labelled_value(ui, "Measured efficacy", formatted("%.4g lm/W", spectrum.luminous_efficacy()),
                 "Luminous efficacy of the light from the surface to the camera, by its spectrum and V(\u03bb)");
  labelled_value(ui, "Measured radiance",
                 formatted("%.4g %s", spectrum.total_radiance(), with_superscripts("W/(m^2 sr)").c_str()),
                 "Integral of the spectral radiance from 380 to 780 nm");
  spectrum_plot(ui, "meter.spectrum-plot", "Spectral radiance, mW/(m\u00b2 sr nm)", 0, [&](double wavelength) {
    const double bin = std::clamp((wavelength - kFirstWavelength) / kWavelengthStep, 0.0,
                                  static_cast<double>(render::MeasuredSpectrum::kBins - 1));
    return 1000 * spectrum.radiance[static_cast<size_t>(bin)];
  });
}

}  // namespace

void LightMeter::measure(Vec2 raster) {
  raster_ = raster;
  version_ = 0;
  task_.reset();
}

void LightMeter::reset(const TaskContext&) {
  raster_.reset();
  task_.reset();
}

void LightMeter::update(const TaskContext& context) {
  task_.update();
  const uint64_t version = context.editor.version();
  const auto scene = context.session.scene();
  if (!raster_ || !scene || context.session.status().version != version) return;
  const bool is_measured =
      version_ == version && with_spectrum_ == parameters.spectrum && sensor_size_ == parameters.sensor;
  if (is_measured) return;
  version_ = version;
  with_spectrum_ = parameters.spectrum;
  sensor_size_ = parameters.sensor;
  const auto& document = context.editor.document();
  const auto point = render::meter_point_at(document, *scene, *raster_);
  if (!point) return task_.reset();
  // One thread, because the main rendering continues.
  const render::MeterSettings settings{.samples = kSamples, .threads = 1, .sensor_size = sensor_size_};
  const auto work = [document, scene, settings, point = *point, with_spectrum = with_spectrum_](
                        const auto& publish, const bench::Progress& progress) {
    Measurement measurement;
    bool keep_going = true;
    render::measure_light(document, scene, point, settings, [&](const render::MeterReadings& readings) {
      measurement.readings = readings;
      publish(measurement);
      return keep_going = progress(static_cast<double>(readings.samples) / kSamples, "");
    });
    if (!with_spectrum || !keep_going) return;
    const auto spectrum =
        render::measure_radiance_spectrum(document, scene, point, kSpectralSamples, [&] { return progress(1, ""); });
    if (!spectrum) return;
    measurement.spectrum = *spectrum;
    publish(measurement);
  };
  task_.start(work, context.wake);
}

void LightMeter::draw(AppState& state) {
  const UiContext& ui = state.ui;
  action_button(state, kLightMeterAction);
  parameter_widgets(state, parameters.all());
  if (state.is_active_tool(kLightMeterAction)) return note(ui, "Click a surface in the image.");
  const render::MeterReadings* readings = result();
  if (!readings) {
    if (raster_) note(ui, "There is no surface at this pixel, or the measurement is still running.");
    return;
  }
  draw_reading(ui, kLuminance, readings->radiance, parameters.efficacy,
               "From the surface towards the camera. The radiance is the luminance divided by the luminous efficacy");
  draw_reading(ui, kIlluminance, readings->irradiance, parameters.efficacy,
               "On the side of the surface that faces the camera. The irradiance is the illuminance divided by the "
               "luminous efficacy");
  if (!is_black(readings->emitted_flux))
    draw_reading(
        ui, kLuminousFlux, {readings->emitted_flux, 0}, parameters.efficacy,
        "Emitted by the whole object. The power in watts is the luminous flux divided by the luminous efficacy");
  if (!is_black(readings->emitted_exitance))
    draw_reading(ui, {"Luminous exitance", "lm/m^2", "Radiant exitance", "W/m^2"}, {readings->emitted_exitance, 0},
                 parameters.efficacy, "The emitted flux over the area of all emitting sides");
  if (readings->received_flux)
    draw_reading(ui, {"Received flux", "lm", "Received power", "W"}, *readings->received_flux, parameters.efficacy,
                 "Received by the square sensor at the point, which casts a shadow");
  for (const render::LightIntensity& light : readings->lights)
    labelled_value(ui, light.name.c_str(), formatted("%.4g cd", static_cast<double>(luminance(light.intensity))),
                   "Luminous intensity of this light towards the point, whether or not something is in between");
  if (spectrum()) draw_spectrum(state.ui, *spectrum());
  if (!is_complete(state.editor->version())) note(ui, "Measuring: the errors decrease with more samples.");
}

void LightMeter::draw_marker(const AppState& state, ImDrawList& draw) const {
  if (!raster_) return;
  const auto& d = state.document();
  const Placement& image = state.viewport.image;
  const Vec2 at = image.corner + *raster_ * image.size / Vec2(d.width, d.height);
  const float r = ImGui::GetFontSize() * 0.5f;
  const auto draw_cross = [&](ImU32 color, float width) {
    draw.AddCircle({at.x, at.y}, r, color, 0, width);
    draw.AddLine({at.x - 0.3f * r, at.y}, {at.x + 0.3f * r, at.y}, color, width);
    draw.AddLine({at.x, at.y - 0.3f * r}, {at.x, at.y + 0.3f * r}, color, width);
  };
  draw_cross(IM_COL32(0, 0, 0, 170), 3.5f);
  draw_cross(IM_COL32(255, 220, 80, 255), 1.5f);
  draw_sensor(state, draw);
}

void LightMeter::draw_sensor(const AppState& state, ImDrawList& draw) const {
  const render::MeterReadings* readings = result();
  if (!readings || !(sensor_size_ > 0)) return;
  const auto& d = state.document();
  const Placement& image = state.viewport.image;
  const auto corners = render::sensor_corners(readings->point, sensor_size_);
  for (size_t i = 0; i < corners.size(); ++i) {
    const auto ends = project_segment(d.camera, {d.width, d.height}, corners[i], corners[(i + 1) % corners.size()]);
    if (!ends) continue;
    const auto on_screen = [&](Vec2 raster) {
      const Vec2 at = image.corner + raster * image.size / Vec2(d.width, d.height);
      return ImVec2(at.x, at.y);
    };
    draw.AddLine(on_screen((*ends)[0]), on_screen((*ends)[1]), IM_COL32(0, 0, 0, 170), 3.5f);
    draw.AddLine(on_screen((*ends)[0]), on_screen((*ends)[1]), IM_COL32(255, 220, 80, 255), 1.5f);
  }
}

nlohmann::json LightMeter::report(uint64_t document_version) const {
  const render::MeterReadings* readings = result();
  if (!readings) return nullptr;
  const auto to_json = [](const render::MeterReading& r) {
    return nlohmann::json{{"value", {r.value.r, r.value.g, r.value.b}}, {"standard_error", r.standard_error}};
  };
  nlohmann::json report{{"whole", is_complete(document_version)},
                        {"radiance", to_json(readings->radiance)},
                        {"irradiance", to_json(readings->irradiance)}};
  if (spectrum()) report["lumens_per_watt"] = spectrum()->luminous_efficacy();
  if (readings->received_flux) report["received_flux"] = to_json(*readings->received_flux);
  return report;
}

}  // namespace etendue::viewer
