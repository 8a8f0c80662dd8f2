// Two pictures against each other: either side of a divider, their difference, or what an eye makes of it (FLIP); and a
// reference that comes forth while Shift is held.
//
// Whoever has pictures puts them into `a`, `b` and `reference`. Where nobody does, A is the live picture, and B one
// that was kept of it before.
#pragma once
#include <algorithm>
#include <chrono>
#include <functional>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "base/result.h"
#include "image/display.h"
#include "render/frame.h"
#include "viewer/platform/input.h"
#include "viewer/tasks/background_task.h"

namespace etendue::viewer {

enum class CompareMode : uint8_t { off, wipe, difference, flip };
const char* name_of(CompareMode mode);

struct Side {
  std::string name;                            // "path, sobol, 64 spp"
  std::shared_ptr<const render::Frame> frame;  // none: there is no such side
};

// What a map was made of; another one asks for another map.
struct MapKey {
  CompareMode mode = CompareMode::off;
  std::shared_ptr<const std::vector<Rgb>> left, right;
  float exposure = 0;  // these two for FLIP, which sees what the screen shows
  image::ToneCurve curve = image::ToneCurve::none;

  friend bool operator==(const MapKey&, const MapKey&) = default;
};

// How the left side differs from the right.
struct DifferenceMap {
  MapKey key;
  std::vector<float> values;  // luminance of left minus right, W/(m^2 sr); or FLIP, 0 to 1
  std::vector<Rgb> painted;   // linear, to be shown as it is
  float scale = 1;            // the value at the end of the colours; 0 where nothing differs
  double mean = 0;            // of the values
  double seconds = 0;         // that it took
};

class Comparison {
 public:
  using Clock = std::chrono::steady_clock;

  explicit Comparison(std::function<void()> wake) : job_(wake), loading_(std::move(wake)) {}

  Side a, b, reference;  // without a frame in `a`, the live picture takes its place
  Side live;
  CompareMode mode = CompareMode::off;
  float divider = 0.5f;  // of the wipe, as a share of the picture's width
  bool swapped = false, shows_reference = false;

  const Side& first() const { return a.frame ? a : live; }
  const Side& left() const { return swapped ? b : first(); }
  const Side& right() const { return swapped ? first() : b; }
  const char* left_letter() const { return swapped ? "B" : "A"; }
  const char* right_letter() const { return swapped ? "A" : "B"; }

  // Whether there is something to show; if not though it is switched on, `problem` has the reason.
  bool active() const { return mode != CompareMode::off && problem().empty(); }
  std::string problem() const;
  bool reference_on_screen() const;

  void pin() { b = live; }
  void move_divider(float by) { divider = std::clamp(divider + by, 0.0f, 1.0f); }

  // Reads a picture in the background into B or the reference. Its size must be that of the live picture.
  enum class Target { b, reference };
  void load(const std::string& file, Target target);
  // The line that says what was loaded, or what went wrong; once.
  std::optional<Result<std::string>> take_loaded();

  // Called once a frame: takes up a finished map, starts the next. True if there is a new one.
  bool advance(float exposure, image::ToneCurve curve);
  // Whether something is being read, or the map is not that of the present pictures.
  bool busy() const { return loading_.running() || !settled_; }
  // The map of the present mode, perhaps of pictures that are no longer the newest; or none yet.
  std::shared_ptr<const DifferenceMap> map() const;

  // Called before every frame: Shift alone, held for a moment, shows the reference. True if that changed what is shown.
  bool watch_shift(const Input& input, bool typing, Clock::time_point now);
  bool waits_for_shift() const { return shift_ == Shift::held; }

 private:
  struct Loaded {
    Target target;
    Side side;
  };
  enum class Shift { up, held, shows, spoilt };  // spoilt: it went with something else

  Job<std::shared_ptr<const DifferenceMap>> job_;
  Job<Result<Loaded>> loading_;
  CompareMode making_ = CompareMode::off;
  std::shared_ptr<const DifferenceMap> map_;
  bool settled_ = true;
  Clock::time_point made_{}, shift_since_{};
  Shift shift_ = Shift::up;
};

// The difference of two pictures of one size, as its key asks for it; takes milliseconds for each megapixel, FLIP a
// second.
std::shared_ptr<const DifferenceMap> make_map(const MapKey& key, int width, int height);

}  // namespace etendue::viewer
