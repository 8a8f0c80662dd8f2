#include "viewer/tasks/path_class_task.h"

#include <algorithm>

#include "viewer/tasks/convergence_task.h"

namespace etendue::viewer {
namespace {

constexpr double kSeconds = 3;  // that a table may take, besides its coarsest classes

MethodView::Finds finds(const advisor::Found& found, const advisor::ClassTable& table, const advisor::ClassRow& row) {
  advisor::ClassTable alone;
  alone.total = table.total, alone.rows = {row};
  const auto misses = advisor::missing_paths(found, alone);
  if (misses.none()) return MethodView::Finds::all;
  const auto& spot = misses.classes.front();
  return spot.part || spot.points ? MethodView::Finds::part : MethodView::Finds::nothing;
}

}  // namespace

void PathsHand::measure() {
  if (editor_.empty()) return;
  begun_ = true;
  document_ = editor_.document();
  document_.method.paths.clear();
  // One is left to the picture.
  const int all = threads_ > 0 ? threads_ : static_cast<int>(std::thread::hardware_concurrency());
  study_.start([document = document_, threads = std::max(1, all - 1), scene = session_.scene()](
                   const auto& publish, const bench::Progress& watch) {
    render::Session session({.threads = threads, .scene = scene});
    advisor::TableOptions options;
    options.seconds = kSeconds;
    advisor::class_table(session, document, options, watch, [&](const advisor::ClassTable& table) {
      publish({table, advisor::beyond_all_methods(*session.scene())});
    });
  });
}

bool PathsHand::fresh() const { return shown() && same_view(editor_.document(), document_); }

void PathsHand::advance(bool looked_at) {
  study_.advance();
  if (running() && !same_view(editor_.document(), document_)) study_.call_off();
  if (looked_at && !begun_) measure();
}

const MethodView& PathsHand::seen() {
  const auto& method = editor_.document().method;
  const auto status = session_.status();
  const bool hindered = status.version == editor_.version() && !status.incompatibility.empty();
  if (study_.shown() == seen_table_ && method == seen_method_ && hindered == seen_hindered_) return seen_;
  seen_table_ = study_.shown(), seen_method_ = method, seen_hindered_ = hindered;
  seen_ = {};
  const auto found = hindered ? advisor::Found() : advisor::declared(method);
  const auto& table = seen_table_->table;
  for (const auto& row : table.rows) seen_.rows.push_back(finds(found, table, row));
  seen_.misses = advisor::missing_paths(found, table);
  return seen_;
}

}  // namespace etendue::viewer
