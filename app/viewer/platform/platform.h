// Where the viewer draws and what wakes it: a window, or memory.
#pragma once
#include <functional>
#include <memory>
#include <string>

#include "base/result.h"
#include "viewer/platform/gl.h"
#include "viewer/platform/input.h"

namespace etendue::viewer {

enum class Cursor : uint8_t { arrow, text, resize_horizontal, resize_vertical, hand };

struct WindowPlace {
  int width = 1280, height = 720;
  bool maximised = false;
};

class Platform {
 public:
  virtual ~Platform() = default;

  const Gl& gl() const { return gl_; }
  EventQueue& events() { return events_; }

  virtual Vec2i size() const = 0;   // pixels
  virtual float scale() const = 0;  // of the display: 2 where everything should be twice as large
  virtual GLuint framebuffer() const = 0;
  virtual bool has_display() const = 0;

  // Waits at most this long for events or a wake. Callers of `wake` may be on any thread.
  virtual void wait(double seconds) = 0;
  virtual void wake() = 0;
  virtual void present() = 0;
  virtual bool closing() const = 0;

  virtual WindowPlace place() const = 0;
  virtual void set_title(const std::string& title) = 0;
  virtual void set_cursor(Cursor cursor) = 0;
  virtual void set_clipboard(const std::string& text) = 0;
  virtual std::string clipboard() = 0;

 protected:
  Gl gl_{};
  EventQueue events_;
};

Result<std::unique_ptr<Platform>> make_window(const WindowPlace& place);
Result<std::unique_ptr<Platform>> make_offscreen(int width, int height);

}  // namespace etendue::viewer
