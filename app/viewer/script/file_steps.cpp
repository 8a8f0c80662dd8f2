// Steps that read and write files: open, screenshot, image, state and follow.
#include <chrono>
#include <limits>
#include <nlohmann/json.hpp>

#include "base/file.h"
#include "base/json_text.h"
#include "image/image.h"
#include "render/display_frame.h"
#include "viewer/files/image_export.h"
#include "viewer/files/loader.h"
#include "viewer/platform/platform.h"
#include "viewer/script/state_report.h"
#include "viewer/script/step.h"
#include "viewer/state/app_state.h"
#include "viewer/state/editor.h"
#include "viewer/viewport/image_view.h"

namespace etendue::viewer {
namespace {

StepStatus status_of(const Result<void>& written) {
  if (!written) return impossible(written.error().message);
  return {.done = true};
}

// Drops a file on the window and waits until it is on screen.
class OpenStep final : public Step {
 public:
  explicit OpenStep(std::string file) : file_(std::move(file)) {}

  StepStatus advance(AppState& state) override {
    const Loader& loader = *state.files.loader;
    if (!dropped_) {
      state.notices.take_error();
      // A script discards unsaved edits without a question.
      if (state.has_document()) state.editor->mark_scene_saved(state.document().scene);
      state.platform.events().push({.type = Event::Type::drop, .file = file_});
      dropped_ = true;
      return {};
    }
    if (!started_) {
      started_ = loader.is_busy() || loader.file() == file_;
      return {};
    }
    if (loader.is_busy()) return {};
    if (const std::string error = state.notices.take_error(); !error.empty()) return impossible(error);
    const auto& frame = state.viewport.frame;
    return {.done = frame && frame->version == state.editor->version()};
  }

 private:
  std::string file_;
  bool dropped_ = false;
  bool started_ = false;
};

class ScreenshotStep final : public Step {
 public:
  explicit ScreenshotStep(std::string file) : file_(std::move(file)) {}

  StepStatus advance(AppState& state) override {
    if (!reaction_.advance()) return {};
    const Platform& platform = state.platform;
    const Vec2i size = platform.size();
    return status_of(image::write_png(file_, size.x, size.y, read_pixels(platform.gl(), platform.framebuffer(), size)));
  }

 private:
  std::string file_;
  FrameDelay reaction_{3};
};

class SaveImageStep final : public Step {
 public:
  explicit SaveImageStep(std::string file) : file_(std::move(file)) {}

  StepStatus advance(AppState& state) override {
    if (!requested_) {
      state.notices.take_error();
      state.files.image_export->request(file_);
      requested_ = true;
      return {};
    }
    if (state.files.image_export->is_busy()) return {};
    if (const std::string error = state.notices.take_error(); !error.empty()) return impossible(error);
    return {.done = true};
  }
  bool needs_frames() const override { return false; }

 private:
  std::string file_;
  bool requested_ = false;
};

class SaveStateStep final : public Step {
 public:
  explicit SaveStateStep(std::string file) : file_(std::move(file)) {}

  StepStatus advance(AppState& state) override {
    const std::string text = state_report(state);
    return status_of(write_file(file_, text.data(), text.size()));
  }

 private:
  std::string file_;
};

// Writes the state again and again, for a program that controls the window.
class FollowStep final : public Step {
 public:
  explicit FollowStep(std::string file) : file_(std::move(file)) {}

  StepStatus advance(AppState& state) override {
    const uint64_t frames = state.ui.items.frames();
    if (!state.platform.events().empty()) event_frame_ = frames;
    const auto now = Clock::now();
    if (now - last_write_ < kInterval) return {};
    last_write_ = now;
    nlohmann::json report = nlohmann::json::parse(state_report(state));
    report["enabled_actions"] = nlohmann::json::array();
    for (const Action& action : state.actions.all())
      if (action.is_enabled(state)) report["enabled_actions"].push_back(action.name);
    report["count"] = ++count_;
    report["settled"] = frames >= event_frame_ + kFramesPerEvent;
    const std::string text = json_text(report);
    const auto written = write_file(file_, text.data(), text.size());
    return written ? StepStatus{} : impossible(written.error().message);
  }
  bool needs_frames() const override { return false; }
  double extra_seconds() const override { return std::numeric_limits<double>::infinity(); }

 private:
  using Clock = std::chrono::steady_clock;
  static constexpr std::chrono::milliseconds kInterval{50};

  // The main loop draws as many frames after an event.
  static constexpr uint64_t kFramesPerEvent = 3;

  std::string file_;
  int count_ = 0;
  uint64_t event_frame_ = 0;  // in which there were events
  Clock::time_point last_write_{};
};

}  // namespace

Result<std::unique_ptr<Step>> make_file_step(const std::string& action, const nlohmann::json& j) {
  const auto result = [](auto step) { return std::unique_ptr<Step>(std::move(step)); };
  const auto file = [&] { return j.at("file").get<std::string>(); };
  if (action == "open") return result(std::make_unique<OpenStep>(file()));
  if (action == "screenshot") return result(std::make_unique<ScreenshotStep>(file()));
  if (action == "image") return result(std::make_unique<SaveImageStep>(file()));
  if (action == "follow") return result(std::make_unique<FollowStep>(file()));
  if (action == "state") return result(std::make_unique<SaveStateStep>(file()));
  return std::unique_ptr<Step>();
}

}  // namespace etendue::viewer
