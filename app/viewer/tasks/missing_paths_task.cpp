#include "viewer/tasks/missing_paths_task.h"

#include <algorithm>

#include "viewer/tasks/convergence_task.h"

namespace etendue::viewer {
namespace {

// The picture has the processor to itself for so long after an edit.
constexpr double kRest = 0.8;
// That the measurement may take, besides its coarsest classes.
constexpr double kSeconds = 0.5;
constexpr size_t kMostKnown = 64;

bool same_question(const render::Document& a, const render::Document& b) {
  return same_view(a, b) && a.method == b.method;
}

}  // namespace

const advisor::MissingPaths* BlindSpotsHand::shown() const {
  const auto at = std::ranges::find_if(
      known_, [&](const Known& known) { return same_question(known.document, editor_.document()); });
  return at == known_.end() ? nullptr : &at->spots;
}

void BlindSpotsHand::advance(bool looked_at) {
  if (editor_.version() != version_) version_ = editor_.version(), edited_ = Clock::now();
  if (study_.advance() && study_.shown()->finished) {
    known_.push_front({document_, study_.shown()->spots});
    if (known_.size() > kMostKnown) known_.pop_back();
  }
  if (running() && !(looked_at && same_question(editor_.document(), document_))) study_.call_off();
  const double rest = std::chrono::duration<double>(Clock::now() - edited_).count();
  if (!looked_at || running() || shown() || rest < kRest) return;
  document_ = editor_.document();
  study_.start([document = document_, scene = session_.scene()](const auto& publish, const bench::Progress& watch) {
    render::Session session({.threads = 1, .scene = scene});
    advisor::TableOptions options;
    options.samples = 4, options.seconds = kSeconds;
    publish(advisor::measured_missing_paths(session, document, options, watch));
  });
}

}  // namespace etendue::viewer
