#include "render/progressive_render.h"

#include <algorithm>
#include <chrono>
#include <cmath>
#include <thread>
#include <utility>

#include "geometry/embree_scene.h"
#include "render/incompatibility.h"
#include "render/limit_progress.h"
#include "render/sample_coverage.h"

namespace etendue::render {
namespace {

// A preview that takes longer is cancelled in favour of a coarser one, while there is no frame of the edit.
constexpr double kPreviewTimeout = 0.025;
// Duration of a slice that is not followed by a frame, in seconds. The status is updated after each slice.
constexpr double kStatusInterval = 0.1;
// Phases that take longer are bridged by a substitute of about this many pixels and this many samples.
constexpr double kSubstituteDelay = 0.3, kSubstitutePixels = 16'000;
constexpr uint32_t kSubstituteSamples = 16;
constexpr double kSliceWithoutFrames = 0.25;
// A phase of the integrator is reported once it has lasted this long, in seconds.
constexpr double kShortestReportedPhase = 0.3;
// The time between two looks for samples of other processes while there is nothing else to do.
constexpr auto kSharedSamplesInterval = std::chrono::milliseconds(1);

// Factor on the time between frames. Consecutive frames differ less as samples accumulate.
double frame_interval_factor(uint32_t samples) { return samples < 32 ? 1 : samples < 256 ? 2.5 : 5; }

}  // namespace

ProgressiveRender::ProgressiveRender(ThreadPool& workers, const SessionOptions& options,
                                     std::function<bool()> keep_going)
    : workers_(workers),
      sharing_(options.sharing),
      interactive_(options.interactive),
      publish_interval_(options.publish_interval),
      keep_going_(std::move(keep_going)),
      frames_(workers),
      film_(workers),
      error_monitor_(workers) {}

void ProgressiveRender::begin(Document document, std::shared_ptr<const scene::CompiledScene> scene,
                              std::optional<ResumePoint> start, double preview_seconds, bool shares) {
  shows_substitute_ = shows_substitute_ && document.method.integrator == document_.method.integrator;
  document_ = std::move(document);
  scene_ = std::move(scene);
  scene_memory_ = scene_->memory();
  film_is_stale_ = !start;
  if (start) film_.resume(document_, std::move(start->film), start->tails);
  // The new renderer may reuse data of the old one, which is destroyed afterwards.
  const auto layers = start ? start->layers : nullptr;
  if (layers) layers->clear(document_.width, document_.height);
  renderer_ =
      std::make_unique<Renderer>(document_, scene_, document_.width, document_.height, renderer_.get(), layers.get());
  layers_ = layers;
  counters_.rays = 0;
  counters_.paths = 0;
  earlier_seconds_ = start ? start->seconds : 0;
  seconds_ = earlier_seconds_;
  focus_seconds_ = 0;
  focus_.reset();
  if (start) renderer_->begin(film_.film(), start->integrator_state);
  samples_ = renderer_->samples();
  shares_ = shares;
  received_.reset();
  shared_samples_ = 0;
  error_monitor_.reset(find_sampler(document_.method.sampler)->independent);
  error_monitor_.set_measure(document_.limits.measure, document_.display.transform());

  if (interactive_ && samples_ == 0)
    preview_resolution_.begin(pixel_count(), preview_seconds);
  else
    preview_resolution_.begin_at_full_resolution();
  preview_.reset();
  awaits_first_frame_ = interactive_;
  paths_in_frame_ = 0;
  samples_in_frame_ = 0;
  phase_ = nullptr;
}

void ProgressiveRender::set_document(const Document& document) {
  document_ = document;
  error_monitor_.set_measure(document_.limits.measure, document_.display.transform());
  if (focus_) focus_->set_measure(document_.limits.measure, document_.display.transform());
}

bool ProgressiveRender::uses_focus() const {
  return requested_focus_ && samples_ >= kSamplesBeforeFocus && !shares_ &&
         is_inside(*requested_focus_, document_.width, document_.height) && focus_incompatibility(document_).empty();
}

// Begins, moves or ends the focus, unless the renderer has to complete a step first. At the end, the error of the image
// is measured again, because the samples of the region have changed it.
void ProgressiveRender::update_focus() {
  const auto wanted = uses_focus() ? requested_focus_ : std::nullopt;
  if (wanted == (focus_ ? std::optional(focus_->region()) : std::nullopt)) return;
  const auto blocks =
      wanted ? std::optional(enclosing_blocks(*wanted, document_.width, document_.height)) : std::nullopt;
  if (!renderer_->restrict_to(blocks, film_.film())) return;
  focus_.reset();
  if (!wanted) {
    samples_ = renderer_->samples();
    return error_monitor_.measure_error(film_.film(), samples_, seconds_ - focus_seconds_, keep_going_);
  }
  focus_.emplace(workers_, *wanted, renderer_->samples(), find_sampler(document_.method.sampler)->independent);
  focus_->set_measure(document_.limits.measure, document_.display.transform());
}

// Samples of other processes replace further previews.
bool ProgressiveRender::needs_preview() {
  if (shares_ && !awaits_first_frame_ && sharing_->has_samples()) preview_resolution_.begin_at_full_resolution();
  return preview_resolution_.scale() > 1;
}

// A preview by path tracing, which has no phases.
std::shared_ptr<Frame> ProgressiveRender::render_substitute(uint32_t samples) {
  const int scale =
      std::max(2, static_cast<int>(std::ceil(std::sqrt(static_cast<double>(pixel_count()) / kSubstitutePixels))));
  Document document = document_;
  document.method.integrator = "path";
  document.method.adaptive = Adaptive::off;
  document.part = {};
  const int width = std::max(1, document.width / scale), height = std::max(1, document.height / scale);
  Renderer renderer(document, scene_, width, height);
  film::Film film(width, height);
  Renderer::Counters counters;
  renderer.begin(film);
  while (renderer.samples() < samples && keep_going_())
    renderer.advance(workers_, {film}, keep_going_, counters, keep_going_);
  if (renderer.samples() < samples) return nullptr;
  auto frame = frames_.enlarged(*FrameMaker::preview(film, scale), document_.width, document_.height);
  frame->is_substitute = true;
  return frame;
}

std::shared_ptr<Frame> ProgressiveRender::render_preview(const std::function<void(const Renderer&)>& on_progress,
                                                         const std::function<void(std::shared_ptr<Frame>)>& publish) {
  const auto start = Clock::now();
  const int scale = preview_resolution_.scale();
  const int width = std::max(1, document_.width / scale);
  const int height = std::max(1, document_.height / scale);
  // The seed is that of the image, so that photons traced for the preview can be reused.
  Document preview_document = document_;
  preview_document.method.adaptive = Adaptive::off;
  preview_document.part = {};
  Renderer renderer(preview_document, scene_, width, height, renderer_.get());
  Renderer::Counters counters;
  const auto substitute = [&](uint32_t samples) {
    auto frame = render_substitute(samples);
    if (!frame) return;
    shows_substitute_ = true;
    publish(std::move(frame));
  };
  bool needs_substitute = awaits_first_frame_;
  // While a substitute is shown, edits are followed by another one at once.
  if (needs_substitute && shows_substitute_) substitute(1);
  const bool has_timeout = awaits_first_frame_ && !preview_resolution_.is_coarsest();
  const std::function<bool()> still_needed = [&] {
    return keep_going_() && !(has_timeout && seconds_since(start) > kPreviewTimeout);
  };
  film::Film* const film = preview_films_.empty_film(scale, width, height, workers_, still_needed);
  if (film) renderer.begin(*film);
  bool complete = false;
  while (film && !complete && still_needed()) {
    const auto slice_start = Clock::now();
    const auto keep_going = [&] { return still_needed() && seconds_since(slice_start) < kStatusInterval; };
    complete = renderer.advance(workers_, {*film}, keep_going, counters, still_needed);
    on_progress(renderer);
    if (complete || !needs_substitute || !renderer.progress().phase || seconds_since(start) < kSubstituteDelay)
      continue;
    needs_substitute = false;
    substitute(kSubstituteSamples);
  }
  preview_resolution_.add_measurement(counters.paths, seconds_since(start));
  if (!complete) {
    if (keep_going_()) preview_resolution_.frame_cancelled();
    return nullptr;
  }
  shows_substitute_ = false;
  preview_ = frames_.preview(*film, scale);
  preview_resolution_.frame_completed();
  return enlarge_preview();
}

// The first frame of an edit is shown in any case.
std::shared_ptr<Frame> ProgressiveRender::enlarge_preview() {
  const auto start = Clock::now();
  const auto keep_enlarging = [&] { return awaits_first_frame_ || keep_going_(); };
  auto frame = frames_.enlarged(*preview_, document_.width, document_.height, keep_enlarging);
  if (!frame) return nullptr;
  enlarging_seconds_per_pixel_ = seconds_since(start) / static_cast<double>(pixel_count());
  frame->samples = samples_;
  return frame;
}

double ProgressiveRender::slice_seconds() const {
  if (is_first_slice()) return kStatusInterval;
  return interactive_ ? publish_interval_ * frame_interval_factor(samples_) : kSliceWithoutFrames;
}

bool ProgressiveRender::render_slice() {
  if (film_is_stale_ && !clear_film()) return false;
  const auto start = Clock::now();
  // An image that is small enough to need no preview is shown as soon as it has one sample per pixel.
  const bool first = is_first_slice();
  const double allowed = slice_seconds();
  const auto keep_sampling = [&] { return keep_going_() && seconds_since(start) < allowed; };
  if (!add_shared_samples()) return true;
  update_focus();
  while (!limit_reached(seconds_ + seconds_since(start))) {
    if (!begin_step()) {
      std::this_thread::sleep_for(kSharedSamplesInterval);
      if (!add_shared_samples()) break;
    } else if (renderer_->advance(workers_, film_.targets(), keep_sampling, counters_, keep_going_)) {
      finish_step();
    }
    if (first || !keep_sampling()) break;
  }
  const double taken = seconds_since(start);
  seconds_ += taken;
  if (focus_) {
    focus_seconds_ += taken;
    focus_->add_seconds(taken);
  }
  if (first && samples_ > 0 && shared_samples_ == 0)
    preview_resolution_.add_measurement(counters_.paths, seconds_ - earlier_seconds_);
  return true;
}

// Selects the next sample, unless a step is in progress. False if other processes are rendering the last samples.
bool ProgressiveRender::begin_step() {
  if (!shares_ || renderer_->is_in_step()) return true;
  const auto sample = sharing_->next_sample();
  if (!sample) return false;
  renderer_->continue_at(*sample);
  film_.begin_sample(*sample);
  return true;
}

void ProgressiveRender::finish_step() {
  if (!focus_) samples_ = renderer_->samples() + shared_samples_;
  if (shares_) film_.finish_sample();
  update_focus();
}

// Adds what other processes have rendered. False if it was interrupted; no sample may be taken until it is complete.
bool ProgressiveRender::add_shared_samples() {
  if (!shares_) return true;
  if (!received_) received_ = sharing_->take();
  if (!received_) return true;
  if (!film_.add(received_->samples, keep_going_)) return false;
  renderer_->film_has_received(received_->count);
  shared_samples_ += received_->count;
  samples_ += received_->count;
  counters_.rays += received_->rays;
  counters_.paths += received_->paths;
  received_.reset();
  return true;
}

// The film is emptied here, after the previews, because that takes too long to delay the first frame of an edit.
bool ProgressiveRender::clear_film() {
  if (!film_.clear(document_, keep_going_)) return false;
  renderer_->begin(film_.film());
  film_is_stale_ = false;
  return true;
}

bool ProgressiveRender::limit_reached(double seconds) {
  const Limits& limits = document_.limits;
  if (sample_or_time_limit_reached(limits, samples_to_limit(), seconds)) return true;
  if (limits.error <= 0) return false;
  if (focus_)
    focus_->update(film_.film(), samples_to_limit(), keep_going_);
  else if (error_monitor_.is_error_due(samples_))
    error_monitor_.measure_error(film_.film(), samples_, seconds - focus_seconds_, keep_going_);
  const film::MeasuredError& error = focus_ ? focus_->error() : error_monitor_.measured();
  return error.known && error.value <= limits.error;
}

bool ProgressiveRender::update_statistics() {
  const bool finished = limit_reached(seconds_);
  if (focus_) focus_->update(film_.film(), samples_to_limit(), keep_going_, finished);
  if (error_monitor_.is_error_due(samples_) || (finished && !error_monitor_.is_error_current(samples_)))
    error_monitor_.measure_error(film_.film(), samples_, seconds_ - focus_seconds_, keep_going_);
  if (error_monitor_.is_reliability_due(samples_) || (finished && !error_monitor_.is_reliability_current(samples_)))
    error_monitor_.measure_reliability(film_.film(), film_.tails(), samples_, keep_going_);
  return finished;
}

std::shared_ptr<Frame> ProgressiveRender::frame_after_slice(bool finished) {
  if (!interactive_ || is_first_slice()) return nullptr;
  // The last frame is made even if the session is interrupted, because no slice follows it.
  const auto keep_going = [&] { return finished || keep_going_(); };
  if (!keep_going()) return nullptr;
  const bool unchanged = counters_.paths == paths_in_frame_ && samples_ == samples_in_frame_;
  if (!awaits_first_frame_ && unchanged) return nullptr;
  auto frame = frames_.full(film_.film(), samples_ > 0 ? nullptr : preview_.get(), film_.reweighting(), keep_going);
  if (!frame) return nullptr;
  paths_in_frame_ = counters_.paths;
  samples_in_frame_ = samples_;
  frame->samples = samples_;
  return frame;
}

void ProgressiveRender::write_initial_status(Status& status) const {
  status.build = scene_->report();
  status.phase = "rendering";
  status.incompatibility = incompatibility(document_, *scene_);
  status.notes = renderer_->notes();
  status.samples = samples_;
  status.memory = scene_memory_ + embree_memory() + SessionFilm::memory(document_) + preview_films_.memory();
}

void ProgressiveRender::write_status(Status& status, bool finished) {
  const double seconds = seconds_ - earlier_seconds_;
  const auto per_second = [&](uint64_t count) { return seconds > 0 ? static_cast<double>(count) / seconds : 0; };
  status.samples = samples_;
  status.seconds = seconds_;
  status.rays = counters_.rays;
  status.paths = counters_.paths;
  status.rays_per_second = per_second(status.rays);
  status.paths_per_second = per_second(status.paths);
  status.error = error_monitor_.error();
  status.measure = document_.limits.measure;
  status.measured_error = error_monitor_.measured();
  status.rejected = film_.film().invalid_samples();
  status.statistics = renderer_->statistics();
  status.notes = renderer_->notes();
  status.reliability = status.error.known ? error_monitor_.reliability() : nullptr;
  write_focus(status);
  write_limit(status);
  status.memory = scene_memory_ + embree_memory() + SessionFilm::memory(document_) + preview_films_.memory() +
                  film_.film().rounding_errors().memory() + renderer_->memory();
  write_phase(status, *renderer_);
  status.finished = finished;
  if (finished) {
    status.phase = "done";
    status.progress = 1;
  }
}

void ProgressiveRender::write_focus(Status& status) const {
  status.focus.reset();
  if (!requested_focus_) return;
  FocusStatus& focus = status.focus.emplace();
  focus.region = *requested_focus_;
  focus.incompatibility = shares_ ? "Other processes render the image as well" : focus_incompatibility(document_);
  focus.samples = samples_to_limit();
  if (focus_) focus.error = focus_->error();
}

// Limits refer to the focus if there is one. Its time is converted to that in which it would have received all its
// samples.
void ProgressiveRender::write_limit(Status& status) const {
  Limits limits = document_.limits;
  const uint32_t samples = samples_to_limit();
  const double seconds = focus_ ? focus_->seconds_of(samples) : seconds_ - focus_seconds_;
  if (limits.seconds > 0) limits.seconds = std::max(limits.seconds - seconds_ + seconds, 1e-9);
  const SamplingState state{.samples = samples,
                            .seconds = seconds,
                            .error = focus_ ? focus_->error() : error_monitor_.measured(),
                            .estimator = focus_ ? focus_->estimator() : error_monitor_.estimator()};
  status.progress = progress_to_limit(limits, state);
  status.time_left = time_to_limit(limits, state);
}

void ProgressiveRender::write_phase(Status& status, const Renderer& renderer) {
  const Renderer::Progress progress = renderer.progress();
  if (progress.phase != phase_ || renderer.samples() != phase_sample_) {
    phase_ = progress.phase;
    phase_sample_ = renderer.samples();
    phase_began_ = Clock::now();
  }
  const bool is_reported = phase_ && seconds_since(phase_began_) >= kShortestReportedPhase;
  status.phase = is_reported ? phase_ : "rendering";
  status.phase_progress = is_reported ? progress.done : 0;
}

film::Film ProgressiveRender::film_copy() const {
  return film_is_stale_ ? film::Film(document_.width, document_.height) : film_.film();
}

ResumePoint ProgressiveRender::resume_point() const {
  if (film_is_stale_ || !renderer_) return film_copy();
  return {film_.film(), renderer_->integrator_state(), tail_states()};
}

std::vector<film::TailState> ProgressiveRender::tail_states() const {
  return film_is_stale_ ? std::vector<film::TailState>() : film_.tail_states();
}

std::optional<std::vector<float>> ProgressiveRender::reweighted_copy() const {
  return film_is_stale_ ? std::nullopt : film_.reweighted();
}

std::shared_ptr<const std::vector<integrator::StoredPoint>> ProgressiveRender::stored_points() const {
  return renderer_ ? renderer_->stored_points() : nullptr;
}

std::shared_ptr<const integrator::SolutionView> ProgressiveRender::solution_view() const {
  return renderer_ ? renderer_->solution_view() : nullptr;
}

}  // namespace etendue::render
