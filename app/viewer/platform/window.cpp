// The viewer in a window, made with GLFW.
#define GLFW_INCLUDE_NONE
#include <GLFW/glfw3.h>

#include <array>

#include "viewer/platform/display_scale.h"
#include "viewer/platform/platform.h"

namespace etendue::viewer {
namespace {

class Window final : public Platform {
 public:
  Window() = default;

  ~Window() override {
    for (GLFWcursor* cursor : cursors_)
      if (cursor) glfwDestroyCursor(cursor);
    if (window_) glfwDestroyWindow(window_);
    glfwTerminate();
  }

  Result<void> start(const WindowGeometry& geometry) {
    if (!glfwInit())
      return usage_error("view: cannot open a window: " + reason() + "; use --offscreen to run without one");
    glfwWindowHint(GLFW_CONTEXT_VERSION_MAJOR, 3);
    glfwWindowHint(GLFW_CONTEXT_VERSION_MINOR, 3);
    glfwWindowHint(GLFW_OPENGL_PROFILE, GLFW_OPENGL_CORE_PROFILE);
    glfwWindowHint(GLFW_MAXIMIZED, geometry.maximised ? GLFW_TRUE : GLFW_FALSE);
    glfwWindowHint(GLFW_SCALE_TO_MONITOR, GLFW_TRUE);
    window_ = glfwCreateWindow(geometry.width, geometry.height, "Étendue", nullptr, nullptr);
    if (!window_)
      return usage_error("view: cannot open a window with OpenGL 3.3: " + reason() +
                         "; use --offscreen to run without one");
    glfwMakeContextCurrent(window_);
    glfwSwapInterval(0);
    if (!gl_.load([](const char* name) { return reinterpret_cast<void*>(glfwGetProcAddress(name)); }))
      return usage_error(
          "view: the OpenGL of this display lacks functions of version 3.3; use --offscreen to run without it");
    glfwSetWindowUserPointer(window_, this);
    constexpr std::array kShapes{GLFW_ARROW_CURSOR, GLFW_IBEAM_CURSOR, GLFW_HRESIZE_CURSOR, GLFW_VRESIZE_CURSOR,
                                 GLFW_HAND_CURSOR};
    for (size_t i = 0; i < kShapes.size(); ++i) cursors_[i] = glfwCreateStandardCursor(kShapes[i]);
    set_callbacks();
    return {};
  }

  Vec2i size() const override {
    Vec2i s;
    glfwGetFramebufferSize(window_, &s.x, &s.y);
    return s;
  }
  // The scale that the system states, or else one for the height of the display.
  float scale() const override {
    float x = 1, y = 1;
    glfwGetWindowContentScale(window_, &x, &y);
    return x > 0 && x != 1 ? x : scale_of_display();
  }
  GLuint framebuffer() const override { return 0; }
  bool has_display() const override { return true; }

  void wait(double seconds) override {
    if (seconds > 0)
      glfwWaitEventsTimeout(seconds);
    else
      glfwPollEvents();
  }
  void wake() override { glfwPostEmptyEvent(); }
  void present() override { glfwSwapBuffers(window_); }
  bool take_close_request() override {
    const bool requested = glfwWindowShouldClose(window_) != 0;
    glfwSetWindowShouldClose(window_, GLFW_FALSE);
    return requested;
  }

  WindowGeometry geometry() const override {
    WindowGeometry p;
    glfwGetWindowSize(window_, &p.width, &p.height);
    p.maximised = glfwGetWindowAttrib(window_, GLFW_MAXIMIZED) != 0;
    return p;
  }
  void set_title(const std::string& title) override { glfwSetWindowTitle(window_, title.c_str()); }
  void set_cursor(Cursor cursor) override {
    if (cursor == cursor_) return;
    cursor_ = cursor;
    glfwSetCursor(window_, cursors_[static_cast<size_t>(cursor)]);
  }
  void set_clipboard(const std::string& text) override { glfwSetClipboardString(window_, text.c_str()); }
  std::string clipboard() override {
    const char* text = glfwGetClipboardString(window_);
    return text ? text : "";
  }

