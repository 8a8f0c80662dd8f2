#include "advisor/method_choice.h"

#include <algorithm>
#include <chrono>
#include <cmath>
#include <nlohmann/json.hpp>

#include "advisor/class_energy.h"
#include "advisor/integrator_costs.h"
#include "advisor/minimised_error.h"
#include "advisor/reference_integrator.h"
#include "advisor/report_numbers.h"
#include "base/hash.h"
#include "scene/compiled_scene.h"
#include "scene/light_kinds.h"
#include "transport/path_expression/path_expression.h"

namespace etendue::advisor {
namespace {

// The first small rendering, which determines the size of the pilots.
constexpr int kProbePixels = 2500;
constexpr uint32_t kProbeSamples = 2;
// Sizes of pilots in pixels; with a time limit they may be smaller.
constexpr int kMinPilotPixels = 1024, kMinTimedPixels = 512, kMaxPilotPixels = 40000;
// Pilots are so small that the budget permits this number of samples per pixel by the cheapest method.
constexpr double kPilotSamples = 96;
// The smallest budget without a time limit, in samples of a pixel by the cheapest method. Fewer samples do not show
// which methods find rare bright paths.
constexpr double kLeastBudget = 1'000'000;
// The fraction of the budget that the first round of the integrators should take, and that which it may take.
constexpr double kFirstRound = 0.1, kLongestFirstRound = 0.6;
// The fraction of the budget for the comparison of samplers.
constexpr double kSamplerShare = 0.25;
// The image with which missing paths are measured, and the fraction of the budget for it.
constexpr int kMissingPixels = 2500;
constexpr uint32_t kMissingSamples = 16;
constexpr double kMissingShare = 0.3;
// Cost of a typical sample relative to one of path tracing, over all integrators.
constexpr double kTypicalCost = 2.5;
// Pilots and the final image use independent random numbers.
constexpr uint64_t kPilotSeed = 0x70696c6f74;

double steady_seconds() {
  return std::chrono::duration<double>(std::chrono::steady_clock::now().time_since_epoch()).count();
}

std::string joined_refusals(const std::vector<ConsideredMethod>& considered) {
  std::string text;
  for (const ConsideredMethod& m : considered) text += (text.empty() ? "" : "; ") + m.name + ": " + m.refusal;
  return text;
}

ConsideredMethod considered(const ComparedMethod& m, render::MinimisedError measure, const std::string& name) {
  return {.name = name,
          .samples = m.samples,
          .cost = m.cost,
          .pilot_error = shown_error(measure, m.error.value),
          .predicted_error = shown_error(measure, m.predicted_error),
          .misses_light = m.misses_light};
}

// Measures the energy of paths of point, spot and directional lights that a method does not find.
class MissingEnergy {
 public:
  MissingEnergy(render::Session& session, const render::Document& document, const scene::CompiledScene& scene)
      : session_(session),
        measure_(document.automatic.error),
        small_(limited_to(with_reference_integrator(document, scene), kMissingPixels)) {
    small_.limits = {kMissingSamples, 0, 0};
    small_.seed = mix_bits(document.seed ^ kPilotSeed);
  }

  // The contribution of the paths to the squared error of an image; nothing if interrupted.
  std::optional<double> squared_error(const transport::Automaton& paths, const std::function<bool()>& goes_on) {
    for (const auto& [known, value] : known_)
      if (known == paths) return value;
    if (!total_.image) {
      if (const auto total = measured(small_, goes_on))
        total_ = *total;
      else
        return {};
    }
    render::Document d = small_;
    d.scene = std::make_shared<const scene::Scene>(with_point_lights_only(*small_.scene));
    d.method.paths = transport::expression_of(paths, scene::has_scattering_media(*small_.scene));
    const auto energy = measured(d, goes_on);
    if (!energy) return {};
    const double value = squared_error(*energy);
    known_.emplace_back(paths, value);
    return value;
  }

 private:
  std::optional<ClassEnergy> measured(const render::Document& d, const std::function<bool()>& goes_on) {
    if (!bench::wait_for(session_, session_.submit(d), [&](const render::Status&) { return goes_on(); })) return {};
    return class_energy(session_.film_copy());
  }

