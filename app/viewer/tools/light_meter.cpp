#include "viewer/tools/light_meter.h"

namespace etendue::viewer {
namespace {

constexpr uint32_t kSamples = 2048;

}  // namespace

void MeterHand::measure(Vec2 raster) {
  raster_ = raster;
  version_ = 0;
  study_.clear();
}

void MeterHand::forget() {
  raster_.reset();
  study_.clear();
}

void MeterHand::advance() {
  study_.advance();
  const auto scene = session_.scene();
  if (!raster_ || !scene || version_ == editor_.version() || session_.status().version != editor_.version()) return;
  version_ = editor_.version();
  const auto spot = render::spot_at(editor_.document(), *scene, *raster_);
  if (!spot) return study_.clear();
  study_.start([document = editor_.document(), scene, spot = *spot](const auto& publish, const bench::Progress& watch) {
    // One thread: the picture goes on beside it.
    render::measure_spot(document, scene, spot, kSamples, 1, [&](const render::MeterReadings& readings) {
      publish(readings);
      return watch(static_cast<double>(readings.samples) / kSamples, "");
    });
  });
}

std::vector<ParameterInfo> meter_parameters(const MeterSetup& setup) { return describe_all(MeterSetup(setup).knobs()); }

}  // namespace etendue::viewer
