#include "viewer/tasks/automatic_task.h"

#include "render/session.h"
#include "viewer/state/document_info.h"
#include "viewer/state/editor.h"
#include "viewer/state/notices.h"
#include "viewer/tasks/exclusive_task.h"

namespace etendue::viewer {
namespace {

// Seconds after an edit in which the image is rendered with the present integrator.
constexpr double kRest = 1;
// Time for the choice.
constexpr double kChoiceSeconds = 2;

// Whether a choice for one document holds for the other.
bool same_choice_request(const render::Document& a, const render::Document& b) {
  return same_view(a, b) && a.method == b.method && a.automatic.enabled == b.automatic.enabled &&
         a.automatic.allow == b.automatic.allow && a.automatic.error == b.automatic.error;
}

}  // namespace

void AutomaticTask::update(const TaskContext& context) {
  const bool has_finished = task_.update();
  if (has_finished) context.exclusive.end();
  const render::Document& document = context.editor.document();
  if (task_.running() && !(examined_ && same_choice_request(*examined_, document))) cancel(context);
  if (has_finished && task_.result()) finish(context);
  if (!document.automatic.enabled) examined_.reset();
  const bool is_new = document.automatic.is_pending() && !(examined_ && same_choice_request(*examined_, document));
  const bool has_rested = image_rests(context);
  if (is_new && has_rested && !task_.running() && !context.exclusive.running() && !context.session.paused())
    start(context);
}

bool AutomaticTask::image_rests(const TaskContext& context) {
  if (context.editor.version() != edited_version_) {
    edited_version_ = context.editor.version();
    edit_time_ = Clock::now();
  }
  const auto frame = context.session.frame();
  const bool shows_document = frame && frame->version == edited_version_ && frame->samples > 0;
  return shows_document && std::chrono::duration<double>(Clock::now() - edit_time_).count() > kRest;
}

void AutomaticTask::start(const TaskContext& context) {
  examined_ = context.editor.document();
  context.exclusive.begin({.status = "choosing the integrator",
                           .measures_path_classes = false,
                           .cancel = [this, context] { cancel(context); }});
  const auto work = [document = *examined_, threads = context.threads, scene = context.session.scene()](
                        const auto& publish, const bench::Progress& progress) {
    render::Session session({.threads = threads, .scene = scene});
    publish(advisor::choose_method(session, document, progress, {.seconds = kChoiceSeconds}));
  };
  task_.start(work, context.wake);
}

void AutomaticTask::finish(const TaskContext& context) {
  const Result<advisor::MethodChoice>& result = *task_.result();
  if (!result) return context.notices.add_error(result.error().message);
  const render::Document& document = context.editor.document();
  if (result->interrupted || !same_choice_request(*examined_, document)) return;
  choice_ = *result;
  render::Document changed = advisor::with_choice(document, *choice_);
  examined_ = document;
  context.editor.apply(std::move(changed), "Automatic integrator");
  context.notices.add_message("Integrator chosen automatically: " + choice_->reason + ".", "tab.render");
}

void AutomaticTask::repeat(const TaskContext& context) {
  cancel(context);
  examined_.reset();
  render::Document changed = context.editor.document();
  changed.automatic.enabled = true;
  changed.automatic.reason.clear();
  context.editor.amend(std::move(changed));
}

void AutomaticTask::cancel(const TaskContext& context) {
  if (!running()) return;
  task_.cancel();
  context.exclusive.end();
}

void AutomaticTask::reset(const TaskContext& context) {
  cancel(context);
  task_.reset();
  examined_.reset();
  choice_.reset();
}

}  // namespace etendue::viewer
