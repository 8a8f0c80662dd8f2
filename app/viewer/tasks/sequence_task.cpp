#include "viewer/tasks/sequence_task.h"

#include <chrono>
#include <filesystem>
#include <thread>

#include "render/image_output.h"
#include "render/session.h"
#include "viewer/files/file_names.h"
#include "viewer/files/image_export.h"
#include "viewer/state/editor.h"
#include "viewer/state/notices.h"
#include "viewer/tasks/exclusive_task.h"
#include "viewer/widgets/value_text.h"

namespace etendue::viewer {
namespace {

using Work = ProgressiveTask<SequenceProgress>;
using SequenceClock = std::chrono::steady_clock;

constexpr auto kProgressInterval = std::chrono::milliseconds(10);

// Renders a document. Returns false if that was cancelled. `report` gets the share of the image that is complete.
template <class Report>
bool render_image(render::Session& session, const render::Document& document, const Report& report) {
  const uint64_t version = session.submit(document);
  while (true) {
    const render::Status status = session.status();
    const bool is_current = status.version == version;
    if (!report(is_current ? status.progress : 0)) return false;
    if (is_current && status.finished) return true;
    std::this_thread::sleep_for(kProgressInterval);
  }
}

// The first file of the sequence that exists; empty if none does.
std::string existing_file(const SequenceRequest& request) {
  std::error_code code;
  for (uint32_t frame = request.plan.frames.first; frame < request.plan.frames.end; ++frame)
    if (std::string file = render::frame_file(request.pattern, frame); std::filesystem::exists(file, code)) return file;
  return "";
}

void render_sequence(const render::Document& document, const SequenceRequest& request, int threads,
                     const Work::Publisher& publish, const bench::Progress& report) {
  const auto start = SequenceClock::now();
  const render::ImageSequence sequence(document, request.plan);
  const render::FrameRange range = sequence.range();
  SequenceProgress progress;
  progress.count = range.count();
  render::Session session({.threads = threads});
  const auto fail = [&](const Error& error) {
    progress.error = error.message;
    publish(progress);
  };
  publish(progress);
  if (!request.replaces)
    if (const std::string file = existing_file(request); !file.empty())
      return fail(usage_error(file + " exists; choose another name, or select Replace files"));
  for (uint32_t frame = range.first; frame < range.end; ++frame) {
    auto shown = sequence.at(frame);
    if (!shown) return fail(shown.error());
    shown->limits = {.samples = static_cast<uint32_t>(request.samples), .measure = document.limits.measure};
    const auto report_image = [&](double share) { return report((progress.done + share) / progress.count, ""); };
    if (!render_image(session, *shown, report_image)) return;
    const std::string file = render::frame_file(request.pattern, frame);
    if (auto written = write_image_of(session, *shown, file); !written) return fail(written.error());
    progress.file = file;
    progress.seconds = std::chrono::duration<double>(SequenceClock::now() - start).count();
    ++progress.done;
    publish(progress);
  }
}

}  // namespace

Result<void> SequenceTask::start(const TaskContext& context, const SequenceRequest& request) {
  stop(context);
  const std::string first = render::frame_file(request.pattern, request.plan.frames.first);
  if (auto known = render::check_output_name(first); !known) return known;
  context.exclusive.begin({.status = "rendering images", .cancel = [this, context] { stop(context); }});
  task_.start(
      [document = context.editor.document(), request, threads = context.threads](const Work::Publisher& publish,
                                                                                 const bench::Progress& report) {
        render_sequence(document, request, threads, publish, report);
      },
      context.wake);
  return {};
}

void SequenceTask::stop(const TaskContext& context) {
  if (!running()) return;
  task_.cancel();
  context.exclusive.end();
}

void SequenceTask::update(const TaskContext& context) {
  if (!task_.update()) return;
  context.exclusive.end();
  finish(context);
}

void SequenceTask::finish(const TaskContext& context) {
  const SequenceProgress* last = progress();
  if (!last) return;
  if (!last->error.empty()) return context.notices.add_error(last->error);
  context.notices.add_message(formatted("Saved %u images, the last one is %s", last->done, last->file.c_str()));
}

}  // namespace etendue::viewer
