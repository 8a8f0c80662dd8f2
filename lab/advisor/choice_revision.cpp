#include "advisor/choice_revision.h"

#include <algorithm>
#include <chrono>
#include <cmath>

#include "advisor/minimised_error.h"
#include "advisor/report_numbers.h"
#include "base/hash.h"

namespace etendue::advisor {
namespace {

// The error of the new method must be smaller than this fraction of the present one's at equal time.
constexpr double kRevisionGain = 0.85;

double clock_seconds() {
  return std::chrono::duration<double>(std::chrono::steady_clock::now().time_since_epoch()).count();
}

double inefficiency(const ComparedMethod& m) { return m.noise * m.cost; }

}  // namespace

double Revision::earlier_weight(double earlier_seconds, double new_seconds) const {
  const double earlier = earlier_seconds / earlier_inefficiency, later = new_seconds / new_inefficiency;
  return earlier / (earlier + later);
}

bool is_revisable(const MethodChoice& choice) {
  return choice.by_time && !choice.interrupted && choice.finalists.size() == 2;
}

Revision revised_choice(render::Session& session, const render::Document& document, MethodChoice& choice,
                        double seconds, const bench::Progress& progress, const ChoiceOptions& options) {
  const auto clock = options.clock ? options.clock : clock_seconds;
  const double start = clock();
  Revision revision{.method = choice.method, .reason = {}};
  ComparisonPlan plan;
  plan.measure = choice.measure;
  plan.cost = options.cost ? options.cost : time_cost;
  plan.budget = kRevisionShare * seconds;
  plan.by_processor_time = !options.cost;
  plan.horizon = 1 / kRevisionShare;
  plan.max_pixels = choice.pilot_pixels;
  plan.seed = choice.pilot_seed;
  const auto shown_progress = [&](double done, const std::string& what) {
    return progress(done, "revising the choice of the integrator: " + what);
  };
  const std::string present = choice.method.integrator;
  const Comparison comparison = compare_methods(session, document, std::move(choice.finalists), plan, shown_progress);
  revision.seconds = clock() - start;
  choice.finalists.clear();
  const auto is_present = [&](const ComparedMethod& m) { return m.method == revision.method; };
  const auto now = std::ranges::find_if(comparison.methods, is_present);
  const ComparedMethod& best = comparison.methods.front();
  if (comparison.interrupted || now == comparison.methods.end() || is_present(best)) return revision;
  const bool is_better = best.predicted_error < kRevisionGain * now->predicted_error || now->misses_light;
  if (!is_better || best.misses_light || !std::isfinite(best.predicted_error)) return revision;
  revision.method = best.method;
  revision.earlier_inefficiency = inefficiency(*now);
  revision.new_inefficiency = inefficiency(best);
  revision.reason =
      best.method.integrator + " instead of " + present + ": in longer pilots, " + present + " has " +
      times(shown_error(choice.measure, now->predicted_error) / shown_error(choice.measure, best.predicted_error)) +
      " times its " + minimised_label(choice.measure);
  return revision;
}

film::Film weighted_mean(const film::Film& first, const film::Film& second, double first_weight) {
  film::Film mean(first.width(), first.height());
  for (int y = 0; y < first.height(); ++y)
    for (int x = 0; x < first.width(); ++x)
      for (uint32_t half = 0; half < film::kHalfBuffers; ++half) {
        const uint32_t n = first.half_buffer_samples(x, y, half), m = second.half_buffer_samples(x, y, half);
        if (n + m == 0) continue;
        const double weight = n == 0 ? 0 : m == 0 ? 1 : first_weight;
        const auto a = first.sum(x, y, half), b = second.sum(x, y, half);
        std::array<double, 3> sum{};
        for (size_t c = 0; c < 3; ++c) {
          if (n > 0) sum[c] += weight * a[c] / n * (n + m);
          if (m > 0) sum[c] += (1 - weight) * b[c] / m * (n + m);
        }
        mean.add_sum(x, y, half, sum, n + m);
      }
  return mean;
}

}  // namespace etendue::advisor
