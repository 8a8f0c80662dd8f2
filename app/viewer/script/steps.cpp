#include "viewer/script/steps.h"

#include <imgui.h>

#include <algorithm>
#include <nlohmann/json.hpp>

#include "base/file.h"
#include "viewer/layout/interface.h"
#include "viewer/script/script.h"

namespace etendue::viewer {
namespace {

using nlohmann::json;
using Clock = std::chrono::steady_clock;

constexpr Progress kDone{true, {}}, kGoingOn{false, {}};
constexpr int kLookingFrames = 12;  // for an item that has to come into sight first

Progress impossible(std::string why) { return {false, std::move(why)}; }

// Frames that the interface gets to answer what was done to it.
class Rest {
 public:
  explicit Rest(int frames) : left_(frames) {}
  bool over() { return left_-- <= 0; }

 private:
  int left_;
};

class Wait final : public Step {
 public:
  Wait(uint32_t samples, double seconds) : samples_(samples), seconds_(seconds) {}
  Progress advance(Workbench& w, Picture&) override {
    if (seconds_ > 0) return {std::chrono::duration<double>(Clock::now() - started_).count() >= seconds_, {}};
    if (w.loader.busy()) return kGoingOn;
    const auto status = w.session.status();
    if (status.version != w.editor.version() || !w.frame) return kGoingOn;
    if (status.samples >= samples_) return {w.frame->version == w.editor.version() && w.frame->samples >= samples_, {}};
    if (w.session.paused())
      return impossible("the rendering is paused at " + std::to_string(status.samples) +
                        " samples; let it go on first");
    if (status.finished)
      return impossible("the rendering ends at " + std::to_string(status.samples) +
                        " samples; raise the limit or wait for less");
    return kGoingOn;
  }
  bool hurries() const override { return false; }
  double patience() const override { return 3600; }

 private:
  uint32_t samples_;
  double seconds_;
  Clock::time_point started_ = Clock::now();
};

// Until every method of the contest has so many samples; if no number is given, until the contest has come to rest and
// what was exported of it is written.
class WaitForContest final : public Step {
 public:
  explicit WaitForContest(std::optional<uint32_t> samples = {}) : samples_(samples) {}
  Progress advance(Workbench& w, Picture&) override {
    const auto* contest = w.contest.shown();
    if (!contest) return impossible("no methods are compared; click compare.start first");
    using Phase = bench::LiveBenchmarkSnapshot::Phase;
    if (!samples_)
      return {!w.contest.running() && (contest->phase == Phase::stopped || contest->phase == Phase::done) &&
                  !w.contest.writing(),
              {}};
    if (std::ranges::all_of(contest->methods, [&](const auto& m) { return m.samples >= *samples_; })) return kDone;
    return w.contest.running() ? kGoingOn : impossible("the comparison has ended with fewer samples; raise its budget");
  }
  bool hurries() const override { return false; }
  double patience() const override { return 3600; }

 private:
  std::optional<uint32_t> samples_;
};

// Until what is made beside the rendering belongs to the present picture.
class WaitForWork final : public Step {
 public:
  explicit WaitForWork(bool pixel) : pixel_(pixel) {}
  Progress advance(Workbench& w, Picture&) override {
    if (!rest_.over()) return kGoingOn;
    if (pixel_ && !render::PixelSamples::possible(w.editor.document()))
      return impossible("no sample of this integrator belongs to one pixel");
    if (pixel_ && !w.probe.pixel()) return impossible("no pixel is chosen");
    return {!(pixel_ ? w.probe.busy() : w.comparison.busy()), {}};
  }

