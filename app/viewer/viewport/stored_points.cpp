#include "viewer/viewport/stored_points.h"

#include <algorithm>

#include "camera/camera_ray.h"
#include "scene/compiled_scene.h"

namespace etendue::viewer {
namespace {

// More of them would be one mass, and slow to draw.
constexpr size_t kMost = 20000;
constexpr double kApart = 0.5;  // seconds between two looks
// A point lies on the surface that hides what is behind it.
constexpr float kSlack = 1e-3f;

Rgb tint_of(const Rgb& power) {
  const float most = max_component(power);
  return most > 0 ? power / most : Rgb(0);
}

std::shared_ptr<const SeenPoints> seen(render::Session& session, const render::Document& d, uint64_t version) {
  auto found = std::make_shared<SeenPoints>();
  found->version = version, found->samples = session.status().samples;
  const auto points = session.points();
  const auto scene = session.scene();
  // An edit that came before the look would have its points under the old camera.
  if (session.status().version != version) found->version = 0;
  if (!points || !scene) return found;
  found->kept = points->size();
  const CameraRays camera(d.camera, d.width, d.height);
  const size_t step = std::max<size_t>(1, (points->size() + kMost - 1) / kMost);
  for (size_t i = 0; i < points->size(); i += step) {
    const auto& point = (*points)[i];
    const auto view = camera.view(point.position, Vec2(0.5f));
    if (!view) continue;
    const Vec2 r = view->raster;
    if (r.x < 0 || r.y < 0 || r.x >= static_cast<float>(d.width) || r.y >= static_cast<float>(d.height)) continue;
    Ray ray;
    ray.origin = point.position + view->wi * view->distance, ray.direction = -view->wi;
    if (scene->intersect(ray, 0).t < view->distance * (1 - kSlack)) continue;
    found->points.push_back({r, tint_of(point.power)});
  }
  return found;
}

}  // namespace

bool PointsHand::advance(bool looked_at) {
  bool news = false;
  if (auto made = job_.take()) shown_ = std::move(*made), news = true;
  if (!looked_at || job_.running()) return news;
  const auto status = session_.status();
  const bool known = shown() && shown_->samples == status.samples;
  const double apart = std::chrono::duration<double>(Clock::now() - asked_).count();
  if (known || status.version != editor_.version() || (shown() && apart < kApart)) return news;
  asked_ = Clock::now();
  job_.start([&session = session_, document = editor_.document(), version = status.version] {
    return seen(session, document, version);
  });
  return news;
}

}  // namespace etendue::viewer
