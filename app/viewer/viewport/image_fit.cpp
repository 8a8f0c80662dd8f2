#include "viewer/viewport/image_fit.h"

#include <algorithm>
#include <cmath>

#include "render/clock.h"
#include "render/document.h"
#include "render/session.h"
#include "viewer/state/app_state.h"
#include "viewer/state/editor.h"
#include "viewer/tasks/exclusive_task.h"
#include "viewer/viewport/comparison.h"

namespace etendue::viewer {
namespace {

constexpr double kRest = 0.3;          // seconds without a change of the viewport
constexpr double kMaxLostSeconds = 5;  // of rendering that may start again

// Whether the image on screen may start again with another resolution.
bool may_restart(const AppState& state) {
  const Comparison& comparison = *state.viewport.comparison;
  if (comparison.a.frame || comparison.b.frame || comparison.reference.frame) return false;
  if (state.options.sharing || state.viewport.focus.is_selecting()) return false;
  const render::Status status = state.session->status();
  return status.version == state.editor->version() && status.phase != "paused" && status.seconds < kMaxLostSeconds;
}

}  // namespace

Vec2i fitted_size(const render::Document& document, Vec2 region) {
  const float aspect = document.camera.aspect;
  if (aspect > 0) region = {std::min(region.x, region.y * aspect), std::min(region.y, region.x / aspect)};
  return glm::max(Vec2i(glm::round(region)), Vec2i(kMinImageSize));
}

void fit_image(render::Document& document, Vec2 region) {
  const Vec2i size = fitted_size(document, region);
  document.width = size.x;
  document.height = size.y;
}

void ImageFit::reset(const render::Document& document, bool is_fitted) {
  sizes_.clear();
  if (is_fitted) sizes_.emplace_back(document.width, document.height);
}

void ImageFit::update(AppState& state) {
  // What the user measures belongs to the present resolution; the choice of an integrator does not.
  const bool is_measuring = state.tasks.exclusive->running();
  if (is_measuring && !state.document().automatic.is_pending()) sizes_.clear();
  if (const Vec2 size = state.viewport.region.size; size != region_) {
    region_ = size;
    resized_ = render::Clock::now();
  }
  const render::Document& document = state.document();
  const Vec2i size(document.width, document.height);
  if (std::ranges::find(sizes_, size) == sizes_.end() || size == fitted_size(document, region_)) return;
  if (is_measuring || render::seconds_since(resized_) < kRest || !may_restart(state)) return;
  render::Document changed = document;
  fit_image(changed, region_);
  if (const Vec2i fitted(changed.width, changed.height); std::ranges::find(sizes_, fitted) == sizes_.end())
    sizes_.push_back(fitted);
  state.editor->amend(std::move(changed));
}

}  // namespace etendue::viewer
