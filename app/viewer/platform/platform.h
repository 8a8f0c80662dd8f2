// The place where the viewer draws and receives events: a window, or a buffer in memory.
#pragma once
#include <functional>
#include <memory>
#include <string>

#include "base/result.h"
#include "viewer/platform/gl.h"
#include "viewer/platform/input.h"
#include "viewer/platform/window_geometry.h"

namespace etendue::viewer {

enum class Cursor : uint8_t { arrow, text, resize_horizontal, resize_vertical, hand };

class Platform {
 public:
  virtual ~Platform() = default;

  const Gl& gl() const { return gl_; }
  EventQueue& events() { return events_; }

  virtual Vec2i size() const = 0;   // pixels
  virtual float scale() const = 0;  // pixels per unit of the interface: 2 on a high-density display
  virtual GLuint framebuffer() const = 0;
  virtual bool has_display() const = 0;

  // Waits for events or a call of `wake`, at most this many seconds. `wake` may be called from any thread.
  virtual void wait(double seconds) = 0;
  virtual void wake() = 0;
  virtual void present() = 0;
  // Whether the user has closed the window since the last call. The window stays until the platform is destroyed.
  virtual bool take_close_request() = 0;

  virtual WindowGeometry geometry() const = 0;
  virtual void set_title(const std::string& title) = 0;
  virtual void set_cursor(Cursor cursor) = 0;
  virtual void set_clipboard(const std::string& text) = 0;
  virtual std::string clipboard() = 0;

 protected:
  Gl gl_{};
  EventQueue events_;
};

Result<std::unique_ptr<Platform>> make_window(const WindowGeometry& geometry);
Result<std::unique_ptr<Platform>> make_offscreen(int width, int height);

}  // namespace etendue::viewer