 private:
  bool pixel_;
  Rest rest_{3};
};

// Until the path classes of the view, or the advice, are whole.
class WaitForStudy final : public Step {
 public:
  explicit WaitForStudy(bool paths) : paths_(paths) {}
  Progress advance(Workbench& w, Picture&) override {
    if (!begun_.over() || (paths_ ? w.paths.running() : w.advice.running())) return kGoingOn;
    // A table's columns take some frames to find their widths.
    if (!settled_.over()) return kGoingOn;
    if (paths_)
      return w.paths.fresh() ? kDone
                             : impossible("the path classes of this view were not measured; click paths.measure first");
    return w.advice.shown() ? kDone : impossible("no advice was asked for; click advice.ask first");
  }
  bool hurries() const override { return false; }
  double patience() const override { return 3600; }

 private:
  bool paths_;
  Rest begun_{3}, settled_{3};
};

// Until it is known what the method misses of the view, or what it keeps in space.
class WaitForKnowledge final : public Step {
 public:
  explicit WaitForKnowledge(bool points) : points_(points) {}
  Progress advance(Workbench& w, Picture&) override {
    if (!begun_.over()) return kGoingOn;
    if (points_ && !w.view.points) return impossible("nobody looks at them; click view.points first");
    if (!points_ && w.view.tab != Tab::render) return impossible("nobody looks at it; click tab.render first");
    const bool known = points_ ? w.points.shown() != nullptr : w.misses() != nullptr;
    return {known && settled_.over(), {}};
  }
  bool hurries() const override { return false; }
  double patience() const override { return 3600; }

 private:
  bool points_;
  Rest begun_{3}, settled_{2};
};

// Until the light meter has read all it will.
class WaitForMeter final : public Step {
 public:
  Progress advance(Workbench& w, Picture&) override {
    if (!begun_.over()) return kGoingOn;
    if (!w.meter.place()) return impossible("nothing is measured; click meter.pick and then the picture first");
    return {w.meter.whole() && settled_.over(), {}};
  }
  bool hurries() const override { return false; }
  double patience() const override { return 3600; }

 private:
  Rest begun_{3}, settled_{2};
};

// Until the chosen material is measured, and its ball has a picture where the sheet is open.
class WaitForSurface final : public Step {
 public:
  Progress advance(Workbench& w, Picture&) override {
    if (!begun_.over()) return kGoingOn;
    const bool sheet = w.view.sheet == "sheet.surface";
    if (!sheet && w.view.tab != Tab::material) return impossible("nobody looks at it; click sheet.surface first");
    if (w.selection.material < 0) return impossible("no material is chosen");
    return {w.surface.fresh() && (!sheet || w.surface.ball(0).pixels) && settled_.over(), {}};
  }
  bool hurries() const override { return false; }
  double patience() const override { return 3600; }

 private:
  Rest begun_{3}, settled_{2};
};

// Until every technique has its picture.
class WaitForTechniques final : public Step {
 public:
  Progress advance(Workbench& w, Picture&) override {
    if (!begun_.over()) return kGoingOn;
    if (!w.techniques.possible()) return impossible("this integrator has no techniques");
    if (w.view.sheet != "sheet.techniques") return impossible("nobody looks at them; click sheet.techniques first");
    return {w.techniques.whole() && !w.techniques.writing() && settled_.over(), {}};
  }
  bool hurries() const override { return false; }
  double patience() const override { return 3600; }

 private:
  Rest begun_{3}, settled_{2};
};

class Set final : public Step {
 public:
  Set(std::string name, std::string value) : name_(std::move(name)), value_(std::move(value)) {}
  Progress advance(Workbench& w, Picture&) override {
    if (frames_++ == 0) {
      if (!reveal(w, name_)) return impossible("there is no setting of that name; see etendue list widgets");
      w.items.request(name_, value_);
      return kGoingOn;
    }
    if (answered_) return {rest_.over(), {}};
    if (const auto answer = w.items.take_answer()) {
      if (!answer->empty()) return impossible(*answer);
      answered_ = true;
      return kGoingOn;
    }
    if (frames_ <= kLookingFrames) return kGoingOn;
    w.items.cancel();
    const auto known = render::get(w.editor.document(), name_);
    return impossible(known ? "its widget is not on screen: another integrator, sampler or object is chosen"
                            : known.error().message);
  }

