// The choice of the integrator that renders a reference.
#pragma once
#include <span>
#include <string>
#include <vector>

#include "bench/method_spec.h"
#include "bench/progress.h"

namespace etendue::bench {

// A short rendering by one integrator.
struct ReferencePilot {
  std::string name;
  double cost = 0;                      // squared error times time; infinite if the error is unknown
  double mean = 0, standard_error = 0;  // luminance of the image
};

// The pilot with the smallest cost. One that is significantly darker than another has missed rare bright samples and is
// not chosen. Null if no pilot has a finite cost.
const ReferencePilot* most_efficient(std::span<const ReferencePilot> pilots);

// Integrators that may render the reference: path tracing, bidirectional path tracing if it samples the same paths of this
// scene, and the unbiased integrators of the methods that sample the same paths, have independent samples, and are used
// with the settings of the base document.
std::vector<std::string> reference_candidates(const render::Document& base, std::span<const MethodSpec> methods);

// The candidate with the smallest squared error times time, after pilots of this duration in seconds. A pilot that is
// significantly darker than another one is not chosen. Path tracing if it was interrupted.
std::string reference_integrator(render::Session& session, const render::Document& base,
                                 std::span<const MethodSpec> methods, double seconds, const Progress& progress);

}  // namespace etendue::bench
