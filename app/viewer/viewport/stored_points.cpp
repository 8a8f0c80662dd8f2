#include "viewer/viewport/stored_points.h"

#include <algorithm>

#include "camera/camera_ray.h"
#include "render/session.h"
#include "scene/compiled_scene.h"
#include "viewer/state/editor.h"

namespace etendue::viewer {
namespace {

constexpr size_t kMaxPoints = 20000;  // more of them would be slow to draw and hard to distinguish
constexpr double kInterval = 0.5;     // seconds between two searches
// Points lie on surfaces. The visibility ray ignores hits within this share of the distance to the point.
constexpr float kRelativeTolerance = 1e-3f;

Rgb normalised(const Rgb& power) {
  const float max = max_component(power);
  return max > 0 ? power / max : Rgb(0);
}

std::shared_ptr<const VisiblePoints> find_visible(render::Session& session, const render::Document& d,
                                                  uint64_t version) {
  auto result = std::make_shared<VisiblePoints>();
  result->version = version;
  result->samples = session.status().samples;
  const auto points = session.stored_points();
  const auto scene = session.scene();
  // After an edit the points may belong to another camera.
  if (session.status().version != version) result->version = 0;
  if (!points || !scene) return result;
  result->stored = points->size();
  const CameraRays camera(d.camera, d.width, d.height);
  const size_t step = std::max<size_t>(1, (points->size() + kMaxPoints - 1) / kMaxPoints);
  for (size_t i = 0; i < points->size(); i += step) {
    const auto& point = (*points)[i];
    const auto view = camera.view(point.position, Vec2(0.5f));
    if (!view) continue;
    const Vec2 raster = view->raster;
    const bool in_image = raster.x >= 0 && raster.y >= 0 && raster.x < static_cast<float>(d.width) &&
                          raster.y < static_cast<float>(d.height);
    if (!in_image) continue;
    Ray ray;
    ray.origin = point.position + view->wi * view->distance;
    ray.direction = -view->wi;
    if (scene->intersect(ray, 0).t < view->distance * (1 - kRelativeTolerance)) continue;
    result->points.push_back({.raster = raster, .color = normalised(point.power)});
  }
  return result;
}

}  // namespace

const VisiblePoints* StoredPoints::result() const {
  return result_ && result_->version == editor_.version() ? result_.get() : nullptr;
}

void StoredPoints::update(bool requested) {
  if (auto result = task_.take_result()) result_ = std::move(*result);
  if (!requested || task_.running()) return;
  const auto status = session_.status();
  if (status.version != editor_.version()) return;
  const bool up_to_date = result() && result_->samples == status.samples;
  const double elapsed = std::chrono::duration<double>(Clock::now() - start_).count();
  if (up_to_date || (result() && elapsed < kInterval)) return;
  start_ = Clock::now();
  const auto work = [&session = session_, document = editor_.document(), version = status.version] {
    return find_visible(session, document, version);
  };
  task_.start(work, wake_);
}

}  // namespace etendue::viewer
