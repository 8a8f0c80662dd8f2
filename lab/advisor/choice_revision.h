// Revision of an automatic choice while the image is rendered, if the time is limited.
//
// After a part of the rendering, the pilots of the two best integrators of the choice continue. If the better one of the
// longer pilots is not the present integrator, it renders the rest of the time, and both images are averaged with
// weights in inverse proportion to their predicted variances. The decision and the weights depend on the pilots and on
// times only. The pilots have random numbers of their own, so the mean of unbiased images stays unbiased. A decision or a
// weight that depends on the noise of the image itself would bias it.
#pragma once
#include <optional>
#include <string>

#include "advisor/method_choice.h"

namespace etendue::advisor {

// The fraction of the rendering after which the choice is revised, and the fraction of the rendering time that the
// longer pilots may take.
inline constexpr double kRevisionTime = 0.25, kRevisionShare = 0.05;

struct Revision {
  render::MethodSettings method;  // that renders the rest
  std::string reason;             // empty if the method stays the same
  // Squared error times cost of the earlier and of the new method, in the image of the pilots.
  double earlier_inefficiency = 0, new_inefficiency = 0;
  double seconds = 0;  // that the revision took

  bool changes_method() const { return !reason.empty(); }
  // The weight of the earlier image in the mean, with the time that each method has rendered.
  double earlier_weight(double earlier_seconds, double new_seconds) const;
};

// Whether the choice can be revised: it was made by time, and a second integrator was compared.
bool is_revisable(const MethodChoice& choice);

// `seconds` is the rendering time of the whole image. All rendering takes place in `session`. Nothing changes if
// `progress` interrupts it. `options` as for the choice.
Revision revised_choice(render::Session& session, const render::Document& document, MethodChoice& choice,
                        double seconds, const bench::Progress& progress, const ChoiceOptions& options = {});

// The mean of two films of the same size in each half-buffer, with the number of samples of both. A half-buffer of a
// pixel without samples in one of the films is that of the other one.
film::Film weighted_mean(const film::Film& first, const film::Film& second, double first_weight);

}  // namespace etendue::advisor
