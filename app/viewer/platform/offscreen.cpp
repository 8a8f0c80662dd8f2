// The viewer without a display: an EGL context without a surface, on a device, or with a small buffer, whichever works. The
// scale of the interface is that of a display of the same size.
#include <EGL/egl.h>
#include <EGL/eglext.h>

#include <array>
#include <chrono>
#include <condition_variable>
#include <vector>

#include "viewer/platform/display_scale.h"
#include "viewer/platform/platform.h"

namespace etendue::viewer {
namespace {

class Offscreen final : public Platform {
 public:
  Offscreen(int width, int height) : size_(width, height) {}

  ~Offscreen() override {
    if (display_ == EGL_NO_DISPLAY) return;
    eglMakeCurrent(display_, EGL_NO_SURFACE, EGL_NO_SURFACE, EGL_NO_CONTEXT);
    if (surface_ != EGL_NO_SURFACE) eglDestroySurface(display_, surface_);
    if (context_ != EGL_NO_CONTEXT) eglDestroyContext(display_, context_);
    eglTerminate(display_);
  }

  bool start() {
    for (EGLDisplay display : candidates()) {
      if (display == EGL_NO_DISPLAY || !eglInitialize(display, nullptr, nullptr)) continue;
      display_ = display;
      if (make_context()) return make_target();
      eglTerminate(display);
      display_ = EGL_NO_DISPLAY;
    }
    return false;
  }

  Vec2i size() const override { return size_; }
  float scale() const override { return scale_for_height(size_.y); }
  GLuint framebuffer() const override { return framebuffer_; }
  bool has_display() const override { return false; }

  void wait(double seconds) override {
    std::unique_lock lock(mutex_);
    changed_.wait_for(lock, std::chrono::duration<double>(seconds), [&] { return woken_ || !events_.empty(); });
    woken_ = false;
  }
  void wake() override {
    const std::lock_guard lock(mutex_);
    woken_ = true;
    changed_.notify_all();
  }
  void present() override { gl_.Finish(); }
  bool take_close_request() override { return false; }

  WindowGeometry geometry() const override { return {.width = size_.x, .height = size_.y, .maximised = false}; }
  void set_title(const std::string&) override {}
  void set_cursor(Cursor) override {}
  void set_clipboard(const std::string& text) override { clipboard_ = text; }
  std::string clipboard() override { return clipboard_; }

 private:
  // Mesa's surfaceless platform, then every device, then the default display.
  static std::vector<EGLDisplay> candidates() {
    std::vector<EGLDisplay> list;
    const auto platform_display =
        reinterpret_cast<PFNEGLGETPLATFORMDISPLAYEXTPROC>(eglGetProcAddress("eglGetPlatformDisplayEXT"));
    if (platform_display) {
      list.push_back(platform_display(EGL_PLATFORM_SURFACELESS_MESA, EGL_DEFAULT_DISPLAY, nullptr));
      const auto query = reinterpret_cast<PFNEGLQUERYDEVICESEXTPROC>(eglGetProcAddress("eglQueryDevicesEXT"));
      std::array<EGLDeviceEXT, 8> devices{};
      EGLint count = 0;
      if (query && query(static_cast<EGLint>(devices.size()), devices.data(), &count))
        for (EGLint i = 0; i < count; ++i)
          list.push_back(platform_display(EGL_PLATFORM_DEVICE_EXT, devices[static_cast<size_t>(i)], nullptr));
    }
    list.push_back(eglGetDisplay(EGL_DEFAULT_DISPLAY));
    return list;
  }

  bool make_context() {
    if (!eglBindAPI(EGL_OPENGL_API)) return false;
    constexpr std::array kConfig{EGL_SURFACE_TYPE, EGL_PBUFFER_BIT, EGL_RENDERABLE_TYPE, EGL_OPENGL_BIT, EGL_NONE};
    constexpr std::array kAnyConfig{EGL_RENDERABLE_TYPE, EGL_OPENGL_BIT, EGL_NONE};
    constexpr std::array kContext{
        EGL_CONTEXT_MAJOR_VERSION,           3,       EGL_CONTEXT_MINOR_VERSION, 3, EGL_CONTEXT_OPENGL_PROFILE_MASK,
        EGL_CONTEXT_OPENGL_CORE_PROFILE_BIT, EGL_NONE};
    EGLConfig config{};
    EGLint count = 0;
    const bool buffered = eglChooseConfig(display_, kConfig.data(), &config, 1, &count) && count > 0;
    if (!buffered && (!eglChooseConfig(display_, kAnyConfig.data(), &config, 1, &count) || count == 0)) return false;
    context_ = eglCreateContext(display_, config, EGL_NO_CONTEXT, kContext.data());
    if (context_ == EGL_NO_CONTEXT) return false;
    if (eglMakeCurrent(display_, EGL_NO_SURFACE, EGL_NO_SURFACE, context_)) return true;
    constexpr std::array kSmall{EGL_WIDTH, 16, EGL_HEIGHT, 16, EGL_NONE};
    surface_ = buffered ? eglCreatePbufferSurface(display_, config, kSmall.data()) : EGL_NO_SURFACE;
    return surface_ != EGL_NO_SURFACE && eglMakeCurrent(display_, surface_, surface_, context_);
  }

  bool make_target() {
    if (!gl_.load([](const char* name) { return reinterpret_cast<void*>(eglGetProcAddress(name)); })) return false;
    GLuint texture = 0;
    gl_.GenTextures(1, &texture);
    gl_.BindTexture(GL_TEXTURE_2D, texture);
    gl_.TexImage2D(GL_TEXTURE_2D, 0, GL_RGBA8, size_.x, size_.y, 0, GL_RGBA, GL_UNSIGNED_BYTE, nullptr);
    gl_.GenFramebuffers(1, &framebuffer_);
    gl_.BindFramebuffer(GL_FRAMEBUFFER, framebuffer_);
    gl_.FramebufferTexture2D(GL_FRAMEBUFFER, GL_COLOR_ATTACHMENT0, GL_TEXTURE_2D, texture, 0);
    return gl_.CheckFramebufferStatus(GL_FRAMEBUFFER) == GL_FRAMEBUFFER_COMPLETE;
  }

  Vec2i size_;
  EGLDisplay display_ = EGL_NO_DISPLAY;
  EGLContext context_ = EGL_NO_CONTEXT;
  EGLSurface surface_ = EGL_NO_SURFACE;
  GLuint framebuffer_ = 0;
  std::mutex mutex_;
  std::condition_variable changed_;
  bool woken_ = false;
  std::string clipboard_;
};

}  // namespace

Result<std::unique_ptr<Platform>> make_offscreen(int width, int height) {
  auto platform = std::make_unique<Offscreen>(width, height);
  if (!platform->start())
    return usage_error(
        "view: OpenGL 3.3 is not available without a display; install libegl-mesa0 and libgl1-mesa-dri, or omit "
        "--offscreen");
  return std::unique_ptr<Platform>(std::move(platform));
}

}  // namespace etendue::viewer
