// Size and state of the window.
#pragma once

namespace etendue::viewer {

struct WindowGeometry {
  int width = 1280;  // screen units
  int height = 720;
  bool maximised = false;
};

}  // namespace etendue::viewer
