#include "viewer/script/script.h"

#include <chrono>
#include <cstdio>
#include <nlohmann/json.hpp>

#include "base/file.h"
#include "base/json_nesting.h"
#include "render/display_frame.h"
#include "viewer/files/file_edits.h"
#include "viewer/files/loader.h"
#include "viewer/script/step.h"
#include "viewer/state/app_state.h"
#include "viewer/state/editor.h"
#include "viewer/widgets/value_text.h"

namespace etendue::viewer {
namespace {

using Clock = std::chrono::steady_clock;

constexpr double kTimeLimit = 120;  // seconds per step
constexpr int kMaxNesting = 16;     // steps need three levels; recursive functions print them

}  // namespace

struct Script::Impl {
  std::string file;
  nlohmann::json steps;
  size_t next = 0;  // index of the step after the current one
  std::unique_ptr<Step> step;
  Clock::time_point step_start = Clock::now();
  int code = 0;
  bool failed = false;

  void fail(const std::string& reason) {
    std::fprintf(stderr, "etendue: %s: step %zu %s: %s\n", file.c_str(), next, steps[next - 1].dump().c_str(),
                 reason.c_str());
    failed = true;
    code = 1;
  }

  // Whether the scene is open and on screen. If it cannot be opened, the script fails.
  bool scene_is_shown(AppState& state) {
    const std::string error = state.notices.take_error();
    if (!state.has_document() && !state.files.loader->is_busy() && !error.empty()) {
      std::fprintf(stderr, "etendue: %s\n", error.c_str());
      failed = true;
      code = static_cast<int>(Fault::input);
      return false;
    }
    const auto& frame = state.viewport.frame;
    return state.has_document() && frame && frame->version == state.editor->version();
  }
};

Script::Script(std::unique_ptr<Impl> impl) : impl_(std::move(impl)) {}
Script::Script(Script&&) noexcept = default;
Script& Script::operator=(Script&&) noexcept = default;
Script::~Script() = default;

Result<Script> Script::read(const std::string& file) {
  const auto bytes = read_file(file);
  if (!bytes) return bytes.error();
  const std::string_view text(reinterpret_cast<const char*>(bytes->data()), bytes->size());
  if (json_nesting(text) > kMaxNesting)
    return input_error(formatted("%s: is nested more than %d levels deep", file.c_str(), kMaxNesting));
  auto steps = nlohmann::json::parse(text, nullptr, false);
  if (!steps.is_array()) return input_error(file + ": is not a script; a script is a JSON array of steps");
  for (size_t i = 0; i < steps.size(); ++i)
    if (auto checked = make_step(steps[i]); !checked)
      return input_error(formatted("%s: step %zu: ", file.c_str(), i + 1) + checked.error().message);
  auto impl = std::make_unique<Impl>();
  impl->file = file;
  impl->steps = std::move(steps);
  return Script(std::move(impl));
}

void Script::advance(AppState& state) {
  Impl& s = *impl_;
  if (s.next == 0 && !s.step && !s.scene_is_shown(state)) return;
  if (ended()) return;
  // The next step may refer to a texture that the last one has loaded, or to a material that it has saved.
  if (!s.step && (state.files.edits->is_busy() || state.files.material_save.running())) return;
  if (!s.step) {
    s.step = std::move(*make_step(s.steps[s.next]));
    ++s.next;
    s.step_start = Clock::now();
  }
  const StepStatus status = s.step->advance(state);
  if (!status.error.empty()) return s.fail(status.error);
  if (status.done) {
    s.step.reset();
    return;
  }
  const double elapsed = std::chrono::duration<double>(Clock::now() - s.step_start).count();
  const double limit = kTimeLimit + s.step->extra_seconds();
  if (elapsed > limit) s.fail(formatted("the step was not done within %.0f s", limit));
}

bool Script::ended() const { return impl_->failed || (!impl_->step && impl_->next >= impl_->steps.size()); }
int Script::exit_code() const { return impl_->code; }
bool Script::is_in_progress() const { return impl_->step ? impl_->step->needs_frames() : impl_->next > 0; }
bool Script::needs_frame() const { return impl_->step && impl_->step->needs_frames(); }

}  // namespace etendue::viewer
