#include "render/edit_queue.h"

#include <utility>

namespace etendue::render {
namespace {

// Whether two cameras have the same rays. The focus distance of a pinhole does not matter.
bool same_rays(const Camera& a, Camera b) {
  if (a.lens_radius <= 0 && b.lens_radius <= 0) b.focus_distance = a.focus_distance;
  return a == b;
}

// Whether samples of one document are samples of the other. Limits and display settings do not matter.
bool same_light(const Document& a, const Document& b) {
  return a.scene == b.scene && same_rays(a.camera, b.camera) && a.width == b.width && a.height == b.height &&
         a.filter == b.filter && a.fireflies == b.fireflies && a.method == b.method &&
         a.forced_flags == b.forced_flags && a.seed == b.seed && a.part == b.part;
}

}  // namespace

uint64_t EditQueue::submit(const Document& document, std::optional<ResumePoint> start) {
  Edit edit{.document = document,
            .start = std::move(start),
            .version = ++last_version_,
            .submitted = Clock::now(),
            .restarts = !latest_ || !same_light(*latest_, document)};
  // The edit that this one replaces was never rendered, so its restart and its starting point still apply.
  if (pending_ && !edit.restarts) {
    edit.restarts = pending_->restarts;
    if (!edit.start) edit.start = std::move(pending_->start);
  }
  pending_ = std::move(edit);
  latest_ = document;
  return last_version_;
}

bool EditQueue::resubmit() {
  if (!latest_) return false;
  pending_ = Edit{.document = *latest_,
                  .start = std::nullopt,
                  .version = ++last_version_,
                  .submitted = Clock::now(),
                  .restarts = true};
  return true;
}

Edit EditQueue::take() {
  Edit edit = std::move(*pending_);
  pending_.reset();
  return edit;
}

}  // namespace etendue::render
