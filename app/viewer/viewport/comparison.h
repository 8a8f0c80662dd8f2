// The comparison of two images in the viewport: side by side with a divider, their difference, or FLIP; and a reference
// image that is shown while Shift is held.
//
// Image A is the live image unless another one is set. The others are pinned images, files, or images of the methods that
// the Convergence panel compares.
#pragma once
#include <algorithm>
#include <chrono>
#include <functional>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "base/result.h"
#include "render/display_frame.h"
#include "viewer/platform/input.h"
#include "viewer/tasks/background_task.h"
#include "viewer/viewport/difference_map.h"

namespace etendue::viewer {

struct Side {
  std::string name{};                          // for scripts: "path, sobol, 64 spp", or a file name
  std::string label{};                         // for the user: "Path tracing, Sobol', 64 spp"
  std::shared_ptr<const render::Frame> frame;  // null if there is no such image
  std::string unavailable{};                   // why the integrator cannot render the image; empty if it can
};

class Comparison {
 public:
  using Clock = std::chrono::steady_clock;

  explicit Comparison(std::function<void()> wake) : wake_(std::move(wake)) {}

  Side a;  // the live image is used if it has no frame
  Side b;
  Side reference;
  Side live;
  CompareMode mode = CompareMode::off;
  float divider = 0.5f;  // position in `wipe`, relative to the width of the image
  bool swapped = false;
  bool shows_reference = false;

  const Side& first() const { return a.frame || !a.unavailable.empty() ? a : live; }
  const Side& left() const { return swapped ? b : first(); }
  const Side& right() const { return swapped ? first() : b; }
  const char* left_letter() const { return swapped ? "B" : "A"; }
  const char* right_letter() const { return swapped ? "A" : "B"; }

  // Whether two images are shown. If a mode is selected but images are missing or differ in size, `problem` says why
  // not.
  bool is_active() const { return mode != CompareMode::off && problem().empty(); }
  std::string problem() const;
  bool reference_is_shown() const;

  // Makes the current live image B.
  void pin() { b = live; }
  void move_divider(float by) { divider = std::clamp(divider + by, 0.0f, 1.0f); }

  // Reads an image in the background. B must have the size of A, and the reference that of the live image.
  enum class Target { a, b, reference };
  void load(const std::string& file, Target target);
  // Reads two images as A and B.
  void load_both(const std::string& file_a, const std::string& file_b);
  // The message about an image that was loaded, or the error; once.
  std::optional<Result<std::string>> take_load_result();

  // Called once per frame: takes a finished map and starts the next one.
  void update(float exposure, image::ToneCurve curve);
  // Whether an image is being read or the map does not belong to the current images.
  bool is_busy() const { return loading_.running() || !map_is_current_; }
  // The map of the current mode, possibly of older images; null if there is none.
  std::shared_ptr<const DifferenceMap> map() const;

  // Called before every frame. Holding Shift alone for a moment shows the reference. Returns true if that changes.
  bool update_shift(const Input& input, bool typing, Clock::time_point now);
  bool waits_for_shift() const { return shift_ == Shift::held; }

 private:
  struct LoadedImage {
    Target target = Target::b;
    Side side;
    std::optional<Side> other;  // B, if both sides were read
  };
  std::string take_side(LoadedImage loaded);
  // used: Shift is part of another input, such as a pan or a capital letter.
  enum class Shift { up, held, shows_reference, used };

  std::function<void()> wake_;
  BackgroundTask<std::shared_ptr<const DifferenceMap>> map_task_;
  BackgroundTask<Result<LoadedImage>> loading_;
  CompareMode computing_mode_ = CompareMode::off;
  std::shared_ptr<const DifferenceMap> map_;
  bool map_is_current_ = true;
  Clock::time_point map_time_{};
  Clock::time_point shift_time_{};
  Shift shift_ = Shift::up;
};

}  // namespace etendue::viewer
