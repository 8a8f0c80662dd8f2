#include "revised_render.h"

#include <algorithm>
#include <cstdio>

#include "advisor/choice_revision.h"
#include "base/hash.h"
#include "base/number_text.h"
#include "progress_bar.h"
#include "render_results.h"

namespace etendue::cli {
namespace {

// The smallest fraction of the time that the rendering after the revision has.
constexpr double kLeastRest = 0.1;

class RevisedRender {
 public:
  RevisedRender(render::Session& session, render::Document document, advisor::MethodChoice& choice, double seconds,
                const std::atomic<bool>& interrupted)
      : session_(session),
        document_(std::move(document)),
        choice_(choice),
        seconds_(seconds),
        interrupted_(interrupted) {}

  RevisedRendering run() {
    const render::Status first = rendered(limited(advisor::kRevisionTime * seconds_), 0);
    if (interrupted_) return {std::move(document_), first};
    render::ResumePoint point = session_.resume_point();
    point.tails = session_.tail_states();
    const advisor::Revision revision = revise();
    progress_.finish();
    const double rest = std::max(kLeastRest * seconds_, seconds_ - first.seconds - revision.seconds);
    render::Status last;
    if (revision.changes_method()) {
      last = rendered_by(revision, rest, point.film, first);
    } else if (interrupted_) {
      last = restored(std::move(point), first.samples);
    } else {
      last = rendered(limited(rest), advisor::kRevisionTime, &point);
    }
    last.seconds += first.seconds;
    last.rays += first.rays;
    last.paths += first.paths;
    return {std::move(document_), last};
  }

 private:
  render::Document limited(double seconds) const {
    render::Document d = document_;
    d.limits.seconds = seconds;
    return d;
  }

  // Renders until the limit or an interruption. The progress bar starts at `begin`.
  render::Status rendered(const render::Document& d, double begin, render::ResumePoint* point = nullptr) {
    const uint64_t version = point ? session_.submit(d, std::move(*point)) : session_.submit(d);
    const double share = begin > 0 ? 1 - begin : advisor::kRevisionTime;
    bench::wait_for(session_, version, [&](const render::Status& status) {
      progress_.show(begin + share * status.progress, progress_text(status));
      return !interrupted_;
    });
    progress_.finish();
    return session_.status();
  }

  advisor::Revision revise() {
    const auto show_progress = [&](double done, const std::string& task) {
      progress_.show(done, task);
      return !interrupted_;
    };
    return advisor::revised_choice(session_, document_, choice_, seconds_, show_progress);
  }

  // The session with a film to which nothing is added.
  render::Status restored(render::ResumePoint point, uint32_t samples) {
    render::Document d = document_;
    d.limits = {std::max(samples, 1U), 0, 0, document_.limits.measure};
    session_.submit(d, std::move(point));
    session_.finish();
    return session_.status();
  }

  // The rest of the time by another method, averaged with the earlier film.
  render::Status rendered_by(const advisor::Revision& revision, double seconds, const film::Film& earlier,
                             const render::Status& first) {
    std::fprintf(stderr, "etendue: %s (%s)\n", revision.reason.c_str(), format_duration(revision.seconds).c_str());
    document_.method = revision.method;
    document_.automatic.reason += "; then " + revision.reason;
    render::Document d = limited(seconds);
    // Otherwise both methods would use the same points on the film and on lights.
    d.seed = mix_bits(document_.seed + 1) & 0x3fffffff;
    const render::Status second = rendered(d, advisor::kRevisionTime);
    const film::Film mean =
        advisor::weighted_mean(earlier, session_.film_copy(), revision.earlier_weight(first.seconds, second.seconds));
    render::Status status = restored(render::ResumePoint(mean), mean.samples(0, 0));
    status.seconds = second.seconds;
    status.rays = second.rays;
    status.paths = second.paths;
    status.rays_per_second = second.rays_per_second;
    status.paths_per_second = second.paths_per_second;
    status.reliability = second.reliability;
    return status;
  }

  render::Session& session_;
  render::Document document_;
  advisor::MethodChoice& choice_;
  double seconds_;
  const std::atomic<bool>& interrupted_;
  Progress progress_;
};

}  // namespace

RevisedRendering render_with_revision(render::Session& session, render::Document document,
                                      advisor::MethodChoice& choice, double seconds,
                                      const std::atomic<bool>& interrupted) {
  return RevisedRender(session, std::move(document), choice, seconds, interrupted).run();
}

}  // namespace etendue::cli
