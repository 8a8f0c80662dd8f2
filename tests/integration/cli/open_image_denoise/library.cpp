// A library with the interface of Open Image Denoise, version 2, for tests of the program where that is not installed. Its
// filter averages the image and the albedo and adds the normal, so that a test can tell that all of them arrive.
// OIDN_TEST_FAULT makes the filter fail.
#include <cstddef>
#include <cstdlib>
#include <map>
#include <string>

namespace {

struct Image {
  float* data = nullptr;
  size_t width = 0, height = 0;
};

struct Filter {
  std::map<std::string, Image> images;
  bool is_hdr = false, is_committed = false;
  bool (*progress)(void*, double) = nullptr;
  void* user = nullptr;
};

int error_code = 0;
std::string error_message;

void report(int code, const char* message) {
  error_code = code;
  error_message = message;
}

}  // namespace

extern "C" {

#define EXPORTED __attribute__((visibility("default")))

struct Device {};
static Device device;

EXPORTED Device* oidnNewDevice(int type) { return type == 1 ? &device : nullptr; }
EXPORTED void oidnReleaseDevice(Device*) {}
EXPORTED void oidnSetDeviceInt(Device*, const char*, int) {}
EXPORTED void oidnCommitDevice(Device*) {}
EXPORTED int oidnGetDeviceError(Device*, const char** message) {
  const int code = error_code;
  if (message) *message = code == 0 ? nullptr : error_message.c_str();
  error_code = 0;
  return code;
}
EXPORTED Filter* oidnNewFilter(Device*, const char* type) { return std::string(type) == "RT" ? new Filter : nullptr; }
EXPORTED void oidnReleaseFilter(Filter* filter) { delete filter; }
EXPORTED void oidnSetSharedFilterImage(Filter* filter, const char* name, void* data, int format, size_t width,
                                       size_t height, size_t, size_t, size_t) {
  if (format != 3) report(2, "unsupported image format");
  filter->images[name] = {static_cast<float*>(data), width, height};
}
EXPORTED void oidnSetFilterBool(Filter* filter, const char* name, bool value) {
  if (std::string(name) == "hdr") filter->is_hdr = value;
}
EXPORTED void oidnSetFilterProgressMonitorFunction(Filter* filter, bool (*function)(void*, double), void* user) {
  filter->progress = function;
  filter->user = user;
}
EXPORTED void oidnCommitFilter(Filter* filter) { filter->is_committed = filter->is_hdr; }
EXPORTED void oidnExecuteFilter(Filter* filter) {
  if (std::getenv("OIDN_TEST_FAULT")) return report(4, "out of memory");
  if (!filter->is_committed) return report(3, "the filter is not committed, or not for HDR images");
  if (filter->progress && !filter->progress(filter->user, 0.5)) return report(6, "cancelled");
  const Image color = filter->images["color"], albedo = filter->images["albedo"], normal = filter->images["normal"],
              output = filter->images["output"];
  if (!color.data || !output.data) return report(3, "an image is missing");
  for (size_t i = 0; i < 3 * output.width * output.height; ++i)
    output.data[i] = albedo.data && normal.data ? (color.data[i] + albedo.data[i]) / 2 + normal.data[i] : color.data[i];
}

}  // extern "C"
