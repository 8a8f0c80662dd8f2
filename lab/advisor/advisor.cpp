#include "advisor/advisor.h"

#include <algorithm>
#include <cmath>

#include "advisor/report_numbers.h"
#include "render/clock.h"
#include "render/incompatibility.h"
#include "scene/compiled_scene.h"

namespace etendue::advisor {
namespace {

using integrator::Bias;

// The fraction of the reported progress assigned to the path class table.
constexpr double kTableProgress = 0.2;
// For all pilots together, if the table has used up the time.
constexpr double kLeastPilotSeconds = 0.1;

double missing_error(const MissingPaths& misses, const ClassTable& table, film::ErrorMeasure measure,
                     const film::DisplayTransform& display) {
  if (measure == film::ErrorMeasure::rmse) return misses.rms;
  std::vector<ClassEnergy> energies;
  for (const MissingPathClass& c : misses.classes) energies.push_back(c.energy);
  return std::sqrt(measure == film::ErrorMeasure::relative
                       ? relative_square_of(energies, table.total.energy)
                       : displayed_square_of(energies, table.total.energy, display));
}

// Why a method is not suitable; empty if it is.
std::string exclusion_reason(const Advice& advice, const scene::CompiledScene& scene, const AdviceRequest& request) {
  const bench::MethodSpec& method = advice.method;
  const MissingPaths& misses = advice.misses;
  if (std::string incompatibility = render::incompatibility(method.document, scene); !incompatibility.empty())
    return incompatibility;
  const auto& info = *integrator::find_integrator(method.document.method.integrator);
  if (info.bias == Bias::biased) return "biased: more samples do not reduce its error below the bias";
  if (selects_techniques(method.document.method))
    return "its settings disable or isolate sampling techniques: the energy of the missing paths is unknown";
  if (advice.missing_error > kNegligible * request.target)
    return missing_paths_text(misses) + ": its " + film::measure_label(request.measure) + " stays above " +
           error_number(request.measure, advice.missing_error) + " for any rendering time";
  return {};
}

Advice advice_of(const bench::MethodSpec& method, const scene::CompiledScene& scene, const ClassTable& table,
                 const AdviceRequest& request) {
  Advice advice;
  advice.method = method;
  advice.misses = missing_paths(declared_paths(method.document, scene), table);
  advice.missing_error = missing_error(advice.misses, table, request.measure, method.document.display.transform());
  advice.reason = exclusion_reason(advice, scene, request);
  advice.suitable = advice.reason.empty();
  return advice;
}

// The error from noise at which the total error, including missing paths, reaches the target.
double noise_target(const Advice& advice, double target) {
  return std::sqrt(std::max(0.0, sqr(target) - sqr(advice.missing_error)));
}

void apply_pilot(Advice& advice, const Pilot& pilot, const SizeRatio& ratio, double target) {
  advice.pilot_samples = pilot.samples;
  advice.pilot_seconds = pilot.seconds;
  advice.pilot_error = pilot.error.value * ratio.error;
  advice.exponent = pilot.estimator.exponent();
  advice.time = pilot.time_to(noise_target(advice, target) / ratio.error);
  if (!advice.time) return;
  advice.time->seconds *= ratio.seconds;
  advice.time->interval.low *= ratio.seconds;
  advice.time->interval.high *= ratio.seconds;
}

// States both convergence rates if they differ significantly.
std::string exponent_text(const Advice& slow, const Advice& best) {
  const double standard_error = std::hypot(slow.exponent.error, best.exponent.error);
  if (best.exponent.value - slow.exponent.value < 2 * standard_error) return "";
  return "; its error falls as samples^-" + number(slow.exponent.value) + ", that of the fastest as samples^-" +
         number(best.exponent.value);
}

std::string rank_reason(const Advice& advice, const Advice& best) {
  if (!advice.time) return "the pilot was too short to measure an error; increase the pilot time";
  const std::string misses =
      advice.misses.none() ? "" : "; " + missing_paths_text(advice.misses) + ", which is negligible";
  if (&advice == &best) return "the fastest method that finds all relevant paths of this scene" + misses;
  const double ratio = advice.time->seconds / best.time->seconds;
  if (advice.time->interval.low <= best.time->interval.high)
    return "no significant difference to " + best.method.name + misses;
  return "takes " + times(ratio) + " times as long as " + best.method.name + exponent_text(advice, best) + misses;
}

void rank(Ranking& ranking) {
  std::ranges::stable_sort(ranking.methods, {}, [](const Advice& a) {
    return !a.suitable ? std::pair(2, 0.0) : !a.time ? std::pair(1, 0.0) : std::pair(0, a.time->seconds);
  });
  const Advice* best = ranking.best();
  for (Advice& advice : ranking.methods)
    if (advice.suitable) advice.reason = rank_reason(advice, best ? *best : advice);
}

}  // namespace

std::vector<bench::MethodSpec> candidates(const render::Document& document) {
  std::vector<bench::MethodSpec> list;
  for (const auto& integrator : integrator::integrator_infos())
    for (const auto& sampler : sampler_infos())
      if (!sampler.for_study)
        list.push_back(*bench::parse_method(integrator.name + ":sampler=" + sampler.name, document));
  return list;
}

Ranking advise(render::Session& session, const render::Document& document, const AdviceRequest& request,
               const bench::Progress& progress, const RankingPublisher& publish, const PlanPublisher& on_plan) {
  const auto start = render::Clock::now();
  Ranking ranking;
  ranking.target = request.target;
  ranking.measure = request.measure;
  const auto publish_ranking = [&] {
    if (publish) publish(ranking);
  };
  const bench::Progress table_progress = [&](double done, const std::string& what) {
    return progress(kTableProgress * done, what);
  };
  TableOptions table_options = request.table;
  if (request.seconds > 0 && table_options.seconds <= 0) table_options.seconds = kTableProgress * request.seconds;
  ranking.table = class_table(session, document, table_options, table_progress, [&](const ClassTable& table) {
    ranking.table = table;
    publish_ranking();
  });
  ranking.interrupted = !ranking.table.finished;
  if (ranking.interrupted) return ranking;
  // Compiled again because the last image of the table may have been rendered with some of the lights only.
  const auto scene = scene::compile(document.scene, document.camera, session.scene());
  ranking.beyond_methods = beyond_all_methods(*scene);

  std::vector<bench::MethodSpec> suitable;
  for (const auto& method : candidates(document)) {
    ranking.methods.push_back(advice_of(method, *scene, ranking.table, request));
    if (ranking.methods.back().suitable) suitable.push_back(method);
  }
  const bench::Progress pilot_progress = [&](double done, const std::string& what) {
    return progress(kTableProgress + (1 - kTableProgress) * done, what);
  };
  const auto update = [&](const Pilots& pilots) {
    for (const Pilot& pilot : pilots.pilots)
      for (Advice& advice : ranking.methods)
        if (advice.method.name == pilot.method.name) apply_pilot(advice, pilot, pilots.size_ratio, request.target);
    rank(ranking);
    publish_ranking();
  };
  const auto count = static_cast<double>(std::max<size_t>(1, suitable.size()));
  PilotPlan plan{
      .seconds = request.pilot_seconds, .target = request.target, .seed = request.seed, .measure = request.measure};
  if (request.seconds > 0) {
    plan.total_seconds = std::max(kLeastPilotSeconds, request.seconds - render::seconds_since(start));
    plan.seconds = std::min(plan.seconds, plan.total_seconds / count);
  }
  if (on_plan) on_plan(suitable.size(), plan.seconds * count);
  const auto pilots = run_pilots(session, suitable, plan, pilot_progress, update);
  update(pilots);
  ranking.interrupted = pilots.interrupted;
  return ranking;
}

}  // namespace etendue::advisor
