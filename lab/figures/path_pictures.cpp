#include "figures/path_pictures.h"

#include <algorithm>
#include <cmath>

#include "scene/compiled_scene.h"
#include "trace/trace_drawing.h"

namespace etendue::figures {
namespace {

constexpr uint32_t kRatedSamples = 256;

// The picture, brightened, with the drawing on it as if with ink.
Picture drawn_over(const Picture& picture, const metrics::Drawing& drawing) {
  Picture result = picture;
  const std::vector<uint8_t> ink_on_white = metrics::rasterize(drawing);
  for (size_t i = 0; i < result.pixels.size(); ++i)
    result.pixels[i] = static_cast<uint8_t>(result.pixels[i] * ink_on_white[i] / 255);
  return result;
}

Picture faded(Picture picture) {
  for (uint8_t& value : picture.pixels) value = static_cast<uint8_t>(150 + 105 * value / 255);
  return picture;
}

Picture background_of(const render::Document& document, const MakeContext& context) {
  render::Document lit = document;
  set(lit, {"integrator=path", "path.max-depth=0"});
  return faded(std::get<Picture>(rendering_part("", lit, context, {.samples = 64}).content));
}

Vec2i pixel_of(Vec2 position, Vec2i size) { return Vec2i(position * Vec2(size)); }

render::Document sized(render::Document document, Vec2i size, const MakeContext& context) {
  document.width = size.x;
  document.height = size.y;
  document.seed = context.seed;
  return document;
}

// The place of each vertex of a tree: leaves are equidistant, and other vertices stand above the middle of theirs.
class TreeLayout {
 public:
  explicit TreeLayout(const std::vector<transport::RecordedVertex>& vertices)
      : vertices_(vertices), children_(vertices.size()), x_(vertices.size()) {
    for (size_t i = 0; i < vertices.size(); ++i)
      (vertices[i].parent < 0 ? roots_ : children_[static_cast<size_t>(vertices[i].parent)]).push_back(i);
    for (const size_t root : roots_) place(root);
  }

  double x(size_t vertex) const { return x_[vertex]; }
  double leaves() const { return leaves_; }
  int depth() const { return depth_; }
  const std::vector<size_t>& roots() const { return roots_; }
  const std::vector<size_t>& children(size_t vertex) const { return children_[vertex]; }

 private:
  double place(size_t vertex) {
    depth_ = std::max(depth_, vertices_[vertex].length);
    if (children_[vertex].empty()) return x_[vertex] = leaves_++ + 0.5;
    double first = 0, last = 0;
    for (const size_t child : children_[vertex]) {
      last = place(child);
      if (child == children_[vertex].front()) first = last;
    }
    return x_[vertex] = 0.5 * (first + last);
  }

  const std::vector<transport::RecordedVertex>& vertices_;
  std::vector<std::vector<size_t>> children_;
  std::vector<size_t> roots_;
  std::vector<double> x_;
  double leaves_ = 0;
  int depth_ = 0;
};

void draw_branch(const std::vector<transport::RecordedVertex>& vertices, const TreeLayout& layout, size_t vertex,
                 const Point& parent, bool bold, PlaneDrawing& plane) {
  const Point at{layout.x(vertex), -static_cast<double>(vertices[vertex].length)};
  plane.line({parent, at}, bold ? ink(1) : kGrey, bold ? 3 : 1);
  const auto& children = layout.children(vertex);
  // Of the branches that go on, if any does.
  const auto strength = [&](size_t child) {
    return max_component(vertices[child].throughput) - (vertices[child].escaped ? 1e6f : 0);
  };
  const auto strongest = std::ranges::max_element(children, {}, strength);
  for (const size_t child : children) draw_branch(vertices, layout, child, at, bold && child == *strongest, plane);
  const double share = std::clamp(double{max_component(vertices[vertex].throughput)}, 0.0, 1.0);
  plane.dot(at, vertices[vertex].escaped ? kLightGrey : ink(0), std::max(1.0, 9 * std::sqrt(share)));
}

}  // namespace

double vertex_count(const transport::PathRecord& record) { return static_cast<double>(record.vertices.size()); }

Result<render::PixelTrace> traced_sample(render::Document document, Vec2 position, Vec2i image_size,
                                         const MakeContext& context, const SampleRating& rating) {
  document = sized(std::move(document), image_size, context);
  const Vec2i pixel = pixel_of(position, image_size);
  const auto scene = scene::compile(document.scene, document.camera, nullptr);
  auto best = render::trace_pixel(document, scene, pixel, 0);
  for (uint32_t sample = 1; best && sample < kRatedSamples; ++sample) {
    auto trace = render::trace_pixel(document, scene, pixel, sample);
    if (trace && rating(trace->record) > rating(best->record)) best = std::move(trace);
  }
  return best;
}

Result<Part> path_part(const std::string& caption, const render::Document& document, Vec2 position,
                       const MakeContext& context, const SampleRating& rating) {
  const Picture picture = background_of(document, context);
  const Vec2i size(picture.width, picture.height);
  const auto trace = traced_sample(document, position, size, context, rating);
  if (!trace) return trace.error();
  return Part{.caption = caption, .content = drawn_over(picture, trace::path_drawing(*trace, document.camera, size))};
}

Result<Part> paths_part(const std::string& caption, const render::Document& document, Vec2 position, int samples,
                        const MakeContext& context) {
  Picture picture = background_of(document, context);
  const Vec2i size(picture.width, picture.height);
  const auto scene = scene::compile(document.scene, document.camera, nullptr);
  for (int i = 0; i < samples; ++i) {
    const auto trace =
        render::trace_pixel(sized(document, size, context), scene, pixel_of(position, size), static_cast<uint32_t>(i));
    if (!trace) return trace.error();
    picture = drawn_over(picture, trace::path_drawing(*trace, document.camera, size));
  }
  return Part{.caption = caption, .content = std::move(picture)};
}

Result<Part> tree_part(const std::string& caption, const render::Document& document, Vec2 position,
                       const MakeContext& context, bool marks_one) {
  const auto trace = traced_sample(document, position, Vec2i(context.width), context);
  if (!trace) return trace.error();
  const auto& vertices = trace->record.vertices;
  const TreeLayout layout(vertices);
  PlaneDrawing plane({.x = {0, std::max(1.0, layout.leaves())},
                      .y = {-layout.depth() - 0.3, 0.3},
                      .width = 460,
                      .height = 70 + 60 * layout.depth(),
                      .frame = false});
  const Point camera{layout.leaves() / 2, 0};
  for (const size_t root : layout.roots()) draw_branch(vertices, layout, root, camera, marks_one, plane);
  plane.dot(camera, kBlack, 5);
  return plane_part(caption, plane);
}

}  // namespace etendue::figures
