// Costs of integrators that do not depend on the machine.
#pragma once
#include <string_view>

namespace etendue::advisor {

// The time per ray of an integrator relative to path tracing. Geometric means over the built-in scenes cornell-spheres,
// glossy-plates, spot-indirect and many-lights with 128 x 128 pixels on one thread; single scenes deviate by factors of up
// to two, for photonmap three. Measured with bench/methods_bench. 1 for an unknown integrator.
double time_per_ray(std::string_view integrator);

// Whether the integrator has a measured cost; every integrator of the registry should.
bool has_measured_cost(std::string_view integrator);

// The integrator of which this one is a variant that spends more on each sample, by branching or learning; empty if there is
// none.
std::string_view plain_form_of(std::string_view integrator);

}  // namespace etendue::advisor
