// The loop: wait for something, take it up, draw if it can be seen.
#include "viewer/viewer.h"

#include <cstdio>
#include <filesystem>

#include "viewer/layout/interface.h"
#include "viewer/platform/imgui_host.h"
#include "viewer/platform/pacing.h"
#include "viewer/platform/process_age.h"
#include "viewer/script/script.h"
#include "viewer/viewport/comparison_view.h"
#include "viewer/widgets/parameter_widgets.h"

namespace etendue::viewer {
namespace {

using Clock = std::chrono::steady_clock;

// ImGui needs some frames until everything that an event caused has its place.
constexpr int kSettlingFrames = 3;

double seconds_between(Clock::time_point a, Clock::time_point b) {
  return std::chrono::duration<double>(b - a).count();
}

int fail(const Error& error) {
  std::fprintf(stderr, "etendue: %s\n", error.message.c_str());
  return static_cast<int>(error.fault);
}

class Application {
 public:
  Application(Platform& platform, const ViewOptions& options)
      : platform_(platform), w_(platform, options), picture_(platform.gl()) {}

  Result<void> start(const Settings& settings, const std::string& note) {
    if (auto started = host_.start(); !started) return started;
    if (auto started = picture_.start(); !started) return started;
    w_.settings = settings;
    w_.theme = apply_theme(settings.dark, platform_.scale());
    w_.faces = load_faces(platform_.scale());
    if (!note.empty()) w_.notices.say(note);
    return {};
  }

  int run(Script* script) {
    // The first picture needs the size of the viewport.
    draw();
    w_.open(w_.options.scene.empty() ? "cornell" : w_.options.scene);
    measured_ = last_ = Clock::now();
    while (!w_.quit && !platform_.closing()) {
      platform_.wait(patience(script));
      step(script);
      if (script && script->ended()) break;
    }
    return script ? script->exit_code() : 0;
  }

  const Settings& settings() {
    if (platform_.has_display()) w_.settings.window = platform_.place();
    return w_.settings;
  }

 private:
  bool writing() const { return w_.contest.writing() || w_.techniques.writing() || w_.scene_writer.busy(); }

  // Seconds to sleep if nothing happens.
  double patience(const Script* script) const {
    if (frames_wanted_ > 0 || !platform_.events().empty() || (script && script->in_a_hurry())) return 0;
    if (w_.input.buttons[1]) return 0.01;  // flying
    if (w_.pointer_rest < kTooltipDelay || w_.comparison.waits_for_shift()) return 0.05;
    if (w_.loader.busy() || w_.capture.busy() || writing()) return 0.05;
    if (script || fading_ || wait_for_frame_) return 0.02;
    if (w_.editor.empty()) return 0.5;
    const auto phase = w_.session.status().phase;
    return phase == "done" || phase == "paused" ? 1.0 : 0.1;
  }

  void step(Script* script) {
    const auto now = Clock::now();
    const double since_last = seconds_between(last_, now);
    if (script) script->advance(w_, picture_);
    if (platform_.events().take_frame(w_.input)) frames_wanted_ = kSettlingFrames, touched_ = now;
    const double rest = seconds_between(touched_, now);
    // One more frame brings the tooltip.
    if (w_.pointer_rest < kTooltipDelay && rest >= kTooltipDelay) frames_wanted_ = std::max(frames_wanted_, 1);
    w_.pointer_rest = rest;
    if (const Vec2i size = platform_.size(); size != size_) size_ = size, frames_wanted_ = kSettlingFrames;
    for (const auto& file : w_.input.dropped) w_.open(file);
    if (w_.comparison.watch_shift(w_.input, w_.view.typing, now)) frames_wanted_ = std::max(frames_wanted_, 1);
    const auto frame = w_.session.frame();
    const bool new_frame = frame && frame != w_.frame;
    const bool hurry =
        new_frame && (!w_.frame || frame->version != w_.frame->version || frame->coarseness != w_.frame->coarseness);
    const bool time_for_it = since_last >= pacing_.interval(frame ? frame->samples : 0);
    const bool told = w_.contest.has_news() || w_.paths.has_news() || w_.advice.has_news() ||
                      w_.missing_paths.has_news() || w_.techniques.has_news() || w_.surface.has_news() ||
                      w_.meter.has_news();
    const bool news = told && since_last >= pacing_.interval(0);
    wait_for_frame_ = (new_frame && !hurry && !time_for_it) || (told && !news);
    // Status figures move on even when no frame comes.
    const double still = w_.session.status().phase_progress > 0 ? 0.25 : 1;
    const bool due = frames_wanted_ > 0 || hurry || (new_frame && time_for_it) || news || since_last >= still ||
                     w_.loader.busy() || w_.capture.busy() || writing() || w_.input.buttons[1] ||
                     (script && script->wants_frame());
    if (due) draw();
    measure(now);
  }