 private:
  std::string name_, value_;
  int frames_ = 0;
  bool answered_ = false;
  Rest rest_{1};
};

// Moves, presses, holds for a frame, lets go.
class Pointer final : public Step {
 public:
  Pointer(Vec2 from, Vec2 to, Button button) : from_(from), to_(to), button_(button) {}
  Progress advance(Workbench& w, Picture&) override {
    EventQueue& events = w.platform.events();
    constexpr int kMoves = 8;
    if (frame_ == 0) events.push({.type = Event::Type::move, .position = from_});
    if (frame_ == 2) events.push({.type = Event::Type::button, .button = button_, .down = true});
    if (frame_ > 3 && frame_ <= 3 + kMoves && from_ != to_)
      events.push(
          {.type = Event::Type::move, .position = glm::mix(from_, to_, static_cast<float>(frame_ - 3) / kMoves)});
    const int release = from_ == to_ ? 4 : 5 + kMoves;
    if (frame_ == release) events.push({.type = Event::Type::button, .button = button_, .down = false});
    return {frame_++ > release + 2, {}};
  }

 private:
  Vec2 from_, to_;
  Button button_;
  int frame_ = 0;
};

class Click final : public Step {
 public:
  explicit Click(std::string item) : item_(std::move(item)) {}
  Progress advance(Workbench& w, Picture& picture) override {
    if (pointer_) return pointer_->advance(w, picture);
    // What it did may have brought its button on screen: that is not pressed as well.
    if (ran_) return {rest_.over(), {}};
    if (const Placement* place = w.items.find(item_)) {
      const Action* action = w.actions.find(item_);
      if (action && !action->is_enabled()) return impossible("it is disabled now");
      w.items.seek("");
      const Vec2 middle = place->corner + place->size * 0.5f;
      pointer_ = std::make_unique<Pointer>(middle, middle, Button::left);
      return pointer_->advance(w, picture);
    }
    // What is not on screen is reached by its name, as the palette does it.
    if (const Action* action = w.actions.find(item_)) {
      if (!action->is_enabled()) return impossible("it is disabled now");
      action->run();
      ran_ = true;
      return kGoingOn;
    }
    if (!w.view.interface) w.view.interface = true;
    w.items.seek(item_);
    return ++frames_ <= kLookingFrames ? kGoingOn
                                       : impossible("nothing of that name is on screen; see etendue list widgets");
  }

 private:
  std::string item_;
  std::unique_ptr<Pointer> pointer_;
  int frames_ = 0;
  bool ran_ = false;
  Rest rest_{2};
};

// A drag that starts on an item.
class DragItem final : public Step {
 public:
  DragItem(std::string item, Vec2 by) : item_(std::move(item)), by_(by) {}
  Progress advance(Workbench& w, Picture& picture) override {
    if (!pointer_) {
      const Placement* place = w.items.find(item_);
      if (!place && ++frames_ <= kLookingFrames) return kGoingOn;
      if (!place) return impossible("nothing of that name is on screen; see etendue list widgets");
      const Vec2 middle = place->corner + place->size * 0.5f;
      pointer_ = std::make_unique<Pointer>(middle, middle + by_, Button::left);
    }
    return pointer_->advance(w, picture);
  }

 private:
  std::string item_;
  Vec2 by_;
  std::unique_ptr<Pointer> pointer_;
  int frames_ = 0;
};

class Scroll final : public Step {
 public:
  Scroll(Vec2 at, float by) : at_(at), by_(by) {}
  Progress advance(Workbench& w, Picture&) override {
    if (frame_ == 0) w.platform.events().push({.type = Event::Type::move, .position = at_});
    if (frame_ == 2) w.platform.events().push({.type = Event::Type::scroll, .position = Vec2(0, by_)});
    return {frame_++ > 4, {}};
  }

