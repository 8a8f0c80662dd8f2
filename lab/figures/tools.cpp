#include "figures/tools.h"

#include <algorithm>
#include <cmath>

#include "film/film_image.h"
#include "image/display.h"
#include "render/session.h"

namespace etendue::figures {

Color transparent(Color color, double opacity) {
  color.opacity = opacity;
  return color;
}

Part chart_part(const FunctionChart& chart, int width, int height) {
  metrics::ChartOptions options;
  options.width = width;
  options.height = height;
  return {.caption = {}, .content = metrics::function_drawing(chart, options)};
}

Part curves_part(const char* title, const char* x_label, const char* y_label, std::vector<FunctionCurve> curves,
                 int width, int height) {
  return chart_part({.title = title, .x_label = x_label, .y_label = y_label, .curves = std::move(curves)}, width,
                    height);
}

Part plane_part(std::string caption, const PlaneDrawing& plane) {
  auto drawing = plane.finished(caption);
  return {.caption = std::move(caption), .content = std::move(drawing)};
}

std::vector<Point> to_points(const patterns::PointSet& set) {
  std::vector<Point> points;
  for (const auto& p : set) points.push_back({p[0], p[1]});
  return points;
}

Part points_part(std::string caption, const patterns::PointSet& points, int columns, int rows) {
  PlaneDrawing plane;
  plane.grid(columns, rows, kLightGrey);
  plane.dots(to_points(points), ink(0), points.size() > 300 ? 1.6 : 2.4);
  return plane_part(std::move(caption), plane);
}

void set(render::Document& document, std::initializer_list<const char*> settings) {
  for (const std::string_view text : settings) {
    const size_t sign = text.find('=');
    document = *render::with_text(document, text.substr(0, sign), text.substr(sign + 1));
  }
}

render::Document document_of(const std::string& scene, std::initializer_list<const char*> settings) {
  render::Document document = *render::new_document(scene);
  set(document, settings);
  return document;
}

Part rendering_part(std::string caption, render::Document document, const MakeContext& context,
                    const RenderingSettings& settings) {
  document.width = std::max(16, context.width / settings.columns);
  document.height = std::max(16, static_cast<int>(std::lround(document.width / settings.aspect)));
  document.seed = context.seed;
  const double samples = settings.exact_samples ? settings.samples : std::ceil(settings.samples * context.effort);
  const film::Film film = render::rendered(document, static_cast<uint32_t>(std::max(1.0, samples)), context.threads);
  auto pixels =
      image::display_pixels(film::radiance_of(film), document.display.exposure + settings.exposure, settings.curve);
  return {.caption = std::move(caption), .content = Picture{document.width, document.height, std::move(pixels)}};
}

Picture grey_picture(int size, const std::function<double(double, double)>& f) {
  Picture picture{size, size, {}};
  for (int row = 0; row < size; ++row)
    for (int column = 0; column < size; ++column) {
      const double value = std::clamp(f((column + 0.5) / size, 1 - (row + 0.5) / size), 0.0, 1.0);
      picture.pixels.insert(picture.pixels.end(), 3, static_cast<uint8_t>(std::lround(255 * value)));
    }
  return picture;
}

}  // namespace etendue::figures
