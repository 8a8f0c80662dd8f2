#include "viewer/tasks/convergence_task.h"

#include <algorithm>
#include <cmath>

#include "base/user_folders.h"
#include "render/session.h"
#include "viewer/files/file_names.h"
#include "viewer/state/document_info.h"
#include "viewer/state/editor.h"
#include "viewer/state/notices.h"
#include "viewer/tasks/convergence_export.h"
#include "viewer/tasks/exclusive_task.h"
#include "viewer/viewport/comparison.h"
#include "viewer/widgets/value_text.h"

namespace etendue::viewer {
namespace {

// Whether two documents define the same image. The integrator may differ.
bool same_image(const render::Document& a, const render::Document& b) {
  return same_view(a, b) && a.method.paths == b.method.paths;
}

}  // namespace

void ConvergenceTask::propose_methods(const render::Document& document) {
  if (!parameters.methods.empty() || !document.scene) return;
  render::MethodSettings method = document.method;
  parameters.methods.push_back(method_spec(method));
  method.sampler = method.sampler == "random" ? "sobol" : "random";
  parameters.methods.push_back(method_spec(method));
}

void ConvergenceTask::add_method(const std::string& spec) {
  auto& methods = parameters.methods;
  if (std::ranges::find(methods, spec) == methods.end()) methods.push_back(spec);
}

Result<void> ConvergenceTask::add_methods(const std::string& list, const render::Document& document) {
  const auto methods = bench::parse_methods(list, document);
  if (!methods) return methods.error();
  // Lists may contain other renderers and the automatic choice, single methods may not.
  for (const bench::MethodSpec& method : *methods)
    if (auto single = bench::parse_method(method.name, document); !single) return single.error();
  for (const bench::MethodSpec& method : *methods) add_method(method.name);
  return {};
}

void ConvergenceTask::remove_method(size_t index) {
  parameters.methods.erase(parameters.methods.begin() + static_cast<std::ptrdiff_t>(index));
  for (size_t* side : {&parameters.a, &parameters.b})
    if (*side > index) --*side;
}

std::optional<size_t> ConvergenceTask::index_in_result(const std::string& spec) const {
  if (!snapshot_) return std::nullopt;
  const auto found = std::ranges::find(snapshot_->methods, spec, &bench::MethodStatus::name);
  if (found == snapshot_->methods.end()) return std::nullopt;
  return static_cast<size_t>(found - snapshot_->methods.begin());
}

Result<void> ConvergenceTask::start(const TaskContext& context) {
  stop(context);
  document_ = context.editor.document();
  bench::LiveBenchmarkPlan plan;
  for (const auto& spec : parameters.methods) {
    auto method = bench::parse_method(spec, document_);
    if (!method) return method.error();
    plan.methods.push_back(std::move(*method));
  }
  if (plan.methods.empty()) return usage_error("There is no method to compare. Add one to the list.");
  plan.rule = parameters.rule;
  plan.seconds = double{parameters.seconds.value};
  plan.samples = static_cast<uint32_t>(parameters.samples.value);
  plan.repeats = parameters.repeats;
  plan.seed = document_.seed;
  plan.threads = context.threads;
  plan.cache = cache_folder();
  plan.compiled = context.session.scene();
  discard_benchmark(context);
  set_running(context);
  benchmark_ = std::make_unique<bench::LiveBenchmark>(std::move(plan), context.wake);
  snapshot_ = benchmark_->snapshot();
  return {};
}

void ConvergenceTask::stop(const TaskContext& context) {
  if (!running_) return;
  benchmark_->stop();
  finish(context);
}

void ConvergenceTask::resume(const TaskContext& context) {
  if (!can_resume()) return;
  set_running(context);
  resumed_from_ = benchmark_->snapshot();
  benchmark_->resume();
}

void ConvergenceTask::set_running(const TaskContext& context) {
  context.exclusive.begin({.status = "comparing", .cancel = [this, context] { stop(context); }});
  running_ = true;
  images_requested_ = true;
}

void ConvergenceTask::finish(const TaskContext& context) {
  running_ = false;
  context.exclusive.end();
}

// The destructor writes the reference to the cache and frees films, so it runs on another thread.
void ConvergenceTask::discard_benchmark(const TaskContext& context) {
  if (!benchmark_) return;
  benchmark_->stop();
  const auto last = std::make_shared<std::unique_ptr<bench::LiveBenchmark>>(std::move(benchmark_));
  const auto destroy = [last] {
    last->reset();
    return true;
  };
  destruction_.start(destroy, context.wake);
}

void ConvergenceTask::update(const TaskContext& context, Comparison& comparison) {
  if (auto written = export_.take_result()) {
    if (*written)
      context.notices.add_message("Saved " + **written);
    else
      context.notices.add_error(written->error().message);
  }
  if (!benchmark_) return;
  const bool is_new = has_update();
  snapshot_ = benchmark_->snapshot();
  if (!same_image(context.editor.document(), document_)) {
    if (running_) {
      finish(context);
      context.notices.add_message(
          "The scene was edited. The comparison was stopped; its curves show the scene before the edit.");
    }
    discard_benchmark(context);
    comparison.a = {};
    comparison.b = {};
    comparison.reference = {};
    comparison.mode = CompareMode::off;
    return;
  }
  const bool done = snapshot_->phase == bench::LiveBenchmarkSnapshot::Phase::done;
  if (running_ && snapshot_ != resumed_from_ && done) finish(context);
  if (is_new || images_requested_) show_images(comparison, context.editor.document());
  // The viewport is split once, as soon as both images exist. The user may then leave the split view.
  if (!images_requested_ || !comparison.a.frame || !comparison.b.frame) return;
  images_requested_ = false;
  if (comparison.mode == CompareMode::off) comparison.mode = CompareMode::wipe;
}

void ConvergenceTask::show_images(Comparison& comparison, const render::Document& document) const {
  const auto side = [&](size_t method) {
    const auto index = method < parameters.methods.size() ? index_in_result(parameters.methods[method]) : std::nullopt;
    if (!index) return Side{};
    const auto& standing = snapshot_->methods[*index];
    if (!standing.incompatibility.empty())
      return Side{.name = short_method_name(standing.name),
                  .label = method_label(standing.name),
                  .frame = nullptr,
                  .unavailable = with_labels(document, standing.incompatibility).text};
    if (!standing.frame) return Side{};
    const std::string samples = formatted(", %u spp", standing.frame->samples);
    return Side{.name = short_method_name(standing.name) + samples,
                .label = method_label(standing.name) + samples,
                .frame = standing.frame};
  };
  comparison.a = side(parameters.a);
  comparison.b = side(parameters.b);
  const std::string reference = formatted("reference, %u spp", snapshot_->reference_samples);
  comparison.reference = {.name = reference, .label = reference, .frame = snapshot_->reference};
}

metrics::ChartOptions ConvergenceTask::chart_options() const {
  metrics::ChartOptions options;
  options.abscissa = parameters.axis;
  options.measure = parameters.error;
  if (!snapshot_) return options;
  const bool equal_time = snapshot_->rule == bench::Rule::equal_time;
  const std::string budget =
      equal_time ? formatted("%g s each", snapshot_->seconds) : formatted("%u spp each", snapshot_->samples);
  options.title =
      base_name(document_.scene_name) + formatted(", %d x %d, ", document_.width, document_.height) + budget;
  if (snapshot_->reference_noise) options.reference_error = snapshot_->reference_noise->error(options.measure);
  return options;
}

std::vector<metrics::MethodCurves> ConvergenceTask::curves() const {
  std::vector<metrics::MethodCurves> curves;
  if (!snapshot_) return curves;
  for (const auto& method : snapshot_->methods) {
    curves.push_back(method.corrected);
    curves.back().name = short_method_name(method.name);
  }
  return curves;
}

void ConvergenceTask::save_chart(const TaskContext& context, const std::string& file) {
  if (!snapshot_) return;
  const bool is_pareto = parameters.chart == ConvergenceChart::pareto;
  const auto write = [file, snapshot = snapshot_, curves = curves(), options = chart_options(), is_pareto] {
    return write_convergence_chart(file, *snapshot, curves, options, is_pareto);
  };
  export_.start(write, context.wake);
}

}  // namespace etendue::viewer