  double squared_error(const ClassEnergy& energy) const {
    return energy.found() ? missing_square(energy, total_, small_, measure_) : 0;
  }

  render::Session& session_;
  render::MinimisedError measure_;
  render::Document small_;
  ClassEnergy total_;
  std::vector<std::pair<transport::Automaton, double>> known_;
};

class Chooser {
 public:
  Chooser(render::Session& session, const render::Document& document, const bench::Progress& progress,
          const ChoiceOptions& options)
      : session_(session), document_(document), options_(options) {
    seconds_ = options_.seconds > 0 ? options_.seconds : kPilotFraction * document.limits.seconds;
    choice_.by_time = seconds_ > 0;
    choice_.measure = document.automatic.error;
    choice_.method = document.method;
    if (!options_.clock) options_.clock = steady_seconds;
    by_processor_time_ = choice_.by_time && !options_.cost;
    if (!options_.cost) options_.cost = choice_.by_time ? time_cost : ray_cost;
    progress_ = [this, &progress](double done, const std::string& what) {
      const bool goes_on = progress(base_ + share_ * done, "choosing the integrator: " + what);
      choice_.interrupted = choice_.interrupted || !goes_on;
      return goes_on;
    };
  }

  Result<MethodChoice> choose() {
    const double start = options_.clock();
    const auto scene = scene::compile(document_.scene, document_.camera, session_.scene());
    std::vector<ComparedMethod> candidates;
    std::vector<ConsideredMethod> refused;
    MissingEnergy missing_energy(session_, document_, *scene);
    const auto goes_on = [&] {
      return progress_(0, "missing paths") && (!choice_.by_time || options_.clock() - start < kMissingShare * seconds_);
    };
    for (const AllowedMethod& m : allowed_methods(document_, *scene)) {
      const std::optional<double> missing = !m.refusal.empty() && !m.missing_of_points.empty()
                                                ? missing_energy.squared_error(m.missing_of_points, goes_on)
                                                : std::nullopt;
      if (m.refusal.empty() || missing)
        candidates.push_back({.method = m.method, .missing = missing.value_or(0)});
      else
        refused.push_back({.name = m.method.integrator, .refusal = m.refusal});
    }
    if (candidates.empty())
      return input_error("auto: no integrator that auto.allow permits can render this scene (" +
                         joined_refusals(refused) + ")");
    // The present integrator first: if there is time for one pilot only, it is that.
    std::ranges::stable_partition(candidates,
                                  [&](const auto& m) { return m.method.integrator == document_.method.integrator; });
    std::ranges::stable_partition(candidates, [&](const auto& m) { return m.missing == 0; });
    choice_.method = candidates[0].method;
    if (candidates.size() == 1)
      choice_.reason = choice_.method.integrator +
                       " is the only integrator that auto.allow permits and that finds all light of this scene";
    else
      compare_integrators(candidates, start);
    if (!choice_.interrupted && choice_.considered.size() > 1) compare_samplers(start);
    choice_.considered.insert(choice_.considered.end(), refused.begin(), refused.end());
    choice_.seconds = options_.clock() - start;
    return std::move(choice_);
  }

 private:
  // The plan of a comparison that may use `share` of the whole budget.
  ComparisonPlan plan(double share) const {
    ComparisonPlan plan;
    plan.measure = choice_.measure;
    plan.cost = options_.cost;
    plan.by_processor_time = by_processor_time_;
    plan.max_pixels = kMaxPilotPixels;
    plan.seed = mix_bits(document_.seed ^ kPilotSeed);
    plan.horizon = 1 / (kPilotFraction * share);
    return plan;
  }

  // What is left of the budget in seconds.
  double seconds_left(double start) const { return seconds_ - (options_.clock() - start); }
  // The budget in samples of a pixel.
  double budget_samples() const {
    const uint32_t samples = document_.limits.samples > 0 ? document_.limits.samples : kAssumedSamples;
    return std::max(kLeastBudget, kPilotFraction * samples * document_.width * document_.height);
  }

