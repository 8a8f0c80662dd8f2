#include "viewer/tasks/recommendation_task.h"

#include <algorithm>
#include <cmath>

#include "render/session.h"
#include "viewer/state/document_info.h"
#include "viewer/state/editor.h"
#include "viewer/state/notices.h"
#include "viewer/tasks/exclusive_task.h"

namespace etendue::viewer {
namespace {

constexpr float kMinError = 1e-6f;
constexpr float kMaxError = 100;
constexpr float kDefaultError = 0.01f;

// Whether a ranking for one document is valid for the other. Integrator and sampler may differ.
bool same_advice_request(const render::Document& a, const render::Document& b) {
  return same_view(a, b) && a.method.paths == b.method.paths && a.method.settings == b.method.settings &&
         a.method.adaptive == b.method.adaptive;
}

float rounded_to_one_digit(double value) {
  const double power = std::pow(10, std::floor(std::log10(value)));
  return static_cast<float>(std::round(value / power) * power);
}

std::vector<ParameterInfo> described(float target, film::ErrorMeasure measure, const Number<float>& pilot) {
  const Number<float> error{"advice.error",
                            "Target error",
                            target,
                            {kMinError, kMaxError},
                            "Error to reach, in the measure chosen under Stop at. Integrators are ranked by the time "
                            "to reach it. Relative and "
                            "displayed errors are fractions: 0.01 is 1 %",
                            measure == film::ErrorMeasure::rmse ? "" : "fraction",
                            Scale::logarithmic};
  return {describe(error), describe(pilot)};
}

}  // namespace

float RecommendationTask::target_error(const render::Document& document) const {
  return parameters.error.value_or(default_target(document));
}

float RecommendationTask::default_target(const render::Document& document) const {
  const double limit = document.limits.error;
  const bool is_rmse = document.limits.measure == film::ErrorMeasure::rmse;
  const float usual = is_rmse ? default_error_.value_or(kDefaultError) : kDefaultError;
  const float error = limit > 0 ? static_cast<float>(limit) : usual;
  return std::clamp(error, kMinError, kMaxError);
}

void RecommendationTask::measure_luminance(const render::Frame& frame, uint64_t document_version) {
  if (default_error_ || frame.samples == 0 || frame.version != document_version) return;
  double sum = 0;
  for (const Rgb& pixel : *frame.pixels) sum += double{luminance(pixel)};
  const double mean = sum / static_cast<double>(frame.pixels->size());
  default_error_ = std::isfinite(mean) && mean > 0 ? rounded_to_one_digit(0.01 * mean) : kDefaultError;
}

std::vector<ParameterInfo> RecommendationTask::describe_parameters(const render::Document& document) const {
  return described(target_error(document), document.limits.measure, parameters.pilot);
}

std::vector<ParameterInfo> RecommendationTask::describe_defaults(const render::Document* document) const {
  if (!document) return described(kDefaultError, film::ErrorMeasure::rmse, Parameters().pilot);
  return described(default_target(*document), document->limits.measure, Parameters().pilot);
}

void RecommendationTask::start(const TaskContext& context) {
  if (context.editor.empty()) return;
  cancel(context);
  document_ = context.editor.document();
  context.exclusive.begin(
      {.status = "piloting", .measures_path_classes = true, .cancel = [this, context] { cancel(context); }});
  task_.reset();
  advisor::AdviceRequest question;
  question.target = double{target_error(document_)};
  question.measure = document_.limits.measure;
  question.pilot_seconds = double{parameters.pilot.value};
  question.seed = document_.seed;
  const auto work = [document = document_, question, threads = context.threads, scene = context.session.scene()](
                        const auto& publish, const bench::Progress& progress) {
    render::Session session({.threads = threads, .scene = scene});
    publish(advisor::advise(session, document, question, progress, publish));
  };
  task_.start(work, context.wake);
}

void RecommendationTask::cancel(const TaskContext& context) {
  if (!running()) return;
  task_.cancel();
  context.exclusive.end();
}

void RecommendationTask::update(const TaskContext& context) {
  if (task_.update()) context.exclusive.end();
  if (!running() || same_advice_request(context.editor.document(), document_)) return;
  cancel(context);
  context.notices.add_message("The scene was edited. The recommendation was cancelled.");
}

void RecommendationTask::reset(const TaskContext& context) {
  cancel(context);
  task_.reset();
  parameters.error.reset();
  default_error_.reset();
}

bool RecommendationTask::is_current(const render::Document& document) const {
  return result() && same_advice_request(document, document_);
}

void RecommendationTask::apply(Editor& editor, size_t row) const {
  if (!result() || row >= result()->methods.size()) return;
  render::Document changed = editor.document();
  // The path filter is not part of the recommendation.
  std::string path_filter = std::move(changed.method.paths);
  const render::Document& recommended = result()->methods[row].method.document;
  changed.method = recommended.method;
  changed.method.paths = std::move(path_filter);
  changed.automatic = recommended.automatic;
  changed.limits.error = result()->target;
  changed.limits.measure = result()->measure;
  editor.apply(std::move(changed), "Recommended method");
}

}  // namespace etendue::viewer
