// Which method to use for what is on the desk: the question, and the answer as it gets better.
//
// While methods are tried out, the main rendering is paused. An edit of what the answer depends on ends that.
#pragma once
#include <optional>

#include "advisor/advisor.h"
#include "viewer/state/editor.h"
#include "viewer/tasks/progressive_task.h"

namespace etendue::viewer {

class Notices;

// What the user set.
struct AdviceSetup {
  std::optional<float> error;  // RMSE; none until it was chosen
  Number<float> pilot{"advice.pilot",
                      "Trial",
                      1,
                      {0.125f, 60},
                      "Seconds of rendering with which each method is tried out, about",
                      "s",
                      Scale::logarithmic};
};

class AdviceHand {
 public:
  AdviceHand(render::Session& session, Editor& editor, int threads, const std::function<void()>& wake)
      : session_(session), editor_(editor), threads_(threads), study_(wake) {}

  AdviceSetup setup;

  // The error to reach: what was chosen, else the document's limit, else a hundredth of the mean luminance.
  float target() const;
  // Takes the mean luminance from a picture, once for each scene.
  void look_at(const render::Frame& frame);

  void ask();
  void stop();
  void forget() { stop(), study_.clear(), setup.error.reset(), usual_.reset(); }
  // Takes a method of the ranking, and its error as the limit, in one step.
  void use(size_t row);

  // Null until there is something to say.
  const advisor::Ranking* shown() const { return study_.shown().get(); }
  bool fresh() const;
  bool running() const { return study_.running(); }
  double progress() const { return study_.progress(); }
  bool has_news() const { return study_.has_news(); }
  void advance(Notices& notices);

 private:
  render::Session& session_;
  Editor& editor_;
  const int threads_;
  bool was_paused_ = false;
  std::optional<float> usual_;
  render::Document document_;  // that the ranking is of
  Study<advisor::Ranking> study_;
};

// The knobs of the setup, as scripts see them.
std::vector<ParameterInfo> advice_parameters(const AdviceHand* hand = nullptr);

}  // namespace etendue::viewer