  // The number of pixels at which the first round of all candidates fits into its part of the budget, from a small
  // rendering of the first one. Zero if there is no time for any comparison.
  int affordable_pixels(const std::vector<ComparedMethod>& candidates, double start) {
    render::Document probe = limited_to(document_, kProbePixels);
    probe.method = candidates[0].method;
    probe.limits = {kProbeSamples, 0, 0};
    const auto keep_going = [&](const render::Status&) {
      return progress_(0, "pilot of " + probe.method.integrator) && seconds_left(start) > 0;
    };
    if (!bench::wait_for(session_, session_.submit(probe), keep_going)) return 0;
    const double seconds = options_.cost(session_.status(), probe.method);
    const double per_pixel = seconds / (static_cast<double>(probe.width) * probe.height);
    const double first_round = per_pixel * kTypicalCost * static_cast<double>(candidates.size());
    const double pixels = (1 - kSamplerShare) * seconds_left(start) / std::max(1e-12, first_round);
    if (kLongestFirstRound * pixels < kMinTimedPixels) return 0;
    return static_cast<int>(std::clamp<double>(kFirstRound * pixels, kMinTimedPixels, kMaxPilotPixels));
  }

  void compare_integrators(const std::vector<ComparedMethod>& candidates, double start) {
    ComparisonPlan p = plan(1 - kSamplerShare);
    share_ = 1 - kSamplerShare;
    if (choice_.by_time) {
      p.max_pixels = affordable_pixels(candidates, start);
      p.budget = (1 - kSamplerShare) * seconds_left(start);
      if (p.max_pixels == 0) {
        choice_.reason = choice_.method.integrator + " without a comparison: the time limit is too short for pilots";
        return;
      }
    } else {
      p.strict = false;
      p.max_pixels =
          static_cast<int>(std::clamp<double>(budget_samples() / kPilotSamples, kMinPilotPixels, kMaxPilotPixels));
      p.budget_samples = (1 - kSamplerShare) * budget_samples();
    }
    Comparison comparison = compare_methods(session_, document_, candidates, p, progress_);
    demote_unclear_variants(comparison.methods);
    for (const ComparedMethod& m : comparison.methods)
      choice_.considered.push_back(considered(m, choice_.measure, m.method.integrator));
    if (std::isfinite(comparison.methods[0].predicted_error)) choice_.method = comparison.methods[0].method;
    pilot_pixels_ = choice_.pilot_pixels = p.max_pixels;
    choice_.pilot_seed = p.seed;
    explain(comparison);
    for (ComparedMethod& m : comparison.methods)
      if (choice_.finalists.size() < 2 && std::isfinite(m.predicted_error) && !m.film.pixels().empty())
        choice_.finalists.push_back(std::move(m));
  }

  void explain(const Comparison& comparison) {
    const ComparedMethod& best = comparison.methods[0];
    if (!std::isfinite(best.predicted_error)) {
      choice_.reason = choice_.method.integrator + " without a comparison: the pilots were too short to measure errors";
      return;
    }
    const bool is_smallest = std::ranges::none_of(
        comparison.methods, [&](const ComparedMethod& m) { return m.predicted_error < best.predicted_error; });
    choice_.reason = best.method.integrator + (is_smallest ? " has the smallest" : " is not clearly worse: its") +
                     " predicted " + minimised_label(choice_.measure) + (is_smallest ? " (" : " is ") +
                     minimised_text(choice_.measure, best.predicted_error) + (is_smallest ? ")" : "");
    for (size_t i = 1; i < comparison.methods.size(); ++i) {
      const ComparedMethod& m = comparison.methods[i];
      if (m.misses_light)
        choice_.reason += ", " + m.method.integrator + " misses bright paths";
      else if (std::isfinite(m.predicted_error))
        choice_.reason += ", " + m.method.integrator + ' ' +
                          times(shown_error(choice_.measure, m.predicted_error) /
                                shown_error(choice_.measure, best.predicted_error)) +
                          " times that";
    }
  }

