// Keeps the OpenGL driver loaded until the end. The leak sanitizer can suppress leaks of a library only while it is
// loaded, and Mesa unloads its driver with the last display.
#include <EGL/egl.h>
#include <EGL/eglext.h>
#include <gtest/gtest.h>

namespace etendue {
namespace {

#ifdef __SANITIZE_ADDRESS__
class DriverStays : public ::testing::Environment {
 public:
  // A separate display, because each viewer terminates the one that it uses.
  void SetUp() override {
    const auto query = reinterpret_cast<PFNEGLQUERYDEVICESEXTPROC>(eglGetProcAddress("eglQueryDevicesEXT"));
    const auto get = reinterpret_cast<PFNEGLGETPLATFORMDISPLAYEXTPROC>(eglGetProcAddress("eglGetPlatformDisplayEXT"));
    EGLDeviceEXT device{};
    EGLint count = 0;
    if (!query || !get || !query(1, &device, &count) || count == 0) return;
    eglInitialize(get(EGL_PLATFORM_DEVICE_EXT, device, nullptr), nullptr, nullptr);
  }
};

const auto* const g_driver_stays = ::testing::AddGlobalTestEnvironment(new DriverStays);
#endif

}  // namespace
}  // namespace etendue
