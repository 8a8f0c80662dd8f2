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

// The images of a sequence.
class ImageSequence {
 public:
  ImageSequence(const render::Document& document, const SequenceArguments& arguments, render::FrameRange range);

  const render::FrameRange& range() const { return range_; }
  Result<render::Document> at(uint32_t frame) const;

 private:
  const render::Document& document_;
  const SequenceArguments& arguments_;
  render::FrameRange range_;
  Vec3 centre_{0};  // of a turntable
};

// Both arguments must outlive the result.
Result<ImageSequence> image_sequence(const render::Document& document, const SequenceArguments& arguments);

}  // namespace etendue::cli
