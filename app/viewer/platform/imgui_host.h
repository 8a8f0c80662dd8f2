// Dear ImGui between the viewer's input and the viewer's OpenGL.
#pragma once
#include "viewer/state/app_state.h"

namespace etendue::viewer {

class ImguiHost {
 public:
  explicit ImguiHost(Platform& platform);
  ~ImguiHost();
  ImguiHost(const ImguiHost&) = delete;
  ImguiHost& operator=(const ImguiHost&) = delete;

  Result<void> start();
  void begin_frame(const Input& input, float seconds);
  void end_frame();  // draws into the platform's framebuffer

 private:
  void sharpen();

  Platform& platform_;
  bool started_ = false;
  GLuint sharp_ = 0;  // the texture of letters that was made so
};

}  // namespace etendue::viewer
