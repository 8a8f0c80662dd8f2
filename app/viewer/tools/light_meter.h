// The light meter: what was measured where the hand last clicked with it.
#pragma once
#include <optional>

#include "render/light_meter.h"
#include "spectrum/photometry.h"
#include "viewer/state/editor.h"
#include "viewer/tasks/progressive_task.h"

namespace etendue::viewer {

struct MeterSetup {
  Choice<Efficacy> efficacy{
      "meter.efficacy", "A watt of light is", Efficacy::equal_energy,
      "Which spectrum watts have, so that they can be told in lumens: three bands do not know it"};
  auto knobs() { return std::tie(efficacy); }
};

class MeterHand {
 public:
  MeterHand(const render::Session& session, const Editor& editor, const std::function<void()>& wake)
      : session_(session), editor_(editor), study_(wake) {}

  MeterSetup setup;
  bool picks = false;  // the next click in the picture measures there

  // At a place in pixels of the picture.
  void measure(Vec2 raster);
  void forget();
  // Null until there is something.
  const render::MeterReadings* shown() const { return study_.shown().get(); }
  std::optional<Vec2> place() const { return raster_; }
  // Whether it is of the scene on the desk, and whole.
  bool whole() const { return shown() && !study_.running() && version_ == editor_.version(); }
  bool has_news() const { return study_.has_news(); }
  // Called once a frame; an edit of the light measures anew.
  void advance();

 private:
  const render::Session& session_;
  const Editor& editor_;
  std::optional<Vec2> raster_;
  uint64_t version_ = 0;  // of the document that is measured
  Study<render::MeterReadings> study_;
};

std::vector<ParameterInfo> meter_parameters(const MeterSetup& setup = {});

}  // namespace etendue::viewer