 private:
  Vec2 at_;
  float by_;
  int frame_ = 0;
};

class Key final : public Step {
 public:
  explicit Key(Chord chord) : chord_(chord) {}
  Progress advance(Workbench& w, Picture&) override {
    const auto push = [&](int key, bool down) {
      w.platform.events().push({.type = Event::Type::key, .key = key, .down = down});
    };
    constexpr int kControl = 341, kShift = 340, kAlt = 342;  // as GLFW numbers them
    const auto modifiers = [&](bool down) {
      if (chord_.control) push(kControl, down);
      if (chord_.shift) push(kShift, down);
      if (chord_.alt) push(kAlt, down);
    };
    if (frame_ == 0) {
      modifiers(true), push(chord_.key, true);
      // A text field hears characters, not keys.
      if (!chord_.control && !chord_.alt && chord_.key >= 32 && chord_.key < 127 && ImGui::GetIO().WantTextInput)
        w.platform.events().push(
            {.type = Event::Type::text,
             .character = static_cast<unsigned>(chord_.shift ? chord_.key : std::tolower(chord_.key))});
    }
    if (frame_ == 2) push(chord_.key, false), modifiers(false);
    return {frame_++ > 4, {}};
  }

 private:
  Chord chord_;
  int frame_ = 0;
};

// One key that goes down and stays there, or comes up again.
class HalfKey final : public Step {
 public:
  HalfKey(int key, bool down) : key_(key), down_(down) {}
  Progress advance(Workbench& w, Picture&) override {
    if (frame_ == 0) w.platform.events().push({.type = Event::Type::key, .key = key_, .down = down_});
    return {frame_++ > 1, {}};
  }

 private:
  int key_;
  bool down_;
  int frame_ = 0;
};

class Pick final : public Step {
 public:
  explicit Pick(Vec2 at) : at_(at), pointer_(at, at, Button::left) {}
  Progress advance(Workbench& w, Picture& picture) override {
    if (!w.view.picture.contains(at_)) return impossible("the place is not in the picture");
    const Progress progress = pointer_.advance(w, picture);
    if (progress.done && w.selection.node < 0) return impossible("there is nothing at that place");
    return progress;
  }

 private:
  Vec2 at_;
  Pointer pointer_;
};

class Open final : public Step {
 public:
  explicit Open(std::string file) : file_(std::move(file)) {}
  Progress advance(Workbench& w, Picture&) override {
    if (!begun_) {
      w.notices.take_error();
      w.platform.events().push({.type = Event::Type::drop, .file = file_});
      begun_ = true;
      return kGoingOn;
    }
    if (!came_) {
      came_ = w.loader.busy() || w.loader.file() == file_;
      return kGoingOn;
    }
    if (w.loader.busy()) return kGoingOn;
    if (const std::string error = w.notices.take_error(); !error.empty()) return impossible(error);
    return {w.frame && w.frame->version == w.editor.version(), {}};
  }

 private:
  std::string file_;
  bool begun_ = false, came_ = false;
};

class Screenshot final : public Step {
 public:
  explicit Screenshot(std::string file) : file_(std::move(file)) {}
  Progress advance(Workbench& w, Picture&) override {
    if (!rest_.over()) return kGoingOn;
    const Vec2i size = w.platform.size();
    const auto written =
        image::write_png(file_, size.x, size.y, read_window(w.platform.gl(), w.platform.framebuffer(), size));
    return written ? kDone : impossible(written.error().message);
  }

 private:
  std::string file_;
  Rest rest_{3};
};

class SaveImage final : public Step {
 public:
  explicit SaveImage(std::string file) : file_(std::move(file)) {}
  Progress advance(Workbench& w, Picture&) override {
    if (!begun_) {
      w.notices.take_error();
      w.save_snapshot(file_);
      begun_ = true;
      return kGoingOn;
    }
    if (w.capture.busy()) return kGoingOn;
    if (const std::string error = w.notices.take_error(); !error.empty()) return impossible(error);
    return kDone;
  }
  bool hurries() const override { return false; }

