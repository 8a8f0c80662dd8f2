#include "viewer/script/script.h"

#include <cstdio>
#include <nlohmann/json.hpp>

#include "base/file.h"
#include "viewer/layout/interface.h"
#include "viewer/script/steps.h"

namespace etendue::viewer {
namespace {

using Clock = std::chrono::steady_clock;

// A step that has made no headway for so long is given up.
constexpr double kPatience = 120;

}  // namespace

struct Script::Impl {
  std::string file;
  nlohmann::json steps;
  size_t next = 0;
  std::unique_ptr<Step> step;
  Clock::time_point started = Clock::now();
  int code = 0;
  bool failed = false;

  void fail(const std::string& what) {
    std::fprintf(stderr, "etendue: %s: step %zu %s: %s\n", file.c_str(), next, steps[next - 1].dump().c_str(),
                 what.c_str());
    failed = true;
    code = 1;
  }
};

Script::Script(std::unique_ptr<Impl> impl) : impl_(std::move(impl)) {}
Script::Script(Script&&) noexcept = default;
Script& Script::operator=(Script&&) noexcept = default;
Script::~Script() = default;

Result<Script> Script::read(const std::string& file) {
  const auto bytes = read_file(file);
  if (!bytes) return bytes.error();
  const auto* text = reinterpret_cast<const char*>(bytes->data());
  auto steps = nlohmann::json::parse(text, text + bytes->size(), nullptr, false);
  if (!steps.is_array()) return input_error(file + ": is no script; give a JSON array of steps");
  auto impl = std::make_unique<Impl>();
  impl->file = file;
  for (size_t i = 0; i < steps.size(); ++i)
    if (auto checked = make_step(steps[i]); !checked)
      return input_error(file + ": step " + std::to_string(i + 1) + ": " + checked.error().message);
  impl->steps = std::move(steps);
  return Script(std::move(impl));
}

void Script::advance(Workbench& w, Picture& picture) {
  Impl& s = *impl_;
  // Nothing begins before there is a scene, a picture of it and a place for it.
  if (s.next == 0 && !s.step) {
    const std::string error = w.notices.take_error();
    if (w.editor.empty() && !w.loader.busy() && !error.empty()) {
      std::fprintf(stderr, "etendue: %s\n", error.c_str());
      s.failed = true;
      s.code = static_cast<int>(Fault::input);
      return;
    }
    if (w.editor.empty() || !w.frame || w.frame->version != w.editor.version()) return;
  }
  if (ended()) return;
  if (!s.step) {
    s.step = std::move(*make_step(s.steps[s.next]));
    ++s.next;
    s.started = Clock::now();
  }
  const Progress progress = s.step->advance(w, picture);
  if (!progress.error.empty()) return s.fail(progress.error);
  if (progress.done) {
    s.step.reset();
    return;
  }
  if (std::chrono::duration<double>(Clock::now() - s.started).count() > kPatience + s.step->patience())
    s.fail("it was not done in " + std::to_string(static_cast<int>(kPatience)) + " s");
}

bool Script::ended() const { return impl_->failed || (!impl_->step && impl_->next >= impl_->steps.size()); }
int Script::exit_code() const { return impl_->code; }
bool Script::in_a_hurry() const { return impl_->step ? impl_->step->hurries() : impl_->next > 0; }
bool Script::wants_frame() const { return impl_->step && impl_->step->hurries(); }

}  // namespace etendue::viewer
