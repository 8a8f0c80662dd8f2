// Options that render several images: frames of an animation, or a turntable.
#pragma once
#include <string>
#include <vector>

#include "command.h"
#include "render/image_sequence.h"

namespace etendue::cli {

struct SequenceArguments {
  std::string frames;  // of the animation; empty: not given
  double frames_per_second = 24;
  uint32_t turntable = 0;  // images of a turn of the camera; 0: not given

  bool is_given() const { return !frames.empty() || turntable > 0; }
};

CommandOption frames_option(std::string& target);
CommandOption frames_per_second_option(double& target);
CommandOption turntable_option(uint32_t& target);

Result<render::ImageSequence> image_sequence(const render::Document& document, const SequenceArguments& arguments);

}  // namespace etendue::cli