  void draw() {
    const auto start = Clock::now();
    const auto seconds = static_cast<float>(seconds_between(last_, start));
    last_ = start;
    w_.advance(picture_);
    fading_ = w_.notices.pass(static_cast<double>(seconds));
    host_.begin_frame(w_.input, seconds);
    draw_interface(w_, seconds);
    const Gl& gl = platform_.gl();
    gl.BindFramebuffer(GL_FRAMEBUFFER, platform_.framebuffer());
    gl.Viewport(0, 0, size_.x, size_.y);
    gl.Disable(GL_SCISSOR_TEST);
    const ImVec4& ground = w_.theme.ground;
    gl.ClearColor(ground.x, ground.y, ground.z, 1);
    gl.Clear(GL_COLOR_BUFFER_BIT);
    if (!w_.editor.empty() && w_.frame) screen_.draw(w_, platform_.framebuffer(), size_);
    gl.Viewport(0, 0, size_.x, size_.y);
    host_.end_frame();
    platform_.present();
    if (w_.frame && w_.first_picture_seconds == 0) w_.first_picture_seconds = process_age();
    if (frames_wanted_ > 0) --frames_wanted_;
    // What a frame took must not be taken again by the next one.
    w_.input.pressed = {};
    w_.input.keys_pressed.reset();
    w_.input.wheel = 0;
    w_.input.text.clear();
    w_.input.dropped.clear();
    const double took = seconds_between(start, Clock::now());
    pacing_.drew(took);
    w_.pace.busy += took;
  }

  void measure(Clock::time_point now) {
    const double passed = seconds_between(measured_, now);
    constexpr double kMeasured = 2;  // long enough for several drawings
    if (passed < kMeasured) return;
    w_.pace.share = w_.pace.busy / passed;
    w_.pace.busy = 0;
    measured_ = now;
  }

  Platform& platform_;
  ImguiHost host_{platform_};
  Workbench w_;
  Picture picture_;
  SplitScreen screen_{platform_.gl(), picture_};
  Vec2i size_{0};
  int frames_wanted_ = kSettlingFrames;
  bool fading_ = false, wait_for_frame_ = false;
  Pacing pacing_;
  Clock::time_point last_ = Clock::now(), measured_ = Clock::now(), touched_ = Clock::now();
};

}  // namespace

int run_viewer(const ViewOptions& options) {
  std::optional<Script> script;
  if (!options.script.empty()) {
    auto read = Script::read(options.script);
    if (!read) return fail(read.error());
    script = std::move(*read);
  }
  // A script must find the same viewer every time.
  const bool remembers = !options.safe && !options.offscreen && !script;
  std::string note;
  Settings settings = remembers ? load_settings(note) : Settings{};
  if (!remembers || settings.recent.empty()) settings.window = {options.width, options.height, false};
  auto platform = options.offscreen ? make_offscreen(options.width, options.height) : make_window(settings.window);
  if (!platform) return fail(platform.error());
  int code = 0;
  {
    Application application(**platform, options);
    if (auto started = application.start(settings, note); !started) return fail(started.error());
    code = application.run(script ? &*script : nullptr);
    if (remembers) save_settings(application.settings());
  }
  return code;
}

}  // namespace etendue::viewer
