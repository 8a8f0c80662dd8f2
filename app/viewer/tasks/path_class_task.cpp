#include "viewer/tasks/path_class_task.h"

#include <algorithm>

#include "render/session.h"
#include "viewer/state/document_info.h"
#include "viewer/state/editor.h"

namespace etendue::viewer {
namespace {

// Time limit of the measurement after its coarsest classes, seconds.
constexpr double kMeasurementSeconds = 3;

IntegratorCoverage::Found found_part(const advisor::DeclaredPaths& declared, const advisor::ClassTable& table,
                                     const advisor::ClassRow& row) {
  advisor::ClassTable single_row;
  single_row.total = table.total;
  single_row.rows = {row};
  const auto missing = advisor::missing_paths(declared, single_row);
  if (missing.none()) return IntegratorCoverage::Found::all;
  const auto& missing_class = missing.classes.front();
  const bool in_part = missing_class.partial || missing_class.from_point_lights;
  return in_part ? IntegratorCoverage::Found::part : IntegratorCoverage::Found::none;
}

}  // namespace

void PathClassTask::start(const TaskContext& context) {
  if (context.editor.empty()) return;
  started_ = true;
  document_ = context.editor.document();
  document_.method.paths.clear();
  // One thread is left to the main rendering.
  const int all = context.threads > 0 ? context.threads : static_cast<int>(std::thread::hardware_concurrency());
  const auto work = [document = document_, threads = std::max(1, all - 1), scene = context.session.scene()](
                        const auto& publish, const bench::Progress& progress) {
    render::Session session({.threads = threads, .scene = scene});
    advisor::TableOptions options;
    options.seconds = kMeasurementSeconds;
    advisor::class_table(session, document, options, progress, [&](const advisor::ClassTable& table) {
      publish({table, advisor::beyond_all_methods(*session.scene())});
    });
  };
  task_.start(work, context.wake);
}

void PathClassTask::update(const TaskContext& context, bool start_if_new) {
  task_.update();
  if (task_.running() && !same_view(context.editor.document(), document_)) task_.cancel();
  if (start_if_new && !started_) start(context);
}

void PathClassTask::reset(const TaskContext&) {
  task_.reset();
  started_ = false;
}

bool PathClassTask::is_current(const render::Document& document) const {
  return result() && same_view(document, document_);
}

const IntegratorCoverage& PathClassTask::coverage(const TaskContext& context) {
  const auto& method = context.editor.document().method;
  const auto status = context.session.status();
  const bool incompatible = status.version == context.editor.version() && !status.incompatibility.empty();
  if (task_.result() == covered_table_ && method == covered_method_ && incompatible == covered_incompatible_)
    return coverage_;
  covered_table_ = task_.result();
  covered_method_ = method;
  covered_incompatible_ = incompatible;
  coverage_ = {};
  const auto declared = incompatible ? advisor::DeclaredPaths() : advisor::declared_paths(method, context.session.scene().get());
  const auto& table = covered_table_->table;
  for (const auto& row : table.rows) coverage_.rows.push_back(found_part(declared, table, row));
  coverage_.missing_paths = advisor::missing_paths(declared, table);
  return coverage_;
}

}  // namespace etendue::viewer
