#include "advisor/method_comparison.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <ctime>

#include "advisor/advisor.h"
#include "advisor/integrator_costs.h"
#include "advisor/minimised_error.h"
#include "advisor/reference_integrator.h"
#include "base/vec.h"
#include "integrator/integrator_info.h"

namespace etendue::advisor {
namespace {

using integrator::Bias;

// A method ends early if its squared error at equal cost, by the lower end of the error's interval, exceeds that of the
// best one by this factor.
// FLIP of few samples is close to its largest value for every method.
double hopeless_factor(uint32_t samples, render::MinimisedError measure) {
  if (measure == render::MinimisedError::flip && samples < 32) return INFINITY;
  return samples < 8 ? 16 : samples < 32 ? 4 : samples < 64 ? 2 : 1.3;
}
// The rate of convergence of a pilot is continued for this factor in the number of samples; beyond, noise falls as 1/n.
constexpr double kLongestRate = 64;
constexpr uint32_t kFirstSamples = 2;  // of the first round: one per half-buffer
// Standard errors by which one image must be darker than another to count as incomplete.
constexpr double kDarker = 4;

Bias bias_of_integrator(const render::MethodSettings& method) {
  return integrator::find_integrator(method.integrator)->bias;
}

// The mean luminance of an image and its standard error, from the two half-buffers.
void measure_mean(ComparedMethod& m) {
  double sum = 0, variance = 0;
  for (int y = 0; y < m.film.height(); ++y)
    for (int x = 0; x < m.film.width(); ++x) {
      sum += double{luminance(m.film.mean(x, y))};
      variance += double{luminance(m.film.variance_of_mean(x, y))};
    }
  const auto pixels = static_cast<double>(std::max<size_t>(1, m.film.pixels().size()));
  m.mean = sum / pixels;
  m.standard_error = std::sqrt(variance) / pixels;
}

// The factor on the squared error of noise after `growth` times the samples. A rate above that of 1/n counts by the lower end of
// its interval, so that few samples do not promise too much.
double noise_left(const render::TimeEstimator& convergence, double growth) {
  const auto exponent = convergence.exponent();
  const double faster = std::max(0.0, exponent.value - exponent.error - 0.5);
  return std::pow(std::clamp(growth, 1.0, kLongestRate), -2 * faster) / growth;
}

// Whether the samples of a method are independent random numbers, whatever the sampler of the document.
bool has_independent_samples(const render::MethodSettings& method) {
  const auto group = integrator::find_integrator(method.integrator)->group;
  return group == integrator::Group::markov_chain || find_sampler(method.sampler)->independent;
}

double pixels_of(const render::Document& d) { return static_cast<double>(d.width) * d.height; }

class MethodRace {
 public:
  MethodRace(render::Session& session, const render::Document& document, const ComparisonPlan& plan,
             const bench::Progress& progress)
      : session_(session), document_(limited_to(document, plan.max_pixels)), plan_(plan), progress_(progress) {
    size_ratio_ = pixels_of(document_) / pixels_of(document);
    document_.seed = plan.seed;
    result_.budget = plan.budget;
  }

  Comparison run(std::vector<ComparedMethod> methods) {
    racing_ = std::move(methods);
    for (ComparedMethod& m : racing_)
      if (m.samples == 0) m.convergence = render::TimeEstimator(has_independent_samples(m.method));
    result_.interrupted = !run_rounds();
    rank();
    end_from(0);
    return std::move(result_);
  }

 private:
  // Returns false if interrupted.
  bool run_rounds() {
    // Pilots of an earlier comparison continue together.
    uint32_t first = kFirstSamples;
    for (const ComparedMethod& m : racing_) first = std::max(first, 2 * m.samples);
    for (uint32_t samples = first; samples <= plan_.max_samples; samples *= 2) {
      if (samples > kFirstSamples) make_affordable();
      if (racing_.size() < 2 && samples > kFirstSamples) return true;
      for (ComparedMethod& m : racing_) {
        const Outcome outcome = advance(m, samples);
        if (outcome == Outcome::interrupted) return false;
        if (outcome == Outcome::too_expensive) return true;
      }
      if (samples == kFirstSamples && plan_.budget_samples > 0) set_budget_from_samples();
      rank();
      end_hopeless(hopeless_factor(samples, plan_.measure));
    }
    return true;
  }