 private:
  std::string file_;
  bool begun_ = false;
};

class State final : public Step {
 public:
  explicit State(std::string file) : file_(std::move(file)) {}
  Progress advance(Workbench& w, Picture&) override {
    const std::string text = state_report(w);
    const auto written = write_file(file_, text.data(), text.size());
    return written ? kDone : impossible(written.error().message);
  }

 private:
  std::string file_;
};

Vec2 point(const json& j) { return {j.at(0).get<float>(), j.at(1).get<float>()}; }

Button button_of(const json& j) {
  const std::string name = j.value("button", "left");
  return name == "right" ? Button::right : name == "middle" ? Button::middle : Button::left;
}

std::string value_text(const json& j) { return j.is_string() ? j.get<std::string>() : j.dump(); }

}  // namespace

Result<std::unique_ptr<Step>> make_step(const json& j) {
  const auto made = [](auto step) { return std::unique_ptr<Step>(std::move(step)); };
  try {
    const std::string action = j.at("do").get<std::string>();
    if (action == "wait" && j.contains("spp")) return made(std::make_unique<Wait>(j["spp"].get<uint32_t>(), 0));
    if (action == "wait" && j.contains("compared"))
      return made(std::make_unique<WaitForContest>(j["compared"].get<uint32_t>()));
    if (action == "wait" && j.contains("for")) {
      const std::string what = j["for"].get<std::string>();
      if (what == "contest") return made(std::make_unique<WaitForContest>());
      if (what == "paths" || what == "advice") return made(std::make_unique<WaitForStudy>(what == "paths"));
      if (what == "techniques") return made(std::make_unique<WaitForTechniques>());
      if (what == "meter") return made(std::make_unique<WaitForMeter>());
      if (what == "surface") return made(std::make_unique<WaitForSurface>());
      if (what == "misses" || what == "points") return made(std::make_unique<WaitForKnowledge>(what == "points"));
      if (what != "pixel" && what != "comparison")
        return usage_error(
            "there is no waiting for '" + what +
            "'; give pixel, comparison, contest, paths, techniques, surface, meter, misses, points or advice");
      return made(std::make_unique<WaitForWork>(what == "pixel"));
    }
    if (action == "wait") return made(std::make_unique<Wait>(0, j.at("seconds").get<double>()));
    if (action == "set") return made(std::make_unique<Set>(j.at("name").get<std::string>(), value_text(j.at("value"))));
    if (action == "click") return made(std::make_unique<Click>(j.at("item").get<std::string>()));
    if (action == "drag" && j.contains("item"))
      return made(std::make_unique<DragItem>(j["item"].get<std::string>(), point(j.at("by"))));
    if (action == "drag") return made(std::make_unique<Pointer>(point(j.at("from")), point(j.at("to")), button_of(j)));
    if (action == "scroll") return made(std::make_unique<Scroll>(point(j.at("at")), j.at("by").get<float>()));
    if (action == "pick") return made(std::make_unique<Pick>(point(j.at("at"))));
    if (action == "open") return made(std::make_unique<Open>(j.at("file").get<std::string>()));
    if (action == "screenshot") return made(std::make_unique<Screenshot>(j.at("file").get<std::string>()));
    if (action == "image") return made(std::make_unique<SaveImage>(j.at("file").get<std::string>()));
    if (action == "state") return made(std::make_unique<State>(j.at("file").get<std::string>()));
    if (action == "key") {
      const auto chord = parse_chord(j.at("key").get<std::string>());
      if (!chord) return chord.error();
      if (j.contains("down")) return made(std::make_unique<HalfKey>(chord->key, j["down"].get<bool>()));
      return made(std::make_unique<Key>(*chord));
    }
    return usage_error("there is no '" + action +
                       "'; give wait, set, click, drag, scroll, key, pick, open, screenshot, image or state");
  } catch (const json::exception& error) {
    return usage_error(std::string("is not a complete step (") + error.what() + "); see the script reference");
  }
}

}  // namespace etendue::viewer
