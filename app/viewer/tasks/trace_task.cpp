#include "viewer/tasks/trace_task.h"

#include <nlohmann/json.hpp>

#include "base/file.h"
#include "base/json_text.h"
#include "film/film_image.h"
#include "image/display.h"
#include "image/image.h"
#include "render/session.h"
#include "trace/trace_drawing.h"
#include "trace/trace_json.h"
#include "viewer/files/file_names.h"
#include "viewer/state/editor.h"
#include "viewer/state/notices.h"

namespace etendue::viewer {
namespace {

using ShownPointer = std::shared_ptr<const ShownTrace>;

// The picture as displayed, as a PNG file in memory. Empty if the film has another size.
std::vector<std::byte> picture_of(const film::Film& film, const render::Document& document) {
  if (film.width() != document.width || film.height() != document.height) return {};
  const auto& display = document.display;
  auto png = image::encode_png(film.width(), film.height(),
                               image::display_pixels(film::radiance_of(film), display.exposure, display.curve));
  return png ? std::move(*png) : std::vector<std::byte>();
}

Result<std::string> write(const std::string& file, const render::PixelTrace& trace, const film::Film& film,
                          const render::Document& document) {
  const std::string extension = lower_extension(file);
  std::string text;
  if (extension == ".svg")
    text = trace::path_figure(trace, document.camera, {document.width, document.height}, picture_of(film, document));
  else if (extension == ".json")
    text = json_text(trace::to_json(trace), 2) + "\n";
  else
    return usage_error(file + ": '" + extension + "' is not a format of traces; use .svg or .json");
  if (auto written = write_file(file, text.data(), text.size()); !written) return written.error();
  return file;
}

}  // namespace

std::optional<TraceTask::Input> TraceTask::input(const TaskContext& context) const {
  if (!pixel_ || context.editor.empty()) return std::nullopt;
  const auto& d = context.editor.document();
  if (pixel_->x >= d.width || pixel_->y >= d.height || !render::why_untraceable(d).empty()) return std::nullopt;
  return Input{.version = context.editor.version(), .pixel = *pixel_, .sample = parameters.sample};
}

bool TraceTask::is_current(const TaskContext& context) const {
  const auto wanted = input(context);
  return result_ && wanted && requested_ == wanted && !task_.running();
}

void TraceTask::reset(const TaskContext&) {
  task_.abandon();
  requested_.reset();
  result_.reset();
}

void TraceTask::update(const TaskContext& context) {
  if (auto result = task_.take_result(); result && *result) result_ = std::move(*result);
  if (auto saved = export_.take_result()) {
    if (*saved)
      context.notices.add_message("Saved " + **saved);
    else
      context.notices.add_error(saved->error().message);
  }
  const auto wanted = input(context);
  if (!wanted) return reset(context);
  const auto scene = context.session.scene();
  if (wanted == requested_ || !scene || context.session.status().version != wanted->version) return;
  requested_ = wanted;
  const auto work = [document = context.editor.document(), scene, input = *wanted]() -> ShownPointer {
    auto trace = render::trace_pixel(document, scene, input.pixel, static_cast<uint32_t>(input.sample));
    if (!trace) return nullptr;
    ShownTrace shown{.trace = std::move(*trace), .rows = {}, .segments = {}};
    shown.rows = trace::trace_rows(shown.trace);
    shown.segments = trace::path_segments(shown.trace.record, trace::far_length(*scene));
    return std::make_shared<const ShownTrace>(std::move(shown));
  };
  task_.start(work, context.wake);
}

void TraceTask::save(const TaskContext& context, const std::string& file) {
  if (!result_) return;
  const auto work = [file, shown = result_, &session = context.session, document = context.editor.document()] {
    return write(file, shown->trace, session.film_copy(), document);
  };
  export_.start(work, context.wake);
}

}  // namespace etendue::viewer