  // The next round doubles the cost of each method. While it exceeds the budget, the worse half ends.
  void make_affordable() {
    const auto next_round = [&] {
      double sum = 0;
      for (const ComparedMethod& m : racing_) sum += m.cost;
      return sum;
    };
    while (racing_.size() > 1 && result_.cost + next_round() > result_.budget) {
      end_from((racing_.size() + 1) / 2);
    }
  }

  void end_hopeless(double factor) {
    const double limit = std::sqrt(factor) * racing_.front().predicted_error;
    const auto first = std::ranges::stable_partition(racing_, [&](const ComparedMethod& m) {
      const double optimism = m.error.known && m.noise > 0 ? m.error.interval.low / std::sqrt(m.noise) : 1;
      return m.predicted_error * optimism <= limit;
    });
    end_from(static_cast<size_t>(first.begin() - racing_.begin()));
  }

  // Those that end later come first in the result.
  void end_from(size_t first) {
    const auto begin = racing_.begin() + static_cast<std::ptrdiff_t>(first);
    result_.methods.insert(result_.methods.begin(), std::move_iterator(begin), std::move_iterator(racing_.end()));
    racing_.erase(begin, racing_.end());
    std::ranges::stable_partition(result_.methods, [](const ComparedMethod& m) { return !m.misses_light; });
  }

  void rank() {
    predict();
    mark_incomplete();
    std::ranges::stable_sort(racing_, {},
                             [](const ComparedMethod& m) { return std::pair(m.misses_light, m.predicted_error); });
  }

  enum class Outcome { completed, interrupted, too_expensive };

  Outcome advance(ComparedMethod& m, uint32_t samples) {
    render::Document d = document_;
    d.method = m.method;
    d.limits = {samples, 0, 0};
    const std::clock_t start = std::clock();
    // A new pilot starts with an empty film: the session may hold samples of the same document.
    if (m.samples == 0) m.film = film::Film(d.width, d.height);
    const uint64_t version = session_.submit(d, render::ResumePoint(std::move(m.film), std::move(m.integrator_state)));
    bool is_interrupted = false;
    const auto keep_going = [&](const render::Status& status) {
      const double cost = result_.cost + plan_.cost(status, m.method);
      is_interrupted = !progress_(std::min(1.0, cost / result_.budget), "pilot of " + m.method.integrator);
      return !is_interrupted && !(plan_.strict && cost > result_.budget);
    };
    const bool completed = bench::wait_for(session_, version, keep_going);
    const auto status = session_.status();
    render::ResumePoint point = session_.resume_point();
    m.film = std::move(point.film);
    m.integrator_state = std::move(point.integrator_state);
    const double cost = plan_.cost(status, m.method);
    m.cost += cost;
    result_.cost += cost;
    if (!completed) {
      // An image with different numbers of samples per pixel is not comparable; the earlier measurement stays.
      m.cost -= cost;
      m.film = {};
      return is_interrupted ? Outcome::interrupted : Outcome::too_expensive;
    }
    m.processor_seconds += static_cast<double>(std::clock() - start) / CLOCKS_PER_SEC;
    m.samples = status.samples;
    m.error = measured_error(m.film, plan_.measure, d.display.transform());
    m.convergence.add(m.samples, m.cost, m.error);
    measure_mean(m);
    if (plan_.measure == render::MinimisedError::flip) {
      const film::MeasuredError relative = film::measured_error(m.film, film::ErrorMeasure::relative, {});
      m.relative_error = relative.known ? relative.interval.high : INFINITY;
    }
    return Outcome::completed;
  }

  void set_budget_from_samples() {
    double cheapest = INFINITY;
    for (const ComparedMethod& m : racing_) cheapest = std::min(cheapest, m.cost / m.samples);
    result_.budget = plan_.budget_samples / pixels_of(document_) * cheapest;
  }

  // The method of the race with the smallest error that is not biased; null if there is none.
  const ComparedMethod* reference_for(const ComparedMethod& m) const {
    const ComparedMethod* best = nullptr;
    for (const auto* list : {&racing_, &result_.methods})
      for (const ComparedMethod& other : *list)
        if (&other != &m && other.error.known && !other.film.pixels().empty() &&
            bias_of_integrator(other.method) == Bias::unbiased && (!best || other.error.value < best->error.value))
          best = &other;
    return best;
  }

