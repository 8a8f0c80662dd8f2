#include "bench/benchmark.h"

#include <atomic>
#include <chrono>
#include <cmath>
#include <future>

#include "bench/denoised_images.h"
#include "bench/external_renderer.h"
#include "bench/measurement_schedule.h"
#include "film/film_image.h"
#include "render/incompatibility.h"
#include "scene/compiled_scene.h"

namespace etendue::bench {
namespace {

// The fraction of the budget that is left for rendering after an automatic choice, if the choice took longer.
constexpr double kLeastRemaining = 0.01;

// Renders repeats, each of which has a number (unit_count).
class Runner {
 public:
  Runner(render::Session& session, const Plan& plan, size_t first, size_t end, const Reference& reference,
         const Progress& progress)
      : session_(session), plan_(plan), first_(first), end_(end), reference_(reference), progress_(progress) {}

  std::vector<std::string> incompatibilities() const {
    std::vector<std::string> texts;
    std::shared_ptr<const scene::CompiledScene> scene = session_.scene();
    for (const MethodSpec& method : plan_.methods) {
      std::string& text = texts.emplace_back();
      if (method.is_external() || method.is_automatic()) continue;
      const render::Document& d = method.document;
      scene = scene::compile(d.scene, d.camera, scene, d.height);
      text = render::incompatibility(d, *scene);
    }
    return texts;
  }

  // Calls `take` with the results, in the order of their numbers. Methods for which `is_measured` returns false are
  // left out. False if it was interrupted; the results of the repeat at that time are discarded.
  template <class IsMeasured, class Take>
  bool run(const IsMeasured& is_measured, const Take& take) {
    for (unit_ = first_; unit_ < end_; ++unit_) {
      if (!is_measured(method())) continue;
      auto result = spec().is_external() ? run_external() : run_integrator();
      if (!result) return false;
      result->method = method();
      take(std::move(*result));
    }
    return true;
  }

 private:
  size_t method() const { return unit_ % plan_.methods.size(); }
  int repeat() const { return static_cast<int>(unit_ / plan_.methods.size()); }
  const MethodSpec& spec() const { return plan_.methods[method()]; }
  uint64_t seed() const { return repeat_seed(plan_.seed, method(), repeat()); }

  // Nothing if it was interrupted.
  std::optional<RepeatResult> run_external() {
    RepeatResult result{.curve = {repeat(), {}}, .rays_per_second = NAN};
    std::vector<ExternalRun> runs;
    while (const uint32_t samples = next_external_samples(runs, plan_.seconds, plan_.samples)) {
      render::Status status;
      if (!runs.empty()) status.seconds = runs.back().seconds - time_of(runs).startup;
      status.samples = runs.empty() ? 0 : runs.back().samples;
      const render::Document& d = spec().document;
      auto rendered =
          render_externally(spec().command, d.width, d.height, samples, seed(), [&] { return report(status); });
      if (!rendered && rendered.error().fault == Fault::interrupted) return std::nullopt;
      if (!rendered) return RepeatResult{.failure = rendered.error().message};
      runs.push_back({samples, rendered->seconds});
      result.image = std::move(rendered->rgb);
      result.curve.points.push_back(measure_error(result.image, reference_, rendered->seconds, samples));
    }
    const ExternalTime time = time_of(runs);
    for (metrics::ErrorPoint& point : result.curve.points) point.seconds = time.per_sample * point.spp;
    result.startup_seconds = time.startup;
    return result;
  }

  std::optional<RepeatResult> run_integrator() {
    render::Document d = spec().document;
    d.seed = seed();
    RepeatResult result{.curve = {repeat(), {}}};
    double choice_seconds = 0;
    if (spec().is_automatic()) {
      const auto chosen = choose(d);
      if (!chosen) return RepeatResult{.failure = chosen.error().message};
      if (chosen->interrupted) return std::nullopt;
      d = chosen->document;
      choice_seconds = chosen->seconds;
      result.choice = chosen->reason;
    }
    DenoisedImages denoised(d, spec().denoiser.value_or(render::Denoiser::automatic), plan_.threads);
    const auto seconds_outside = [&] { return choice_seconds + denoised.seconds(); };
    render::Status status;
    for (uint32_t count = spec().denoiser ? kFirstDenoisedSamples : 1;; count = next_sample_count(count)) {
      if (!report(status)) return std::nullopt;  // short renderings end before wait_for reports
      const bool last = plan_.samples > 0 && count >= plan_.samples;
      const double seconds = std::max(kLeastRemaining * plan_.seconds, plan_.seconds - seconds_outside());
      d.limits = {last ? plan_.samples : count, plan_.seconds > 0 ? seconds : 0, 0};
      if (!wait_for(session_, session_.submit(d), [&](const auto& s) { return report(s); })) return std::nullopt;
      const uint32_t before = status.samples;
      status = session_.status();
      if (status.samples > before || result.curve.points.empty()) {
        const film::Film film = session_.film_copy();
        auto image = spec().denoiser ? denoise(denoised, film, status) : film::radiance_of(film);
        if (!image) return RepeatResult{.failure = image.error().message};
        if (image->empty()) return std::nullopt;
        result.image = std::move(*image);
        result.curve.points.push_back(
            measure_error(result.image, reference_, seconds_outside() + status.seconds, status.samples));
      }
      if (last || status.samples < count) break;
    }
    result.rays_per_second = status.rays_per_second;
    if (!status.reliability) return result;
    result.khat = status.reliability->tail.khat;
    result.has_heavy_tail = status.reliability->verdict == render::Verdict::unreliable;
    return result;
  }

