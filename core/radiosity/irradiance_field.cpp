#include "radiosity/irradiance_field.h"

#include <algorithm>
#include <cmath>
#include <limits>

namespace etendue::radiosity {
namespace {

double largest_of(const std::vector<double>& values) { return values.empty() ? 0 : *std::ranges::max_element(values); }

}  // namespace

RadiositySystem reflected_light_system(const FormFactors& factors, const std::vector<Rgb>& reflectance,
                                       const std::vector<Rgb>& direct, int component) {
  RadiositySystem system{&factors, std::vector<double>(direct.size()), std::vector<double>(direct.size())};
  for (size_t i = 0; i < direct.size(); ++i) {
    system.reflectance[i] = static_cast<double>(reflectance[i / 2][component]);
    system.source[i] = system.reflectance[i] * static_cast<double>(direct[i][component]);
  }
  return system;
}

ComponentSolution::ComponentSolution(const FormFactors& factors, const std::vector<Rgb>& reflectance,
                                     const std::vector<Rgb>& direct, int component, const FieldSettings& settings)
    : settings_(settings),
      component_(component),
      system_(reflected_light_system(factors, reflectance, direct, component)) {
  const size_t n = direct.size();
  direct_.reserve(n);
  for (const Rgb& light : direct) direct_.push_back(static_cast<double>(light[component]));
  for (auto* values : {&total_, &indirect_, &gathered_, &unshot_}) values->resize(n);
  if (settings_.counted.empty()) {
    run_ = std::make_unique<SolverRun>(settings_.solver, system_, settings_.settings);
  } else {
    term_ = direct_;
    next_term_.resize(n);
  }
}

bool ComponentSolution::run(const KeepGoing* keep_going) {
  if (!run_) return add_counted_terms(keep_going);
  if (!run_->run(keep_going)) return false;
  finish_solution();
  return true;
}

void ComponentSolution::finish_solution() {
  const Solution& solution = run_->solution();
  sweeps_ = static_cast<int>(solution.residuals.size()) - 1;
  error_bound_ = solution.error_bound;
  problem_ = solution.problem;
  has_diverged_ = solution.status == SolverStatus::diverged;
  if (has_diverged_) return keep_direct_light();
  for (size_t i = 0; i < direct_.size(); ++i) {
    indirect_[i] = system_.factors->row_times(i, solution.radiosity);
    gathered_[i] = total_[i] = direct_[i] + indirect_[i];
    unshot_[i] = system_.source[i] - solution.radiosity[i] + system_.reflectance[i] * indirect_[i];
  }
}

void ComponentSolution::keep_direct_light() {
  const std::vector<double> none(direct_.size());
  const bool all = settings_.counted.empty();
  total_ = all || counts(1) ? direct_ : none;
  gathered_ = all || counts(2) ? direct_ : none;
  indirect_ = none;
  unshot_ = system_.source;
}

// Adds the terms of the Neumann series that count. The remaining terms are bounded by a geometric series.
bool ComponentSolution::add_counted_terms(const KeepGoing* keep_going) {
  const auto cost = [&](size_t i) { return 1 + system_.factors->exchanges(i).size(); };
  const auto reflect = [&](size_t i) {
    double sum = 0;
    for (const FormFactor& f : system_.factors->exchanges(i))
      sum += static_cast<double>(f.value) * system_.reflectance[f.element] * term_[f.element];
    next_term_[i] = sum / system_.factors->areas()[i];
  };
  for (; term_number_ < settings_.counted.size(); ++term_number_) {
    if (!term_is_added_) add_term();
    term_is_added_ = true;
    if (is_last_term()) break;
    if (!continue_loop(next_, direct_.size(), keep_going, cost, reflect)) return false;
    next_ = 0;
    term_.swap(next_term_);
    term_is_added_ = false;
    sweeps_ = static_cast<int>(term_number_);
  }
  return true;
}

void ComponentSolution::add_term() {
  const size_t n = term_number_;
  for (size_t i = 0; i < term_.size(); ++i) {
    if (counts(n)) total_[i] += term_[i];
    if (counts(n) && n >= 2) indirect_[i] += term_[i];
    if (counts(n + 1)) gathered_[i] += term_[i];
  }
}

// Whether the current term is the last one that has to be added.
bool ComponentSolution::is_last_term() {
  const auto behind = settings_.counted.begin() + static_cast<std::ptrdiff_t>(term_number_) + 1;
  if (std::find(behind, settings_.counted.end(), true) == settings_.counted.end()) {
    // The list ends with paths that count if the number of reflections has no limit.
    if (settings_.counted.back() && largest_of(term_) > settings_.settings.tolerance * largest_of(direct_)) {
      problem_ = "the reflections do not become darker: paths with more than " +
                 std::to_string(settings_.counted.size() - 1) +
                 " reflections are left out; lower reflectances below 1, or limit radiosity.max-depth";
      error_bound_ = std::numeric_limits<double>::infinity();
    }
    return true;
  }
  const double q = system_.contraction(), size = largest_of(direct_);
  const double rest = q < 1 ? largest_of(term_) * q / (1 - q) : HUGE_VAL;
  if (!std::isfinite(largest_of(term_)) || largest_of(term_) > 1e30 * size) {
    has_diverged_ = size > 0;
    problem_ = "the light grows with every reflection: lower reflectances below 1";
    if (has_diverged_) keep_direct_light();
    return true;
  }
  return rest <= settings_.settings.tolerance * size;
}

ResidualHistory ComponentSolution::history() const {
  if (!run_) return {};
  return {run_->solution().residuals, run_->solution().seconds};
}

void ComponentSolution::write_to(IrradianceField& field) const {
  field.sweeps = std::max(field.sweeps, sweeps_);
  field.error_bound = std::max(field.error_bound, error_bound_);
  if (field.problem.empty()) field.problem = problem_;
  field.has_diverged = field.has_diverged || has_diverged_;
  field.history[static_cast<size_t>(component_)] = history();
  for (size_t i = 0; i < direct_.size(); ++i) {
    field.total[i][component_] = static_cast<float>(total_[i]);
    field.indirect[i][component_] = static_cast<float>(indirect_[i]);
    field.gathered[i][component_] = static_cast<float>(gathered_[i]);
    field.unshot[i][component_] = static_cast<float>(unshot_[i]);
  }
}

IrradianceField combined_field(const std::array<std::unique_ptr<ComponentSolution>, 3>& components, size_t elements) {
  const bool has_diverged = std::ranges::any_of(components, [](const auto& c) { return c->has_diverged(); });
  IrradianceField field;
  for (auto* values : {&field.total, &field.indirect, &field.gathered, &field.unshot}) values->resize(elements);
  for (const auto& component : components) {
    // All components show the same paths.
    if (has_diverged) component->keep_direct_light();
    component->write_to(field);
  }
  return field;
}

IrradianceField solve_field(const FormFactors& factors, const std::vector<Rgb>& reflectance,
                            const std::vector<Rgb>& direct, const FieldSettings& settings) {
  std::array<std::unique_ptr<ComponentSolution>, 3> components;
  for (size_t c = 0; c < 3; ++c) {
    components[c] = std::make_unique<ComponentSolution>(factors, reflectance, direct, static_cast<int>(c), settings);
    components[c]->run(nullptr);
  }
  return combined_field(components, direct.size());
}

}  // namespace etendue::radiosity
