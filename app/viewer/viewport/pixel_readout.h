// The values of single pixels of the image: radiance, displayed value, samples and standard error, for the pixel under
// the pointer and for a pinned one.
#pragma once
#include <functional>
#include <memory>
#include <optional>
#include <vector>

#include "base/vec.h"
#include "spectrum/rgb.h"
#include "viewer/tasks/background_task.h"
#include "viewer/viewport/movable_window.h"

namespace etendue::render {
class Session;
}

namespace etendue::viewer {

struct AppState;
class Editor;

// Sample counts and errors of all pixels at one moment, row by row.
struct PixelErrors {
  uint64_t version = 0;        // of the document
  uint32_t frame_samples = 0;  // complete samples of every pixel
  int width = 0;
  int height = 0;
  std::vector<uint32_t> samples;
  std::vector<float> errors;  // pixel_errors (error_layer.h), in cd/m^2
};

struct PixelValues {
  Vec2i pixel{0};
  Rgb radiance{0};                      // linear, cd/m^2
  Rgb displayed{0};                     // 0 to 1, sRGB encoded
  bool is_preview = false;              // the pixel shows an interpolated preview
  std::optional<uint32_t> samples;      // nothing while they are not known
  std::optional<float> standard_error;  // in cd/m^2; nothing before both half-buffers have samples
  std::optional<Rgb> layer;             // of the layer of radiance that is shown instead of the image
};

class PixelReadout {
 public:
  PixelReadout(render::Session& session, const Editor& editor, std::function<void()> wake)
      : session_(session), editor_(editor), wake_(std::move(wake)) {}

  // Called once per frame; `visible` says whether the values are shown. The errors are computed in the background,
  // again when the number of samples has grown by a quarter.
  void update(bool visible);
  // The errors of the current document; null if they are not known yet.
  const PixelErrors* errors() const;
  MovableWindow& window() { return window_; }

 private:
  bool is_outdated() const;

  render::Session& session_;
  const Editor& editor_;
  std::function<void()> wake_;
  BackgroundTask<PixelErrors> task_;
  PixelErrors errors_;
  MovableWindow window_;
};

// The values of a pixel; nothing outside the image or before the first frame.
std::optional<PixelValues> pixel_values(const AppState& state, Vec2i pixel);
// The pixel of the image under the pointer, unless a window covers it.
std::optional<Vec2i> pixel_under_pointer(const AppState& state);

// The window with the values, and the mark of the pinned pixel.
void draw_pixel_readout(AppState& state);

}  // namespace etendue::viewer