  double comparable_cost(const ComparedMethod& m) const {
    if (!plan_.by_processor_time) return m.cost;
    double cost = 0, processor_seconds = 0;
    for (const auto* list : {&racing_, &result_.methods})
      for (const ComparedMethod& other : *list) {
        cost += other.cost;
        processor_seconds += other.processor_seconds;
      }
    return processor_seconds > 0 && m.processor_seconds > 0 ? m.processor_seconds * cost / processor_seconds : m.cost;
  }

  // The squared bias of a method, from the pilot of an unbiased one; an upper bound of two standard errors.
  double squared_bias(const ComparedMethod& m) const {
    if (bias_of_integrator(m.method) == Bias::unbiased) return 0;
    const ComparedMethod* other = reference_for(m);
    if (!other || m.film.pixels().empty()) return m.bias;
    const MeanSquare square = squared_error(m.film, other->film, plan_.measure, document_.display.transform());
    return std::max(0.0, square.value + 2 * square.standard_error - sqr(m.error.value));
  }

  // The squared FLIP of a pilot against the most accurate other one. Half-buffers that both lack rare bright light look alike,
  // so FLIP between them is too small.
  double squared_flip(const ComparedMethod& m) const {
    const ComparedMethod* best = nullptr;
    for (const auto* list : {&racing_, &result_.methods})
      for (const ComparedMethod& other : *list)
        if (&other != &m && std::isfinite(other.relative_error) && !other.film.pixels().empty() &&
            bias_of_integrator(other.method) == Bias::unbiased &&
            (!best || other.relative_error < best->relative_error))
          best = &other;
    if (!best || m.film.pixels().empty()) return 0;
    return squared_error(m.film, best->film, plan_.measure, document_.display.transform()).value;
  }

  // Predicts the errors at the horizon. Noise falls at the rate that the rounds have shown, which for points of a sequence
  // may be faster than 1/n. The bias of consistent methods falls as n^-2/3, that of progressive photon mapping [Hachisuka
  // and Jensen 2009]; that of biased ones stays. Rare bright samples make an estimated error too small; the geometric mean
  // of the estimate and the upper end of its interval is used.
  void predict() {
    for (ComparedMethod& m : racing_) {
      m.predicted_error = INFINITY;
      if (!m.error.known || m.cost <= 0) continue;
      m.noise = m.error.value * m.error.interval.high;
      if (plan_.measure == render::MinimisedError::flip) m.noise = std::max(m.noise, squared_flip(m));
      m.bias = squared_bias(m);
      const double growth = size_ratio_ * plan_.horizon * result_.budget / comparable_cost(m);
      const double bias_left = bias_of_integrator(m.method) == Bias::biased ? 1 : std::pow(growth, -2.0 / 3);
      m.predicted_error = std::sqrt(m.noise * noise_left(m.convergence, growth) + m.bias * bias_left + m.missing);
    }
  }

  void mark_incomplete() {
    const auto is_darker = [](const ComparedMethod& m, const ComparedMethod& other) {
      return m.error.known && other.error.known &&
             other.mean - m.mean > kDarker * std::hypot(m.standard_error, other.standard_error);
    };
    const auto has_brighter = [&](const ComparedMethod& m, const std::vector<ComparedMethod>& others) {
      return std::ranges::any_of(others, [&](const ComparedMethod& other) {
        return bias_of_integrator(other.method) == Bias::unbiased && is_darker(m, other);
      });
    };
    for (auto* list : {&racing_, &result_.methods})
      for (ComparedMethod& m : *list)
        m.misses_light = m.missing > sqr(kNegligible * m.predicted_error) || has_brighter(m, racing_) ||
                         has_brighter(m, result_.methods);
  }

  render::Session& session_;
  render::Document document_;
  const ComparisonPlan& plan_;
  const bench::Progress& progress_;
  double size_ratio_ = 1;  // pixels of a pilot divided by those of the document
  std::vector<ComparedMethod> racing_;
  Comparison result_;  // with the methods that have ended
};

}  // namespace

double time_cost(const render::Status& status, const render::MethodSettings&) { return status.seconds; }

double ray_cost(const render::Status& status, const render::MethodSettings& method) {
  return time_per_ray(method.integrator) * static_cast<double>(status.rays);
}

Comparison compare_methods(render::Session& session, const render::Document& document,
                           std::vector<ComparedMethod> methods, const ComparisonPlan& plan,
                           const bench::Progress& progress) {
  return MethodRace(session, document, plan, progress).run(std::move(methods));
}

}  // namespace etendue::advisor
