// The choice of the integrator that renders a reference.
#pragma once
#include <span>
#include <string>

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

// The integrator with the smallest squared error times time, after pilots of this duration in seconds. Candidates are
// path tracing and the unbiased integrators of the methods that sample the same paths, have independent samples, and are
// used with the settings of the base document. A pilot that is significantly darker than another one is not chosen. Path
// tracing if there is no other candidate, or if it was interrupted.
std::string reference_integrator(render::Session& session, const render::Document& base,
                                 std::span<const MethodSpec> methods, double seconds, const Progress& progress);

}  // namespace etendue::bench
