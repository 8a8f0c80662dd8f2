#include "viewer/viewport/selection_outline.h"

#include <algorithm>

#include "camera/camera_ray.h"
#include "render/session.h"
#include "scene/compiled_scene.h"
#include "viewer/state/editor.h"

namespace etendue::viewer {
namespace {

// While the camera moves, each frame is another version of the document, and rendering needs the processor.
constexpr auto kRest = std::chrono::milliseconds(200);
constexpr int kCellSize = 4;  // pixels; thinner parts of an object may be missed

// Which pixels show which of the nodes. Rays are traced at the corners of cells, and at each pixel of cells at the border.
class VisibilityMask {
 public:
  VisibilityMask(const render::Document& document, const scene::CompiledScene& scene, const std::vector<int>& nodes)
      : scene_(scene),
        nodes_(nodes),
        width_(document.width),
        height_(document.height),
        camera_(pinhole(document.camera), document.width, document.height),
        pixels_(static_cast<size_t>(width_) * static_cast<size_t>(height_), kUnknown) {}

  void compute() {
    for (int y = 0; y < height_; y += kCellSize)
      for (int x = 0; x < width_; x += kCellSize) compute_cell(x, y);
  }

  // The node that the pixel shows, or kOther.
  int node_at(int x, int y) const {
    if (x < 0 || y < 0 || x >= width_ || y >= height_) return kOther;
    const int node = pixels_[index(x, y)];
    return node == kUnknown ? kOther : node;
  }

 private:
  static constexpr int kUnknown = -2, kOther = -1;

  static Camera pinhole(Camera camera) {
    camera.lens_radius = 0;
    return camera;
  }

  size_t index(int x, int y) const {
    return static_cast<size_t>(y) * static_cast<size_t>(width_) + static_cast<size_t>(x);
  }

  int trace(int x, int y) {
    x = std::min(x, width_ - 1);
    y = std::min(y, height_ - 1);
    int& pixel = pixels_[index(x, y)];
    if (pixel != kUnknown) return pixel;
    const Ray ray = camera_.ray(Vec2(x, y) + Vec2(0.5f), Vec2(0.5f));
    const Hit hit = scene_.intersect(ray, 0);
    const int node = hit ? static_cast<int>(scene_.instances()[hit.instance].node) : kOther;
    pixel = std::ranges::find(nodes_, node) != nodes_.end() ? node : kOther;
    return pixel;
  }

  void compute_cell(int left, int top) {
    const int corner = trace(left, top);
    const bool is_uniform = trace(left + kCellSize, top) == corner && trace(left, top + kCellSize) == corner &&
                            trace(left + kCellSize, top + kCellSize) == corner;
    for (int y = top; y < std::min(top + kCellSize, height_); ++y)
      for (int x = left; x < std::min(left + kCellSize, width_); ++x) {
        if (!is_uniform)
          trace(x, y);
        else
          pixels_[index(x, y)] = corner;
      }
  }

  const scene::CompiledScene& scene_;
  const std::vector<int>& nodes_;
  const int width_;
  const int height_;
  const CameraRays camera_;
  std::vector<int> pixels_;
};

// Joins neighbouring pixels of the border to segments, along rows and then along columns.
std::vector<OutlineSegment> border_of(const VisibilityMask& mask, int width, int height) {
  std::vector<OutlineSegment> segments;
  const auto scan = [&](int lines, int length, const auto& is_border, const auto& segment) {
    for (int line = 0; line <= lines; ++line)
      for (int start = 0; start < length; ++start) {
        if (!is_border(line, start)) continue;
        int end = start + 1;
        while (end < length && is_border(line, end)) ++end;
        segments.push_back(segment(line, start, end));
        start = end;
      }
  };
  const auto above = [&](int y, int x) { return mask.node_at(x, y) != mask.node_at(x, y - 1); };
  const auto left = [&](int x, int y) { return mask.node_at(x, y) != mask.node_at(x - 1, y); };
  scan(height, width, above, [](int y, int x0, int x1) { return OutlineSegment{Vec2(x0, y), Vec2(x1, y)}; });
  scan(width, height, left, [](int x, int y0, int y1) { return OutlineSegment{Vec2(x, y0), Vec2(x, y1)}; });
  return segments;
}

}  // namespace

void SelectionOutline::update(std::vector<int> nodes) {
  nodes_ = std::move(nodes);
  if (editor_.version() != version_) {
    version_ = editor_.version();
    last_change_ = Clock::now();
  }
  if (auto outline = task_.take_result()) outline_ = std::move(*outline);
  if (nodes_.empty() || segments() || task_.running() || Clock::now() - last_change_ < kRest) return;
  const auto scene = session_.scene();
  if (!scene || session_.status().version != editor_.version()) return;
  const auto work = [scene, document = editor_.document(), version = editor_.version(), nodes = nodes_] {
    VisibilityMask mask(document, *scene, nodes);
    mask.compute();
    return std::shared_ptr<const Outline>(
        std::make_shared<Outline>(Outline{version, nodes, border_of(mask, document.width, document.height)}));
  };
  task_.start(work, wake_);
}

const std::vector<OutlineSegment>* SelectionOutline::segments() const {
  const bool is_current = outline_ && outline_->version == editor_.version() && outline_->nodes == nodes_;
  return is_current ? &outline_->segments : nullptr;
}

}  // namespace etendue::viewer