  // The winner with the other samplers.
  void compare_samplers(double start) {
    std::vector<ComparedMethod> variants{{.method = choice_.method}};
    for (const auto& info : sampler_infos()) {
      if (info.name == choice_.method.sampler || info.independent || info.for_study) continue;
      variants.push_back({.method = choice_.method});
      variants.back().method.sampler = info.name;
    }
    ComparisonPlan p = plan(kSamplerShare);
    p.max_pixels = pilot_pixels_;
    p.budget = choice_.by_time ? seconds_left(start) : 1;
    if (choice_.by_time && p.budget <= 0) return;
    p.strict = choice_.by_time;
    if (!choice_.by_time) p.budget_samples = kSamplerShare * budget_samples();
    base_ = 1 - kSamplerShare;
    share_ = kSamplerShare;
    Comparison comparison = compare_methods(session_, document_, variants, p, progress_);
    const auto present = std::ranges::find(comparison.methods, choice_.method, &ComparedMethod::method);
    const ComparedMethod& best = comparison.methods[0];
    if (!is_clearly_better(best, *present)) return;
    choice_.method = best.method;
    choice_.reason += "; sampler " + best.method.sampler;
    // A pilot whose film was lost cannot continue.
    if (comparison.methods[0].film.pixels().empty()) choice_.finalists.clear();
    if (!choice_.finalists.empty()) choice_.finalists[0] = std::move(comparison.methods[0]);
  }

  render::Session& session_;
  const render::Document& document_;
  ChoiceOptions options_;
  bench::Progress progress_;
  bool by_processor_time_ = false;
  double seconds_ = 0;           // the budget, if the time is limited
  double base_ = 0, share_ = 1;  // of the reported progress
  int pilot_pixels_ = kMaxPilotPixels;
  MethodChoice choice_;
};

}  // namespace

bool is_clearly_better(const ComparedMethod& a, const ComparedMethod& b) {
  constexpr double kLeastGain = 0.95;
  const double uncertainty = a.error.value > 0 ? a.error.interval.high / a.error.value : INFINITY;
  return a.predicted_error * std::max(uncertainty, 1 / kLeastGain) < b.predicted_error;
}

void demote_unclear_variants(std::vector<ComparedMethod>& methods) {
  const auto is_unclear_variant = [&] {
    if (methods.empty() || !std::isfinite(methods[0].predicted_error)) return methods.end();
    const std::string_view name = plain_form_of(methods[0].method.integrator);
    const auto plain = std::ranges::find_if(methods, [&](const ComparedMethod& m) {
      return m.method.integrator == name && std::isfinite(m.predicted_error) && !m.misses_light;
    });
    return plain != methods.end() && !is_clearly_better(methods[0], *plain) ? plain : methods.end();
  };
  for (auto plain = is_unclear_variant(); plain != methods.end(); plain = is_unclear_variant())
    std::rotate(methods.begin(), methods.begin() + 1, plain + 1);
}

Result<MethodChoice> choose_method(render::Session& session, const render::Document& document,
                                   const bench::Progress& progress, const ChoiceOptions& options) {
  return Chooser(session, document, progress, options).choose();
}

render::Document with_choice(render::Document document, const MethodChoice& choice) {
  document.method = choice.method;
  document.automatic.reason = choice.reason;
  return document;
}

std::string choice_json(const MethodChoice& choice) {
  using nlohmann::json;
  const auto known = [](double value) { return std::isfinite(value) ? json(value) : json(); };
  json list = json::array();
  for (const ConsideredMethod& m : choice.considered) {
    json entry{{"name", m.name}, {"refusal", m.refusal.empty() ? json() : json(m.refusal)}};
    if (m.refusal.empty()) {
      entry["spp"] = m.samples;
      entry["cost"] = m.cost;
      entry["pilot_error"] = known(m.pilot_error);
      entry["predicted_error"] = known(m.predicted_error);
      entry["misses_light"] = m.misses_light;
    }
    list.push_back(entry);
  }
  return json{{"integrator", choice.method.integrator},
              {"sampler", choice.method.sampler},
              {"reason", choice.reason},
              {"error", Options<render::MinimisedError>::kOptions[static_cast<size_t>(choice.measure)].name},
              {"cost_unit", choice.by_time ? "seconds" : "rays"},
              {"seconds", choice.seconds},
              {"methods", list}}
      .dump();
}

}  // namespace etendue::advisor
