// A small chart in a panel: two axes with figures, and where values lie between them.
#pragma once
#include <imgui.h>

#include <string>
#include <vector>

#include "metrics/log_axis.h"
#include "viewer/state/app_state.h"

namespace etendue::viewer {

struct PlotAxis {
  bool logarithmic = false;
  double low = 0, high = 1;

  // 0 at the low end, 1 at the high end.
  double share(double value) const;
  // At round values; at most about `most` have a label.
  std::vector<metrics::LogAxis::Tick> ticks(int most) const;
};

class Plot {
 public:
  // In `frame`, with room for the title above and the figures at the axes.
  Plot(const Workbench& w, ImDrawList* draw, const Placement& frame, const char* title, const PlotAxis& x,
       const PlotAxis& y);

  const Placement& inner() const { return inner_; }
  ImVec2 at(double x, double y) const;
  // Grid lines and figures; what comes after lies on them.
  void draw_axes() const;
  void curve(const std::vector<ImVec2>& points, ImU32 color, float width) const;
  // Figures with their middle, or an end, at a place.
  void words(ImVec2 at, float anchor, ImU32 color, const char* text) const;

 private:
  const Workbench& w_;
  ImDrawList* draw_;
  Placement frame_, inner_;
  const char* title_;
  PlotAxis x_, y_;
  std::vector<metrics::LogAxis::Tick> across_, up_;
};

// Distinct to every eye (M. Okabe and K. Ito): the two halves of a film.
ImU32 half_color(const Workbench& w, int half);

}  // namespace etendue::viewer
