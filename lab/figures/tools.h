// What the files of figures share.
#pragma once
#include "figures/figure.h"
#include "metrics/function_chart.h"
#include "metrics/plane_drawing.h"
#include "patterns/point_set.h"
#include "render/document.h"

namespace etendue::figures {

using metrics::Color;
using metrics::CurveStyle;
using metrics::FunctionChart;
using metrics::FunctionCurve;
using metrics::PlaneDrawing;
using metrics::PlaneDrawingSettings;
using metrics::Point;
using metrics::sampled;

// The colours of parts of a figure, in order, and a neutral one.
inline Color ink(size_t index) { return metrics::method_color(index); }
inline constexpr Color kGrey{150, 150, 150}, kLightGrey{220, 220, 220}, kBlack{34, 34, 34};
Color transparent(Color color, double opacity);

// A chart with axes and a legend.
Part chart_part(const FunctionChart& chart, int width = 420, int height = 300);
// A chart of curves over linear axes.
Part curves_part(const char* title, const char* x_label, const char* y_label, std::vector<FunctionCurve> curves,
                 int width = 420, int height = 300);
Part plane_part(std::string caption, const PlaneDrawing& plane);

// A point set in the unit square; the cells of a grid are drawn unless it has one column and row.
Part points_part(std::string caption, const patterns::PointSet& points, int columns = 1, int rows = 1);
std::vector<Point> to_points(const patterns::PointSet& set);

// ---- Renderings

// The built-in scene of this name with the settings "NAME=VALUE". Both must be valid.
render::Document document_of(const std::string& scene, std::initializer_list<const char*> settings = {});
void set(render::Document& document, std::initializer_list<const char*> settings);

struct RenderingSettings {
  uint32_t samples = 64;
  bool exact_samples = false;  // the number of samples is the subject of the figure: `effort` does not change it
  float exposure = 0;          // stops, relative to that of the document
  image::ToneCurve curve = image::ToneCurve::agx;
  double aspect = 1;  // width over height
  int columns = 1;    // of pictures that share the width of a single one
};
Part rendering_part(std::string caption, render::Document document, const MakeContext& context,
                    const RenderingSettings& settings = {});

// A picture of a function of the position (x, y) in the unit square, y upwards, with values 0 (black) to 1 (white).
Picture grey_picture(int size, const std::function<double(double, double)>& f);

}  // namespace etendue::figures
