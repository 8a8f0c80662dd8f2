#include "advisor/integrator_costs.h"

#include <algorithm>
#include <array>

namespace etendue::advisor {
namespace {

struct Cost {
  std::string_view integrator;
  double time_per_ray;
  std::string_view plain_form = "";
};

constexpr std::array kCosts{Cost{"raycast", 1.2},
                            Cost{"appel", 1.2},
                            Cost{"whitted", 1.3},
                            Cost{"distribution", 1.2, "path"},
                            Cost{"path-pure", 0.85},
                            Cost{"path", 1},
                            Cost{"path-guided", 1.9, "path"},
                            Cost{"path-control", 1.1, "path"},
                            Cost{"path-manifold", 2.2},
                            Cost{"light-pure", 1.25},
                            Cost{"light", 1.1},
                            Cost{"bdpt", 1.2},
                            Cost{"bdpt-guided", 1.9, "bdpt"},
                            Cost{"vcm", 2},
                            Cost{"mlt", 2.4},
                            Cost{"pssmlt", 1.7},
                            Cost{"photonmap", 5.8},
                            Cost{"sppm", 1.4},
                            Cost{"igi", 0.6},
                            Cost{"radiosity", 1}};

const Cost* find(std::string_view integrator) {
  const auto* found = std::ranges::find(kCosts, integrator, &Cost::integrator);
  return found == kCosts.end() ? nullptr : found;
}

}  // namespace

double time_per_ray(std::string_view integrator) {
  const Cost* cost = find(integrator);
  return cost ? cost->time_per_ray : 1;
}

std::string_view plain_form_of(std::string_view integrator) {
  const Cost* cost = find(integrator);
  return cost ? cost->plain_form : "";
}

bool has_measured_cost(std::string_view integrator) { return find(integrator) != nullptr; }

}  // namespace etendue::advisor
