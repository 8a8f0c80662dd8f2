// The group of the Render panel that recommends an integrator.
#pragma once
#include <nlohmann/json_fwd.hpp>
#include <optional>
#include <string>
#include <vector>

#include "viewer/panels/panel.h"
#include "viewer/tasks/recommendation_task.h"

namespace etendue::viewer {

class RecommendationSection {
 public:
  void draw(AppState& state);
  void add_actions(ActionList& actions);
  std::vector<ItemInfo> items() const;
  std::vector<ParameterInfo> parameters() const { return task_.describe_defaults(nullptr); }
  std::optional<Value> default_value(const AppState& state, const std::string& name) const;
  WaitCondition wait_condition();
  nlohmann::json report(const AppState& state) const;

  RecommendationTask& task() { return task_; }

 private:
  void draw_parameters(AppState& state);
  void draw_ranking(AppState& state, const advisor::Ranking& ranking);
  bool draw_method(AppState& state, const advisor::Advice& advice, size_t row) const;

  RecommendationTask task_;
  bool shows_all_ = false;   // of the ranking, otherwise the best ones
  bool scrolls_to_ = false;  // the section is to be brought on screen
};

}  // namespace etendue::viewer
