// Sequences of images: frames of an animation, and turntables.
#pragma once
#include <cstdint>
#include <string>

#include "base/vec.h"
#include "render/document.h"
#include "scene/forward.h"

namespace etendue::render {

// The frames [first, end) of an animation: frame k shows the time k / frames_per_second.
struct FrameRange {
  uint32_t first = 0, end = 0;

  uint32_t count() const { return end - first; }
};
inline constexpr uint32_t kMaxFrames = 1'000'000;

// "A:B", or "N" for 0:N.
Result<FrameRange> parse_frames(const std::string& text);

// The document at a frame of its animation.
Result<Document> animation_frame(const Document& document, uint32_t frame, double frames_per_second);

// The document whose camera has turned by `angle` radians about the vertical axis (y) through a point, counterclockwise as
// seen from above.
Document turned_about(const Document& document, const Vec3& centre, double angle);

// The point where the axis of a camera meets the scene; without such a point, that on the axis next to the centre of the
// scene, in front of the camera.
Vec3 orbit_centre(const Camera& camera, const scene::CompiledScene& scene);

// What a sequence shows: frames of the animation, or a turn of the camera.
struct SequencePlan {
  FrameRange frames;              // of a turntable: from 0 to the number of images of the turn
  double frames_per_second = 24;  // of an animation
  bool is_turntable = false;
};

// The documents of a sequence of images.
class ImageSequence {
 public:
  // Compiles the scene of a turntable, to find the centre of the turn.
  ImageSequence(Document document, const SequencePlan& plan);

  const FrameRange& range() const { return plan_.frames; }
  // An error if the frame is outside of what the scene can show.
  Result<Document> at(uint32_t frame) const;

 private:
  Document document_;
  SequencePlan plan_;
  Vec3 centre_{0};  // of a turntable
};

// The name of the file of a frame: "####" in the pattern is replaced by the number with at least as many digits; without
// "#", the number with four digits is put before the extension, "box.0012.exr" for "box.exr".
std::string frame_file(const std::string& pattern, uint32_t number);

}  // namespace etendue::render
