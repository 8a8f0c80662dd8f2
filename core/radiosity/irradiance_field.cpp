#include "radiosity/irradiance_field.h"

#include <algorithm>

namespace etendue::radiosity {
namespace {

// One colour component of a field.
struct Component {
  std::vector<double> total, indirect, gathered;
};

void solve_all_paths(const RadiositySystem& system, const std::vector<double>& direct, const FieldSettings& settings,
                     Component& c, IrradianceField& field) {
  Solution solution = solve(settings.solver, system, settings.settings);
  field.sweeps = std::max(field.sweeps, static_cast<int>(solution.residuals.size()) - 1);
  field.error_bound = std::max(field.error_bound, solution.error_bound);
  if (field.problem.empty()) field.problem = solution.problem;
  for (size_t i = 0; i < direct.size(); ++i) {
    c.indirect[i] = system.factors->row_times(i, solution.radiosity);
    c.gathered[i] = c.total[i] = direct[i] + c.indirect[i];
  }
}

double largest_of(const std::vector<double>& values) { return values.empty() ? 0 : *std::ranges::max_element(values); }

// Adds the terms of the Neumann series that count. The remaining terms are bounded by a geometric series.
void add_counted_terms(const RadiositySystem& system, const std::vector<double>& direct, const FieldSettings& settings,
                       Component& c, IrradianceField& field) {
  const CountedReflections& counted = settings.counted;
  const auto counts = [&](size_t n) { return n < counted.size() && counted[n]; };
  const double q = system.contraction(), size = largest_of(direct);
  std::vector<double> term = direct, radiosity(term.size());
  for (size_t n = 1; n < counted.size(); ++n) {
    for (size_t i = 0; i < term.size(); ++i) {
      if (counts(n)) c.total[i] += term[i];
      if (counts(n) && n >= 2) c.indirect[i] += term[i];
      if (counts(n + 1)) c.gathered[i] += term[i];
    }
    const double rest = q < 1 ? largest_of(term) * q / (1 - q) : HUGE_VAL;
    if (rest <= settings.settings.tolerance * size) break;
    if (std::find(counted.begin() + static_cast<std::ptrdiff_t>(n) + 1, counted.end(), true) == counted.end()) break;
    for (size_t i = 0; i < term.size(); ++i) radiosity[i] = system.reflectance[i] * term[i];
    for (size_t i = 0; i < term.size(); ++i) term[i] = system.factors->row_times(i, radiosity);
    field.sweeps = std::max(field.sweeps, static_cast<int>(n));
  }
}

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

IrradianceField solve_field(const FormFactors& factors, const std::vector<Rgb>& reflectance,
                            const std::vector<Rgb>& direct, const FieldSettings& settings) {
  const size_t n = direct.size();
  IrradianceField field;
  field.total.resize(n);
  field.indirect.resize(n);
  field.gathered.resize(n);
  for (int component = 0; component < 3; ++component) {
    const RadiositySystem system = reflected_light_system(factors, reflectance, direct, component);
    std::vector<double> received(n);
    for (size_t i = 0; i < n; ++i) received[i] = static_cast<double>(direct[i][component]);
    Component c{std::vector<double>(n), std::vector<double>(n), std::vector<double>(n)};
    if (settings.counted.empty())
      solve_all_paths(system, received, settings, c, field);
    else
      add_counted_terms(system, received, settings, c, field);
    for (size_t i = 0; i < n; ++i) {
      field.total[i][component] = static_cast<float>(c.total[i]);
      field.indirect[i][component] = static_cast<float>(c.indirect[i]);
      field.gathered[i][component] = static_cast<float>(c.gathered[i]);
    }
  }
  return field;
}

}  // namespace etendue::radiosity
