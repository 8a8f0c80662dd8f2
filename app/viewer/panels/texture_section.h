// The textures of the selected material: image, size, replacement and transform of each slot.
#pragma once
#include <map>
#include <string>
#include <vector>

#include "base/parameter.h"
#include "material/texture_slots.h"
#include "viewer/widgets/thumbnails.h"

namespace etendue::viewer {

struct AppState;

// Which channels of a texture are shown.
enum class TextureChannel : uint8_t { rgb, red, green, blue, alpha };

class TextureSection {
 public:
  void draw(AppState& state, const Material& material);

  struct Parameters {
    Choice<TextureChannel> channel{"textures.channel", "Channels", TextureChannel::rgb,
                                   "Channels of the textures that their images show"};
    auto all() { return std::tie(channel); }
  };
  Parameters parameters;

 private:
  void draw_slot(AppState& state, const TextureSlot& slot, const TextureUse& use, size_t index);

  Thumbnails thumbnails_;
  struct Shown {
    std::shared_ptr<const image::Image> image;
    TextureChannel channel = TextureChannel::rgb;
    ThumbnailImage thumbnail;
  };
  std::vector<Shown> shown_;  // by slot
};

}  // namespace etendue::viewer

template <>
struct etendue::Options<etendue::viewer::TextureChannel> {
  static constexpr std::array<etendue::Option, 5> kOptions{
      {{"rgb", "RGB"}, {"r", "Red"}, {"g", "Green"}, {"b", "Blue"}, {"a", "Alpha"}}};
};
