// The main loop: waits for events, updates the state, and draws when something visible has changed.
#include "viewer/viewer.h"

#define GLFW_INCLUDE_NONE
#include <GLFW/glfw3.h>

#include <chrono>
#include <cmath>
#include <cstdio>
#include <optional>

#include "render/clock.h"
#include "render/session.h"
#include "viewer/actions/all_actions.h"
#include "viewer/frame_update.h"
#include "viewer/layout/interface.h"
#include "viewer/panels/registry.h"
#include "viewer/platform/imgui_host.h"
#include "viewer/platform/pacing.h"
#include "viewer/platform/platform.h"
#include "viewer/platform/process_age.h"
#include "viewer/script/script.h"
#include "viewer/state/app_state.h"
#include "viewer/state/editor.h"
#include "viewer/viewport/comparison.h"
#include "viewer/viewport/comparison_view.h"
#include "viewer/viewport/stored_picture_view.h"
#include "viewer/widgets/basic_widgets.h"

namespace etendue::viewer {
namespace {

using Clock = render::Clock;

// Dear ImGui needs some frames until the layout has adapted to an event.
constexpr int kFramesPerEvent = 3;
constexpr float kMaxOffscreenFrame = 0.05f;  // seconds
// The share of the time that the interface takes is measured over this many seconds.
constexpr double kShareInterval = 2;

int report(const Error& error) {
  std::fprintf(stderr, "etendue: %s\n", error.message.c_str());
  return static_cast<int>(error.fault);
}

// Scripts and off-screen runs do not depend on earlier runs, unless a folder for settings is given.
bool keeps_settings(const ViewOptions& options) {
  return !options.settings.empty() || (!options.safe && !options.offscreen && options.script.empty());
}

class Application {
 public:
  Application(Platform& platform, const ViewOptions& options)
      : platform_(platform), state_(platform, options), live_image_(platform.gl()) {}

  Result<void> start(const Settings& settings, const std::string& note) {
    if (auto started = host_.start(); !started) return started;
    if (auto started = live_image_.start(); !started) return started;
    state_.settings = settings;
    for (const std::string& file : settings.recent) state_.ui.glyphs.add(file);
    state_.ui.glyphs.take_change();
    update_style();
    state_.panels = PanelSet(make_panels());
    add_all_actions(state_.actions, state_.panels);
    for (const auto& [action, shortcut] : settings.shortcuts) state_.actions.set_shortcut(action, shortcut);
    if (!note.empty()) state_.notices.add_message(note);
    if (keeps_settings(state_.options)) {
      state_.files.settings = settings_file(state_.options.settings);
      state_.files.journal = std::make_unique<EditJournal>(recovery_folder(state_.options.settings));
      state_.files.lost_sessions = state_.files.journal->lost_sessions();
    }
    return {};
  }

  int run(Script* script) {
    // The first frame determines the size of the viewport, which the scene needs.
    draw();
    state_.open_file(state_.options.scene.empty() ? "cornell" : state_.options.scene);
    state_.interface.welcome_open = state_.options.scene.empty() && !script && state_.settings.show_welcome;
    last_draw_ = Clock::now();
    share_start_ = last_draw_;
    while (!state_.quit || state_.stays_open) {
      platform_.wait(max_wait(script));
      step(script);
      if (platform_.take_close_request()) quit_after_unsaved_edits();
      if (script && script->ended()) break;
    }
    return script ? script->exit_code() : 0;
  }

  void store_settings() { state_.store_settings(); }

 private:
  void quit_after_unsaved_edits() {
    state_.after_unsaved_edits([](AppState& state) { state.quit = true; });
    request_frames(kFramesPerEvent);
  }

  void update_style() {
    const Settings& settings = state_.settings;
    UiContext& ui = state_.ui;
    ui.scale = settings.ui_scale > 0 ? settings.ui_scale : platform_.scale();
    ui.theme = apply_theme(settings.dark, ui.scale);
    ui.fonts = load_fonts(std::round(settings.font_size * ui.scale), ui.glyphs);
    state_.interface.style_is_outdated = false;
    request_frames(kFramesPerEvent);
  }

