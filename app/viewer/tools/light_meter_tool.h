// The light meter: measures radiance, irradiance and emitted flux at a point of a surface, in radiometric and
// photometric units.
#pragma once
#include <nlohmann/json_fwd.hpp>
#include <optional>

#include "base/vec.h"
#include "render/light_meter.h"
#include "spectrum/photometry.h"
#include "viewer/tasks/progressive_task.h"
#include "viewer/tasks/task.h"

struct ImDrawList;

namespace etendue::viewer {

struct AppState;

class LightMeter final : public Task {
 public:
  struct Parameters {
    Choice<Efficacy> efficacy{"meter.efficacy", "Luminous efficacy", Efficacy::equal_energy,
                              "Spectrum assumed when converting lumens to watts. RGB values do not determine it"};
    Toggle spectrum{"meter.spectrum", "Spectrum", true,
                    "Also measures the spectral radiance with spectral paths, and the luminous efficacy that follows"};
    Number<float> sensor{
        "meter.sensor",
        "Sensor size",
        0,
        {0, 1e6f},
        "Side of a square sensor at the point, drawn in the image, that measures the received flux. 0: "
        "no sensor",
        "m",
        Scale::logarithmic};
    auto all() { return std::tie(efficacy, spectrum, sensor); }
  };
  Parameters parameters;

  // Measures at a position of the image, in pixels.
  void measure(Vec2 raster);
  std::optional<Vec2> position() const { return raster_; }

  // Called once per frame. An edit of the scene repeats the measurement.
  void update(const TaskContext& context);
  void reset(const TaskContext& context) override;
  bool has_update() const override { return task_.has_update(); }

  // Null if there is no measurement yet.
  const render::MeterReadings* result() const { return task_.result() ? &task_.result()->readings : nullptr; }
  // Whether the result has all samples and belongs to the current document.
  bool is_complete(uint64_t document_version) const {
    return result() && !task_.running() && version_ == document_version && sensor_size_ == parameters.sensor;
  }

  // Null if there is none yet, or if the scene cannot be rendered with spectra.
  const render::MeasuredSpectrum* spectrum() const {
    return task_.result() && task_.result()->spectrum ? &*task_.result()->spectrum : nullptr;
  }

  // The parameters and the readings.
  void draw(AppState& state);
  // A marker at the position in the image.
  void draw_marker(const AppState& state, ImDrawList& draw) const;
  nlohmann::json report(uint64_t document_version) const;

 private:
  void draw_sensor(const AppState& state, ImDrawList& draw) const;

  std::optional<Vec2> raster_;
  uint64_t version_ = 0;        // of the document that is measured
  bool with_spectrum_ = false;  // of the measurement
  float sensor_size_ = 0;       // of the measurement
  struct Measurement {
    render::MeterReadings readings;
    std::optional<render::MeasuredSpectrum> spectrum;  // of the radiance
  };
  ProgressiveTask<Measurement> task_;
};

// The name of the action that activates the light meter.
inline constexpr const char* kLightMeterAction = "meter.pick";

}  // namespace etendue::viewer
