#include "viewer/tasks/recommendation_task.h"

#include <algorithm>
#include <cmath>

#include "viewer/state/notices.h"
#include "viewer/tasks/convergence_task.h"

namespace etendue::viewer {
namespace {

constexpr float kLeastError = 1e-6f, kLargestError = 100, kUsualError = 0.01f;

// Whether advice for one document holds for the other: which integrator and which sampler it has makes no difference.
bool same_question(const render::Document& a, const render::Document& b) {
  return same_view(a, b) && a.method.paths == b.method.paths && a.method.settings == b.method.settings &&
         a.method.adaptive == b.method.adaptive;
}

// To one figure, as a person would say it.
float rounded(double value) {
  const double power = std::pow(10, std::floor(std::log10(value)));
  return static_cast<float>(std::round(value / power) * power);
}

}  // namespace

float AdviceHand::target() const {
  if (setup.error) return *setup.error;
  const double limit = editor_.document().limits.rmse;
  return std::clamp(limit > 0 ? static_cast<float>(limit) : usual_.value_or(kUsualError), kLeastError, kLargestError);
}

void AdviceHand::look_at(const render::Frame& frame) {
  if (usual_ || frame.samples == 0 || frame.version != editor_.version()) return;
  double sum = 0;
  for (const Rgb& pixel : *frame.pixels) sum += double{luminance(pixel)};
  const double mean = sum / static_cast<double>(frame.pixels->size());
  usual_ = std::isfinite(mean) && mean > 0 ? rounded(0.01 * mean) : kUsualError;
}

void AdviceHand::ask() {
  if (editor_.empty()) return;
  stop();
  was_paused_ = session_.paused();
  session_.pause(true);
  document_ = editor_.document();
  study_.clear();
  advisor::Question question;
  question.target = double{target()}, question.pilot_seconds = double{setup.pilot.value},
  question.seed = document_.seed;
  study_.start([document = document_, question, threads = threads_, scene = session_.scene()](
                   const auto& publish, const bench::Progress& watch) {
    render::Session session({.threads = threads, .scene = scene});
    publish(advisor::advise(session, document, question, watch, publish));
  });
}

void AdviceHand::stop() {
  if (!running()) return;
  study_.call_off();
  session_.pause(was_paused_);
}

void AdviceHand::use(size_t row) {
  if (!shown() || row >= shown()->methods.size()) return;
  render::Document changed = editor_.document();
  std::string paths = std::move(changed.method.paths);  // no part of the advice
  changed.method = shown()->methods[row].method.document.method;
  changed.method.paths = std::move(paths);
  changed.limits.rmse = shown()->target;
  editor_.apply(std::move(changed), "Advice");
}

bool AdviceHand::fresh() const { return shown() && same_question(editor_.document(), document_); }

void AdviceHand::advance(Notices& notices) {
  if (study_.advance()) session_.pause(was_paused_);
  if (!running() || same_question(editor_.document(), document_)) return;
  stop();
  notices.say("The scene was edited: the advice has been called off.");
}

std::vector<ParameterInfo> advice_parameters(const AdviceHand* hand) {
  const Number<float> error{"advice.error",
                            "Error",
                            hand ? hand->target() : kUsualError,
                            {kLeastError, kLargestError},
                            "Root mean square error in radiance that the picture should reach",
                            "",
                            Scale::logarithmic};
  return {describe(error), describe(hand ? hand->setup.pilot : AdviceSetup{}.pilot)};
}

}  // namespace etendue::viewer
