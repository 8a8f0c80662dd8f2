// A small chart in a panel: two axes with labels, and the positions of values between them.
#pragma once
#include <imgui.h>

#include <string>
#include <vector>

#include "metrics/log_axis.h"
#include "viewer/viewport/placement.h"

namespace etendue::viewer {

struct UiContext;

struct PlotAxis {
  bool logarithmic = false;
  double low = 0;
  double high = 1;

  // The position of a value: 0 at the low end, 1 at the high end.
  double position(double value) const;
  // Ticks at round values. At most about `max_labels` of them have a label.
  std::vector<metrics::LogAxis::Tick> ticks(int max_labels) const;
};

class Plot {
 public:
  // `frame` is the rectangle of the window for the chart with its title and labels.
  Plot(const UiContext& ui, ImDrawList* draw, const Placement& frame, const char* title, const PlotAxis& x,
       const PlotAxis& y);

  // The rectangle between the axes.
  const Placement& area() const { return area_; }
  // The position of a point in the window.
  ImVec2 at(double x, double y) const;
  void draw_axes() const;
  void draw_curve(const std::vector<ImVec2>& points, ImU32 color, float width) const;
  // Text whose left end (anchor 0), centre (0.5) or right end (1) is at a position.
  void draw_text(ImVec2 position, float anchor, ImU32 color, const char* text) const;

 private:
  const UiContext& ui_;
  ImDrawList* draw_;
  Placement frame_;
  Placement area_;
  const char* title_;
  PlotAxis x_;
  PlotAxis y_;
  std::vector<metrics::LogAxis::Tick> x_ticks_;
  std::vector<metrics::LogAxis::Tick> y_ticks_;
};

// The colours of the two half-buffers of the film, from the palette of Okabe and Ito, which is safe for colour-blind
// readers.
ImU32 half_buffer_color(const UiContext& ui, int half);

}  // namespace etendue::viewer