  // Whether the view or the time changes without further events.
  bool is_moving() const {
    return state_.ui.input.buttons[static_cast<size_t>(Button::right)] || state_.viewport.playback.is_playing;
  }

  // Seconds to wait for an event.
  double max_wait(const Script* script) const {
    const bool has_input = !platform_.events().empty();
    if (frames_left_ > 0 || has_input || (script && script->is_in_progress())) return 0;
    if (is_moving()) return 0.01;
    if (state_.ui.pointer_rest < kTooltipDelay || state_.viewport.comparison->waits_for_shift()) return 0.05;
    if (is_file_active(state_)) return 0.05;
    if (script || notices_fade_ || image_waits_ || !state_.ui.items.pointed_out().empty()) return 0.02;
    if (!state_.has_document()) return 0.5;
    const auto phase = state_.session->status().phase;
    return phase == "done" || phase == "paused" ? 1.0 : 0.1;
  }

  void request_frames(int count) { frames_left_ = std::max(frames_left_, count); }

  // Handles events, and draws a frame if that is due.
  void step(Script* script) {
    const auto now = Clock::now();
    if (script) script->advance(state_);
    take_events(now);
    const bool drawing_is_due = frames_left_ > 0 || new_content_is_due(now) || is_file_active(state_) || is_moving() ||
                                (script && script->needs_frame());
    if (drawing_is_due) draw();
    if (state_.files.journal) update_journal(*state_.files.journal);
    update_interface_share(Clock::now());  // after drawing, so that the share is at most 1
  }

  void update_journal(EditJournal& journal) {
    journal.update(*state_.editor);
    if (const auto problem = journal.take_problem()) {
      state_.notices.add_message("Unsaved edits cannot be recovered after a crash: " + *problem);
      request_frames(kFramesPerEvent);
    }
  }

  void take_events(Clock::time_point now) {
    Input& input = state_.ui.input;
    if (platform_.events().take_frame(input)) {
      request_frames(kFramesPerEvent);
      last_event_ = now;
    }
    // One more frame is drawn when tooltips appear.
    const double rest = render::seconds_between(last_event_, now);
    if (state_.ui.pointer_rest < kTooltipDelay && rest >= kTooltipDelay) request_frames(1);
    state_.ui.pointer_rest = rest;
    if (const Vec2i size = platform_.size(); size != size_) {
      size_ = size;
      request_frames(kFramesPerEvent);
    }
    for (const unsigned character : input.text) state_.ui.glyphs.add(character);
    if (input.control() && input.keys_pressed.test(GLFW_KEY_V)) state_.ui.glyphs.add(platform_.clipboard());
    for (const auto& file : input.dropped) state_.open_file(file);
    if (state_.viewport.comparison->update_shift(input, state_.interface.typing, now)) request_frames(1);
  }

  // Whether a new image, a result of a task, or the status bar should be drawn now. The interval depends on the time
  // that drawing takes.
  bool new_content_is_due(Clock::time_point now) {
    const double since_draw = render::seconds_between(last_draw_, now);
    const auto& shown = state_.viewport.frame;
    const auto latest = state_.session->frame();
    const bool is_new = latest && latest != shown;
    const bool is_urgent =
        is_new && (!shown || latest->version != shown->version || latest->preview_scale != shown->preview_scale);
    const bool image_is_due = is_new && since_draw >= pacing_.interval(latest->samples);
    const bool has_result = has_task_update(state_);
    const bool result_is_due = has_result && since_draw >= pacing_.interval(0);
    image_waits_ = (is_new && !is_urgent && !image_is_due) || (has_result && !result_is_due) ||
                   has_waiting_task(state_);
    const double status_interval = state_.session->status().phase_progress > 0 ? 0.25 : 1;
    return is_urgent || image_is_due || result_is_due || since_draw >= status_interval;
  }

