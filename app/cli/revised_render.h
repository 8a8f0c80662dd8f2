// A rendering with a time limit whose automatically chosen integrator is revised once (advisor/choice_revision.h).
#pragma once
#include <atomic>

#include "advisor/method_choice.h"
#include "render/session.h"

namespace etendue::cli {

struct RevisedRendering {
  render::Document document;  // with the method that rendered last, and the reason
  render::Status status;      // of both methods together
};

// `document` has the chosen method; `seconds` is the time that is left after the choice. Afterwards the session holds the
// final film. Prints the reason if the method changes.
RevisedRendering render_with_revision(render::Session& session, render::Document document,
                                      advisor::MethodChoice& choice, double seconds,
                                      const std::atomic<bool>& interrupted);

}  // namespace etendue::cli
