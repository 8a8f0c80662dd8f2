// The Dear ImGui context: feeds it with input and draws its output with OpenGL.
#pragma once
#include "viewer/platform/platform.h"

namespace etendue::viewer {

class ImguiHost {
 public:
  explicit ImguiHost(Platform& platform);
  ~ImguiHost();
  ImguiHost(const ImguiHost&) = delete;
  ImguiHost& operator=(const ImguiHost&) = delete;

  Result<void> start();
  void begin_frame(const Input& input, float seconds);
  void end_frame();  // draws into the framebuffer of the platform

 private:
  void upload_changed_fonts();
  void set_font_filter();

  Platform& platform_;
  bool started_ = false;
  GLuint filtered_ = 0;  // the font texture that has nearest-neighbour filtering
};

}  // namespace etendue::viewer
