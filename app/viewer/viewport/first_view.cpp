#include "viewer/viewport/first_view.h"

#include <algorithm>
#include <cmath>
#include <span>

#include "camera/camera_ray.h"
#include "render/automatic_exposure.h"
#include "render/display_frame.h"
#include "render/document.h"
#include "render/session.h"
#include "scene/compiled_scene.h"
#include "viewer/state/app_state.h"
#include "viewer/state/editor.h"
#include "viewer/viewport/dark_image.h"
#include "viewer/viewport/lit_view.h"
#include "viewer/widgets/value_text.h"

namespace etendue::viewer {
namespace {

constexpr int kColumns = 24, kRows = 16;  // of rays that look for surfaces in front of the near plane
constexpr uint32_t kExposureSamples = 4, kLightSamples = 8;
constexpr float kDarkBackdrop = 0.25f;  // brightness behind surfaces that are middle grey themselves
constexpr float kLargestShareLikeBackdrop = 0.5f;
constexpr float kMaxExposureOfBackdrop = 1;  // EV; the grey backdrop stays far below white

// The distance along the optical axis to the surface in the centre of the image; 0 if there is none.
float central_depth(const Camera& camera, const scene::CompiledScene& scene) {
  const Ray axis{Vec3(camera.to_world[3]), camera.near_clip, -Vec3(camera.to_world[2]), camera.far_clip};
  const Hit hit = scene.intersect(axis, 0);
  return hit ? hit.t : 0;
}

bool hides_surfaces(Camera camera, Vec2i size, const scene::CompiledScene& scene) {
  const float near_clip = camera.near_clip;
  camera.near_clip = 0;
  camera.far_clip = near_clip;
  camera.lens_radius = 0;
  const CameraRays rays(camera, size.x, size.y);
  for (int row = 0; row < kRows; ++row)
    for (int column = 0; column < kColumns; ++column) {
      const Vec2 at((static_cast<float>(column) + 0.5f) / kColumns, (static_cast<float>(row) + 0.5f) / kRows);
      if (scene.intersect(rays.ray(at * Vec2(size), Vec2(0.5f)), 0)) return true;
    }
  return false;
}

void adjust_camera(AppState& state, const scene::CompiledScene& scene) {
  const Camera camera = camera_for_navigation(state.document(), scene);
  if (camera == state.document().camera) return;
  render::Document changed = state.document();
  changed.camera = camera;
  state.editor->amend(std::move(changed));
}

// Between the two exposures: bright surfaces may stay clipped so that most of the others are not black.
float lowered_exposure(float current, float wanted, std::span<const float> luminances) {
  const float least = std::ceil(2 * lowest_exposure(luminances)) / 2;
  return std::clamp(least, wanted, current);
}

void adjust_exposure(AppState& state, const scene::CompiledScene& scene, const render::Frame& frame) {
  const render::Document& document = state.document();
  const auto luminances = render::surface_luminances(document, scene, *frame.pixels);
  if (!render::exposure_is_unsuitable(luminances, document.display.exposure)) return;
  auto exposure = render::automatic_exposure(luminances);
  if (!exposure) return;
  if (*exposure < document.display.exposure)
    exposure = lowered_exposure(document.display.exposure, *exposure, luminances);
  const Environment& environment = document.scene->environment;
  const bool is_limited = environment.backdrop && !environment.visible && *exposure > kMaxExposureOfBackdrop;
  if (is_limited) exposure = kMaxExposureOfBackdrop;
  if (*exposure == document.display.exposure) return;
  render::Document changed = document;
  changed.display.exposure = *exposure;
  state.editor->amend(std::move(changed));
  const char* format = is_limited
                           ? "Exposure set to %+.1f EV for dark surfaces. A higher one would make the backdrop white."
                           : "Exposure set to %+.1f EV to suit the luminance of the surfaces.";
  state.notices.add_message(formatted(format, static_cast<double>(*exposure)));
}

// Darkens the backdrop if most surfaces are about as bright.
void adjust_backdrop(AppState& state, const scene::CompiledScene& scene, const render::Frame& frame) {
  const render::Document& document = state.document();
  const Environment& environment = document.scene->environment;
  if (environment.visible || !environment.backdrop || environment.backdrop_brightness != 1) return;
  const auto share = [&](float factor) { return render::share_like_backdrop(document, scene, *frame.pixels, factor); };
  const float like_grey = share(1);
  if (like_grey < kLargestShareLikeBackdrop || share(kDarkBackdrop) >= like_grey) return;
  auto darkened = render::with_text(document, "environment.backdrop-brightness",
                                    formatted("%g", static_cast<double>(kDarkBackdrop)));
  if (darkened) state.editor->amend(std::move(*darkened));
}

// Whether the camera of the file sees unlit surfaces only, and another one would see lit surfaces.
bool another_view_is_lit(const render::Document& document, const scene::CompiledScene& scene) {
  const float aspect = static_cast<float>(document.width) / static_cast<float>(document.height);
  if (seen_surfaces(scene, document.camera, aspect).suffice()) return false;
  return seen_surfaces(scene, reset_camera(document, scene), aspect).suffice();
}

// Adds the studio environment if the lights of the file leave most of the visible surfaces black at any exposure, from
// every side. Returns whether it was added.
bool add_missing_light(AppState& state, const scene::CompiledScene& scene, const render::Frame& frame) {
  const render::Document& document = state.document();
  if (!document.scene->environment.black()) return false;
  const auto luminances = render::surface_luminances(document, scene, *frame.pixels);
  render::Document exposed = document;
  exposed.display.exposure = std::max(document.display.exposure, render::automatic_exposure(luminances).value_or(0));
  if (find_darkness(exposed, scene, frame) != Darkness::surfaces_are_black) return false;
  if (another_view_is_lit(document, scene)) return false;
  auto lit = render::with_text(document, "environment.preset", "studio");
  if (!lit) return false;
  lit->display.curve = image::ToneCurve::neutral;
  state.viewport.environment = lit->scene->environment.file;
  state.editor->amend(std::move(*lit));
  state.notices.add_message("The lights of the file leave most surfaces black: the environment \"Studio\" was added.",
                            "tab.light");
  return true;
}

// Notices another environment. That of a scene just opened is not the user's choice.
void watch_environment(AppState& state) {
  const std::string& environment = state.document().scene->environment.file;
  if (environment == state.viewport.environment) return;
  state.viewport.environment = environment;
  if (state.editor->undo_depth() > 0) state.viewport.first_view = FirstView::environment_selected;
}

}  // namespace

Camera camera_for_navigation(const render::Document& document, const scene::CompiledScene& scene) {
  Camera camera = document.camera;
  const bool states_focus = camera.lens_radius > 0 || camera.focus_distance != Camera{}.focus_distance;
  if (const float depth = central_depth(camera, scene); !states_focus && depth > 0) camera.focus_distance = depth;
  const Vec2i size(document.width, document.height);
  if (camera.near_clip > 0 && !hides_surfaces(camera, size, scene)) camera.near_clip = 0;
  return camera;
}

void adjust_first_view(AppState& state) {
  watch_environment(state);
  FirstView& pending = state.viewport.first_view;
  if (pending == FirstView::adjusted) return;
  if (pending != FirstView::environment_selected && state.editor->undo_depth() > 0) {
    pending = FirstView::adjusted;
    return;
  }
  const auto scene = state.session->scene();
  if (!scene || state.session->status().version < state.editor->version()) return;
  if (pending == FirstView::camera_pending) {
    pending = FirstView::exposure_pending;
    adjust_camera(state, *scene);
    return;
  }
  const auto& frame = state.viewport.frame;
  const bool shows_document = frame && frame->version == state.editor->version();
  const bool is_new_scene = pending == FirstView::exposure_pending;
  const uint32_t samples = is_new_scene ? kLightSamples : kExposureSamples;
  if (!shows_document || frame->samples < samples || frame->preview_scale > 1) return;
  if (is_new_scene && add_missing_light(state, *scene, *frame)) {
    pending = FirstView::environment_selected;
    return;
  }
  pending = FirstView::adjusted;
  adjust_exposure(state, *scene, *frame);
  if (is_new_scene) adjust_backdrop(state, *scene, *frame);
}

}  // namespace etendue::viewer