 private:
  static float scale_of_display() {
    GLFWmonitor* monitor = glfwGetPrimaryMonitor();
    const GLFWvidmode* mode = monitor ? glfwGetVideoMode(monitor) : nullptr;
    return mode ? scale_for_height(mode->height) : 1;
  }

  static std::string reason() {
    const char* text = nullptr;
    glfwGetError(&text);
    return text ? text : "no display";
  }

  static Window& from(GLFWwindow* window) { return *static_cast<Window*>(glfwGetWindowUserPointer(window)); }
  static void push(GLFWwindow* window, Event event) { from(window).events_.push(std::move(event)); }

  // GLFW gives pointer positions in screen units; the viewer uses pixels.
  Vec2 in_pixels(double x, double y) const {
    Vec2i pixels, units;
    glfwGetFramebufferSize(window_, &pixels.x, &pixels.y);
    glfwGetWindowSize(window_, &units.x, &units.y);
    return Vec2(static_cast<float>(x), static_cast<float>(y)) * Vec2(pixels) / Vec2(glm::max(units, Vec2i(1)));
  }

  void set_callbacks() {
    glfwSetCursorPosCallback(window_, [](GLFWwindow* w, double x, double y) {
      push(w, {.type = Event::Type::move, .position = from(w).in_pixels(x, y)});
    });
    glfwSetCursorEnterCallback(window_, [](GLFWwindow* w, int entered) {
      if (!entered) push(w, {.type = Event::Type::leave});
    });
    glfwSetMouseButtonCallback(window_, [](GLFWwindow* w, int button, int action, int) {
      if (button <= GLFW_MOUSE_BUTTON_MIDDLE)
        push(w, {.type = Event::Type::button, .button = static_cast<Button>(button), .down = action == GLFW_PRESS});
    });
    glfwSetScrollCallback(window_, [](GLFWwindow* w, double x, double y) {
      push(w, {.type = Event::Type::scroll, .position = Vec2(static_cast<float>(x), static_cast<float>(y))});
    });
    glfwSetKeyCallback(window_, [](GLFWwindow* w, int key, int, int action, int) {
      // Dear ImGui repeats keys itself in text fields.
      if (key >= 0 && action != GLFW_REPEAT)
        push(w, {.type = Event::Type::key, .key = key, .down = action == GLFW_PRESS});
    });
    glfwSetCharCallback(window_,
                        [](GLFWwindow* w, unsigned c) { push(w, {.type = Event::Type::text, .character = c}); });
    glfwSetDropCallback(window_, [](GLFWwindow* w, int count, const char** files) {
      for (int i = 0; i < count; ++i) push(w, {.type = Event::Type::drop, .file = files[i]});
    });
    glfwSetFramebufferSizeCallback(window_, [](GLFWwindow* w, int, int) { push(w, {.type = Event::Type::redraw}); });
    glfwSetWindowRefreshCallback(window_, [](GLFWwindow* w) { push(w, {.type = Event::Type::redraw}); });
    glfwSetWindowFocusCallback(window_, [](GLFWwindow* w, int focused) {
      if (focused) return;
      // The release of a key is not reported while another window has the focus.
      for (int key = 0; key < kKeys; ++key) push(w, {.type = Event::Type::key, .key = key, .down = false});
    });
  }

  GLFWwindow* window_ = nullptr;
  std::array<GLFWcursor*, 5> cursors_{};
  Cursor cursor_ = Cursor::arrow;
};

}  // namespace

Result<std::unique_ptr<Platform>> make_window(const WindowGeometry& geometry) {
  auto window = std::make_unique<Window>();
  if (auto started = window->start(geometry); !started) return started.error();
  return std::unique_ptr<Platform>(std::move(window));
}

}  // namespace etendue::viewer