  // Reports progress meanwhile. Empty if it was interrupted.
  Result<std::vector<float>> denoise(DenoisedImages& denoised, const film::Film& film, const render::Status& status) {
    constexpr auto kInterval = std::chrono::milliseconds(10);
    std::atomic<bool> continues = true;
    const auto scene = session_.scene();
    auto image =
        std::async(std::launch::async, [&] { return denoised.of(*scene, film, [&] { return continues.load(); }); });
    while (image.wait_for(kInterval) != std::future_status::ready) continues = continues && report(status);
    return image.get();
  }

  Result<ChosenMethod> choose(render::Document d) {
    if (!plan_.choose) return usage_error("the integrator cannot be chosen automatically here");
    d.limits = {plan_.samples, plan_.seconds, 0};
    return plan_.choose(session_, d, [&](double, const std::string&) { return report({}); });
  }

  bool report(const render::Status& s) const {
    double current = plan_.seconds > 0 ? s.seconds / plan_.seconds : 0;
    if (plan_.samples > 0) current = std::max(current, static_cast<double>(s.samples) / plan_.samples);
    const auto finished = static_cast<double>(unit_ - first_), all = static_cast<double>(end_ - first_);
    return progress_(
        (finished + std::min(current, 1.0)) / all,
        spec().label() + ", repeat " + std::to_string(repeat() + 1) + " of " + std::to_string(plan_.repeats));
  }

  render::Session& session_;
  const Plan& plan_;
  size_t first_, end_;
  const Reference& reference_;
  const Progress& progress_;
  size_t unit_ = 0;  // the number of the present repeat
};

}  // namespace

size_t unit_count(const Plan& plan) { return plan.methods.size() * static_cast<size_t>(plan.repeats); }

OutcomeBuilder::OutcomeBuilder(const Plan& plan, const std::vector<std::string>& incompatibilities) {
  for (size_t i = 0; i < plan.methods.size(); ++i) {
    MethodResult& result = outcome_.methods.emplace_back();
    result.curves.name = plan.methods[i].label();
    result.incompatibility = incompatibilities[i];
  }
}

void OutcomeBuilder::add(RepeatResult repeat) {
  MethodResult& result = outcome_.methods[repeat.method];
  if (!result.incompatibility.empty()) return;
  if (!repeat.failure.empty()) {
    const std::string name = result.curves.name;
    result = {};
    result.curves.name = name;
    result.incompatibility = repeat.failure;
    return;
  }
  result.rays_per_second.push_back(repeat.rays_per_second);
  if (!repeat.choice.empty()) result.choices.push_back(std::move(repeat.choice));
  if (repeat.startup_seconds) result.startup_seconds.push_back(*repeat.startup_seconds);
  const auto n = static_cast<double>(result.rays_per_second.size());
  result.mean_mse += (repeat.curve.points.back().mse - result.mean_mse) / n;
  result.mean_image.resize(repeat.image.size());
  for (size_t i = 0; i < repeat.image.size(); ++i)
    result.mean_image[i] += (static_cast<double>(repeat.image[i]) - result.mean_image[i]) / n;
  result.curves.repeats.push_back(std::move(repeat.curve));
  result.image = std::move(repeat.image);
  result.khat = repeat.khat;
  result.has_heavy_tail = repeat.has_heavy_tail;
}

Outcome run(render::Session& session, const Plan& plan, const Reference& reference, const Progress& progress) {
  Runner runner(session, plan, 0, unit_count(plan), reference, progress);
  OutcomeBuilder builder(plan, runner.incompatibilities());
  const bool complete = runner.run([&](size_t method) { return builder.is_measured(method); },
                                   [&](RepeatResult result) { builder.add(std::move(result)); });
  return builder.take(!complete);
}

PartOutcome run_part(render::Session& session, const Plan& plan, size_t first, size_t end, const Reference& reference,
                     const Progress& progress) {
  Runner runner(session, plan, first, end, reference, progress);
  PartOutcome outcome{.incompatibilities = runner.incompatibilities(), .repeats = {}};
  std::vector<bool> failed(plan.methods.size());
  const bool complete =
      runner.run([&](size_t method) { return outcome.incompatibilities[method].empty() && !failed[method]; },
                 [&](RepeatResult result) {
                   failed[result.method] = !result.failure.empty();
                   outcome.repeats.push_back(std::move(result));
                 });
  outcome.interrupted = !complete;
  return outcome;
}

}  // namespace etendue::bench
