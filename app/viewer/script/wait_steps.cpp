// Steps that wait: for samples, for seconds, or for a condition of a panel or the viewport.
#include <algorithm>
#include <chrono>
#include <limits>
#include <nlohmann/json.hpp>

#include "render/session.h"
#include "viewer/files/loader.h"
#include "viewer/panels/registry.h"
#include "viewer/script/step.h"
#include "viewer/state/app_state.h"
#include "viewer/state/editor.h"
#include "viewer/viewport/aov_layer.h"
#include "viewer/viewport/comparison.h"
#include "viewer/viewport/pixel_readout.h"
#include "viewer/viewport/stored_points.h"

namespace etendue::viewer {
namespace {

using Clock = std::chrono::steady_clock;

constexpr double kLongWait = 3600;  // seconds

class WaitForSeconds final : public Step {
 public:
  explicit WaitForSeconds(double seconds) : seconds_(seconds) {}
  StepStatus advance(AppState&) override {
    return {.done = std::chrono::duration<double>(Clock::now() - start_).count() >= seconds_};
  }
  bool needs_frames() const override { return false; }
  double extra_seconds() const override { return kLongWait; }

 private:
  double seconds_;
  Clock::time_point start_ = Clock::now();
};

// Waits until an image with this number of samples per pixel is on screen.
class WaitForSamples final : public Step {
 public:
  explicit WaitForSamples(uint32_t samples) : samples_(samples) {}
  StepStatus advance(AppState& state) override {
    if (state.files.loader->is_busy()) return {};
    const auto status = state.session->status();
    const uint64_t version = state.editor->version();
    const auto& frame = state.viewport.frame;
    if (status.version != version || !frame) return {};
    if (status.samples >= samples_) return {.done = frame->version == version && frame->samples >= samples_};
    const std::string samples = std::to_string(status.samples) + " samples";
    if (state.session->paused()) return impossible("the rendering is paused at " + samples + "; continue it first");
    if (status.finished)
      return impossible("the rendering stops at " + samples + "; increase the limit or wait for fewer samples");
    return {};
  }
  bool needs_frames() const override { return false; }
  double extra_seconds() const override { return kLongWait; }

 private:
  uint32_t samples_;
};

std::vector<WaitCondition> viewport_conditions() {
  const auto comparison = [](AppState& state, std::optional<uint32_t>) -> StepStatus {
    return {.done = !state.viewport.comparison->is_busy()};
  };
  const auto points = [](AppState& state, std::optional<uint32_t>) -> StepStatus {
    if (!state.viewport.show_stored_points)
      return impossible("stored points are searched while they are shown; click view.points first");
    return {.done = state.viewport.stored_points->result() != nullptr};
  };
  const auto aov = [](AppState& state, std::optional<uint32_t>) -> StepStatus {
    if (state.viewport.aov_name.empty()) return impossible("an AOV is computed while it is shown; set view.aov first");
    return {.done = state.shows_aov() && state.viewport.aov->image().version == state.editor->version()};
  };
  const auto pixel_values = [](AppState& state, std::optional<uint32_t>) -> StepStatus {
    if (!state.viewport.show_pixel_values)
      return impossible("pixel values are computed while they are shown; click view.pixel-values first");
    return {.done = state.viewport.pixel_readout->errors() != nullptr};
  };
  const auto limit = [](AppState& state, std::optional<uint32_t>) -> StepStatus {
    const auto status = state.session->status();
    if (!state.document().limits.any()) return impossible("the rendering has no limit; set one first");
    return {.done = status.version == state.editor->version() && status.finished};
  };
  return {{.name = "limit", .check = limit},
          {.name = "comparison", .check = comparison, .needs_frames = true},
          {.name = "points", .check = points},
          {.name = "aov", .check = aov},
          {.name = "pixel-values", .check = pixel_values}};
}

std::vector<WaitCondition> all_conditions(const std::vector<std::unique_ptr<Panel>>& panels) {
  auto conditions = viewport_conditions();
  for (const auto& panel : panels)
    for (auto& condition : panel->wait_conditions()) conditions.push_back(std::move(condition));
  return conditions;
}

std::vector<std::string> condition_names() {
  std::vector<std::string> names;
  for (const auto& condition : all_conditions(make_panels())) names.push_back(condition.name);
  return names;
}

class WaitForCondition final : public Step {
 public:
  explicit WaitForCondition(std::string name, std::optional<uint32_t> samples = {})
      : name_(std::move(name)), samples_(samples) {}

  StepStatus advance(AppState& state) override {
    if (!reaction_.advance()) return {};
    if (!condition_.check) {
      const auto conditions = all_conditions(state.panels.all());
      condition_ = *std::ranges::find(conditions, name_, &WaitCondition::name);
    }
    if (!done_) {
      const StepStatus status = condition_.check(state, samples_);
      done_ = status.done;
      return {.error = status.error};
    }
    return {.done = layout_.advance()};
  }
  bool needs_frames() const override { return !condition_.check || done_ || condition_.needs_frames; }
  double extra_seconds() const override { return kLongWait; }

 private:
  std::string name_;
  std::optional<uint32_t> samples_;
  WaitCondition condition_;
  FrameDelay reaction_{3};  // a task that was requested by the last step is started
  FrameDelay layout_{3};    // tables need some frames for the width of their columns
  bool done_ = false;
};

bool is_sample_count(const nlohmann::json& j) {
  return j.is_number_unsigned() && j.get<uint64_t>() <= std::numeric_limits<uint32_t>::max();
}

}  // namespace

Result<std::unique_ptr<Step>> make_wait_step(const std::string& action, const nlohmann::json& j) {
  if (action != "wait") return std::unique_ptr<Step>();
  const auto result = [](auto step) { return std::unique_ptr<Step>(std::move(step)); };
  for (const char* member : {"spp", "compared"})
    if (j.contains(member) && !is_sample_count(j[member]))
      return usage_error("'" + std::string(member) + "' has to be a number of samples, 0 to 4294967295");
  if (j.contains("spp")) return result(std::make_unique<WaitForSamples>(j["spp"].get<uint32_t>()));
  if (j.contains("compared"))
    return result(std::make_unique<WaitForCondition>("contest", j["compared"].get<uint32_t>()));
  if (!j.contains("for")) return result(std::make_unique<WaitForSeconds>(j.at("seconds").get<double>()));
  const std::string name = j["for"].get<std::string>();
  const auto names = condition_names();
  if (std::ranges::find(names, name) != names.end()) return result(std::make_unique<WaitForCondition>(name));
  std::string list;
  for (const auto& known : names) list += (list.empty() ? "" : ", ") + known;
  return usage_error("cannot wait for '" + name + "'; use one of: " + list);
}

}  // namespace etendue::viewer