  void draw() {
    const auto start = Clock::now();
    const auto seconds = static_cast<float>(render::seconds_between(last_draw_, start));
    last_draw_ = start;
    update_state(state_, live_image_);
    if (state_.interface.style_is_outdated || state_.ui.glyphs.take_change()) update_style();
    notices_fade_ = state_.notices.advance(state_.interface.dialog_open ? 0 : static_cast<double>(seconds));
    // Off-screen, a slow frame must not separate the two clicks of a double click.
    host_.begin_frame(state_.ui.input, platform_.has_display() ? seconds : std::min(seconds, kMaxOffscreenFrame));
    interface_.draw(state_, seconds);
    draw_window();
    if (state_.viewport.stored_picture && state_.timing.loading_picture_seconds == 0)
      state_.timing.loading_picture_seconds = process_age();
    if (state_.viewport.frame && state_.timing.first_image_seconds == 0)
      state_.timing.first_image_seconds = process_age();
    if (frames_left_ > 0) --frames_left_;
    read_new_messages();
    if (state_.ui.glyphs.has_change()) request_frames(kFramesPerEvent);
    clear_frame_input();
    const double took = render::seconds_between(start, Clock::now());
    pacing_.add_redraw(took);
    interface_seconds_ += took;
  }

  // Messages may contain characters that the fonts do not have yet.
  void read_new_messages() {
    const auto& log = state_.notices.log();
    for (size_t i = std::min(messages_read_, log.size()); i < log.size(); ++i) state_.ui.glyphs.add(log[i].text);
    messages_read_ = log.size();
  }

  void draw_window() {
    const Gl& gl = platform_.gl();
    gl.BindFramebuffer(GL_FRAMEBUFFER, platform_.framebuffer());
    gl.Viewport(0, 0, size_.x, size_.y);
    gl.Disable(GL_SCISSOR_TEST);
    const ImVec4& background = state_.ui.theme.background;
    gl.ClearColor(background.x, background.y, background.z, 1);
    gl.Clear(GL_COLOR_BUFFER_BIT);
    if (state_.viewport.stored_picture)
      stored_picture_view_.draw(state_, platform_.framebuffer(), size_);
    else if (state_.has_document() && state_.viewport.frame)
      comparison_view_.draw(state_, platform_.framebuffer(), size_);
    gl.Viewport(0, 0, size_.x, size_.y);
    host_.end_frame();
    platform_.present();
  }

  // Presses, characters and dropped files are handled in one frame only.
  void clear_frame_input() {
    Input& input = state_.ui.input;
    input.pressed = {};
    input.keys_pressed.reset();
    input.wheel = 0;
    input.text.clear();
    input.dropped.clear();
  }

  void update_interface_share(Clock::time_point now) {
    const double elapsed = render::seconds_between(share_start_, now);
    if (elapsed < kShareInterval) return;
    state_.timing.interface_share = interface_seconds_ / elapsed;
    interface_seconds_ = 0;
    share_start_ = now;
  }

  Platform& platform_;
  ImguiHost host_{platform_};
  AppState state_;
  ImageView live_image_;
  StoredPictureView stored_picture_view_{platform_.gl()};
  ComparisonView comparison_view_{platform_.gl(), live_image_};
  Interface interface_;
  Vec2i size_{0};
  Pacing pacing_;
  int frames_left_ = kFramesPerEvent;  // to draw in any case
  size_t messages_read_ = 0;           // of the log
  bool notices_fade_ = false;
  bool image_waits_ = false;  // a new image or result will be drawn after the interval
  double interface_seconds_ = 0;
  Clock::time_point last_draw_ = Clock::now();
  Clock::time_point share_start_ = Clock::now();
  Clock::time_point last_event_ = Clock::now();
};

}  // namespace

int run_viewer(const ViewOptions& options) {
  std::optional<Script> script;
  if (!options.script.empty()) {
    auto read = Script::read(options.script);
    if (!read) return report(read.error());
    script = std::move(*read);
  }
  std::string note;
  Settings settings = keeps_settings(options) ? load_settings(settings_file(options.settings), note) : Settings{};
  if (!keeps_settings(options) || settings.recent.empty())
    settings.window = {.width = options.width, .height = options.height, .maximised = false};
  auto platform = options.offscreen ? make_offscreen(options.width, options.height) : make_window(settings.window);
  if (!platform) return report(platform.error());
  ViewOptions used = options;
  if (used.threads == 0) used.threads = settings.threads;
  Application application(**platform, used);
  if (auto started = application.start(settings, note); !started) return report(started.error());
  const int code = application.run(script ? &*script : nullptr);
  application.store_settings();
  return code;
}

}  // namespace etendue::viewer
