// What the viewport shows of all pictures: the live one, two at a divider, the map of their difference, the reference.
#pragma once
#include <array>
#include <memory>

#include "viewer/state/app_state.h"

namespace etendue::viewer {

class SplitScreen {
 public:
  // `live` holds what the workbench has on screen when nothing is compared.
  SplitScreen(const Gl& gl, Picture& live) : gl_(gl), live_(live) {}

  void draw(const Workbench& w, GLuint target, Vec2i target_size);

 private:
  using Pixels = std::shared_ptr<const std::vector<Rgb>>;
  struct Slot {
    std::unique_ptr<Picture> picture;
    Pixels pixels;
  };
  enum Role { left, right, reference, map, kRoles };

  // On the graphics card after this, and only once.
  Picture& uploaded(const Workbench& w, Role role, Vec2i size, const Pixels& pixels);
  Picture& uploaded(const Workbench& w, Role role, const Side& side);

  const Gl& gl_;
  Picture& live_;
  std::array<Slot, kRoles> slots_;
};

}  // namespace etendue::viewer
