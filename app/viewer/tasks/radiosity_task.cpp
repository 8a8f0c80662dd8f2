#include "viewer/tasks/radiosity_task.h"

#include <algorithm>
#include <functional>
#include <optional>

#include "camera/camera_ray.h"
#include "render/session.h"
#include "scene/compiled_scene.h"
#include "viewer/state/editor.h"

namespace etendue::viewer {
namespace {

constexpr double kStatusInterval = 0.5;      // seconds between two requests
constexpr size_t kMostPatches = 20'000;      // more would be too small to distinguish and slow to draw
constexpr float kRelativeTolerance = 1e-3f;  // of the distance, for hits in front of a patch

float cross(Vec2 a, Vec2 b) { return a.x * b.y - a.y * b.x; }

// The patch in the image, if all of its corners are in front of the camera and its centroid is visible.
std::optional<VisiblePatch> project(const integrator::SolutionView::Patch& patch, uint32_t index,
                                    const CameraRays& camera, const scene::CompiledScene& scene) {
  VisiblePatch visible{.corners = {}, .patch = index};
  for (size_t k = 0; k < 3; ++k) {
    const auto view = camera.view(patch.corners[k], Vec2(0.5f));
    if (!view) return {};
    visible.corners[k] = view->raster;
  }
  const Vec3 centroid = (patch.corners[0] + patch.corners[1] + patch.corners[2]) / 3.0f;
  const auto view = camera.view(centroid, Vec2(0.5f));
  if (!view) return {};
  Ray ray;
  ray.origin = centroid + view->wi * view->distance;
  ray.direction = -view->wi;
  if (scene.intersect(ray, 0).t < view->distance * (1 - kRelativeTolerance)) return {};
  visible.front = glm::dot(patch.normal, view->wi) > 0;
  visible.distance = view->distance;
  return visible;
}

std::shared_ptr<const VisibleSolution> find_visible_patches(render::Session& session, const render::Document& d,
                                                            uint64_t version) {
  auto result = std::make_shared<VisibleSolution>();
  result->solution = session.solution_view();
  const auto scene = session.scene();
  // After an edit, the solution may belong to another scene or camera.
  if (session.status().version != version) return result;
  result->version = version;
  if (!result->solution || !scene) return result;
  const CameraRays camera(d.camera, d.width, d.height);
  const auto& patches = result->solution->patches;
  for (uint32_t p = 0; p < patches.size() && result->patches.size() < kMostPatches; ++p)
    if (const auto visible = project(patches[p], p, camera, *scene)) result->patches.push_back(*visible);
  std::ranges::sort(result->patches, std::greater(), &VisiblePatch::distance);
  return result;
}

}  // namespace

bool VisiblePatch::contains(Vec2 pixel) const {
  const float a = cross(corners[1] - corners[0], pixel - corners[0]),
              b = cross(corners[2] - corners[1], pixel - corners[1]),
              c = cross(corners[0] - corners[2], pixel - corners[2]);
  return (a >= 0 && b >= 0 && c >= 0) || (a <= 0 && b <= 0 && c <= 0);
}

void RadiosityTask::update(const TaskContext& context, bool requested) {
  if (auto result = task_.take_result()) {
    if ((*result)->version == context.editor.version()) result_ = std::move(*result);
  }
  if (result_ && result_->version != context.editor.version()) result_ = nullptr;
  if (!requested || task_.running()) return;
  const auto status = context.session.status();
  if (status.version != context.editor.version()) return;
  const bool is_final = result_ && (!result_->solution || result_->solution->is_complete);
  const double elapsed = std::chrono::duration<double>(Clock::now() - start_).count();
  if (is_final || elapsed < kStatusInterval) return;
  start_ = Clock::now();
  const auto work = [&session = context.session, document = context.editor.document(), version = status.version] {
    return find_visible_patches(session, document, version);
  };
  task_.start(work, context.wake);
}

void RadiosityTask::reset(const TaskContext&) {
  task_.abandon();
  result_ = nullptr;
}

}  // namespace etendue::viewer
