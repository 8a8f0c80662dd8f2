#include "sequence_options.h"

namespace etendue::cli {

CommandOption frames_option(std::string& target) {
  return {.names = "--frames",
          .target = &target,
          .doc = "Frames A to B - 1 of the animation (A:B) as numbered files: out.0012.exr; #### in the name stands for the "
                 "number. Frame k shows the time k / fps"};
}

CommandOption frames_per_second_option(double& target) {
  return {.names = "--fps",
          .target = &target,
          .doc = "Frames per second of --frames (24)",
          .bounds = between(0.001, 1e6),
          .needs = "--frames"};
}

CommandOption turntable_option(uint32_t& target) {
  return {.names = "--turntable",
          .target = &target,
          .doc = "Number of images of a full turn of the camera about the vertical axis through the surface in the centre "
                 "of the view, as numbered files",
          .bounds = between(1, render::kMaxFrames)};
}

Result<render::ImageSequence> image_sequence(const render::Document& document, const SequenceArguments& arguments) {
  if (!arguments.frames.empty() && arguments.turntable > 0)
    return usage_error("render: --frames and --turntable exclude each other");
  if (arguments.turntable > 0)
    return render::ImageSequence(document, {.frames = {0, arguments.turntable}, .is_turntable = true});
  const auto range = render::parse_frames(arguments.frames);
  if (!range) return usage_error("--frames: " + range.error().message);
  return render::ImageSequence(document, {.frames = *range, .frames_per_second = arguments.frames_per_second});
}

}  // namespace etendue::cli
