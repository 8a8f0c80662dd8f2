#include "film/denoise/open_image_denoise.h"

#include <dlfcn.h>

#include <cmath>
#include <memory>
#include <string>

namespace etendue::film {
namespace {

// Values of the interface, which are the same in both versions.
constexpr int kDeviceTypeCpu = 1, kFormatFloat3 = 3, kErrorNone = 0, kErrorCancelled = 6;

struct Device;
struct Filter;

// Functions of the library. Setters of parameters have other names in version 2.
struct Library {
  Device* (*new_device)(int type);
  void (*release_device)(Device*);
  void (*set_device_int)(Device*, const char* name, int value);
  void (*commit_device)(Device*);
  int (*device_error)(Device*, const char** message);
  Filter* (*new_filter)(Device*, const char* type);
  void (*release_filter)(Filter*);
  void (*set_image)(Filter*, const char* name, void* data, int format, size_t width, size_t height, size_t offset,
                    size_t pixel_stride, size_t row_stride);
  void (*set_bool)(Filter*, const char* name, bool value);
  void (*set_progress)(Filter*, bool (*function)(void* user, double progress), void* user);
  void (*commit_filter)(Filter*);
  void (*execute)(Filter*);
};

template <class F>
bool load(F*& function, void* library, std::initializer_list<const char*> names) {
  function = nullptr;
  for (const char* name : names)
    if (!function) function = reinterpret_cast<F*>(dlsym(library, name));
  return function != nullptr;
}

std::unique_ptr<const Library> load_library() {
  void* library = nullptr;
  for (const char* file : {"libOpenImageDenoise.so.2", "libOpenImageDenoise.so.1"})
    if (!library) library = dlopen(file, RTLD_NOW | RTLD_LOCAL);
  if (!library) return nullptr;
  auto f = std::make_unique<Library>();
  const bool is_complete =
      load(f->new_device, library, {"oidnNewDevice"}) && load(f->release_device, library, {"oidnReleaseDevice"}) &&
      load(f->set_device_int, library, {"oidnSetDeviceInt", "oidnSetDevice1i"}) &&
      load(f->commit_device, library, {"oidnCommitDevice"}) && load(f->device_error, library, {"oidnGetDeviceError"}) &&
      load(f->new_filter, library, {"oidnNewFilter"}) && load(f->release_filter, library, {"oidnReleaseFilter"}) &&
      load(f->set_image, library, {"oidnSetSharedFilterImage"}) &&
      load(f->set_bool, library, {"oidnSetFilterBool", "oidnSetFilter1b"}) &&
      load(f->set_progress, library, {"oidnSetFilterProgressMonitorFunction"}) &&
      load(f->commit_filter, library, {"oidnCommitFilter"}) && load(f->execute, library, {"oidnExecuteFilter"});
  if (!is_complete) return nullptr;
  return f;
}

// Null if it is not installed. It stays loaded until the program ends.
const Library* library() {
  static const std::unique_ptr<const Library> kLibrary = load_library();
  return kLibrary.get();
}

// Three numbers per pixel: the mean of the half-buffers.
std::vector<float> colors_of(const DenoiseInput& input) {
  std::vector<float> values;
  values.reserve(3 * input.half_buffers[0].size());
  for (size_t i = 0; i < input.half_buffers[0].size(); ++i)
    for (int c = 0; c < 3; ++c) {
      const float mean = (input.half_buffers[0][i][c] + input.half_buffers[1][i][c]) / 2;
      values.push_back(std::isfinite(mean) ? mean : 0);
    }
  return values;
}

// Three numbers per pixel from three planes; empty without features.
std::vector<float> features_of(const DenoiseInput& input, size_t first_plane) {
  std::vector<float> values;
  for (size_t i = 0; i < input.features[0][first_plane].size(); ++i)
    for (size_t k = first_plane; k < first_plane + 3; ++k)
      values.push_back((input.features[0][k][i] + input.features[1][k][i]) / 2);
  return values;
}

bool continues_of(void* user, double) { return (*static_cast<const std::function<bool()>*>(user))(); }

// One run of the library, with the objects that it needs.
class Run {
 public:
  Run(const Library& library, int threads)
      : library_(library), device_(library.new_device(kDeviceTypeCpu), library.release_device) {
    if (!device_) return;
    if (threads > 0) library_.set_device_int(device_.get(), "numThreads", threads);
    library_.commit_device(device_.get());
    filter_ = {library_.new_filter(device_.get(), "RT"), library_.release_filter};
  }

  void set_image(const char* name, std::vector<float>& values, int width, int height) {
    if (!filter_ || values.empty()) return;
    library_.set_image(filter_.get(), name, values.data(), kFormatFloat3, static_cast<size_t>(width),
                       static_cast<size_t>(height), 0, 0, 0);
  }

  // Returns the error code.
  int execute(const std::function<bool()>& continues, std::string& message) {
    if (filter_) {
      library_.set_bool(filter_.get(), "hdr", true);
      library_.set_progress(filter_.get(), continues_of, const_cast<std::function<bool()>*>(&continues));
      library_.commit_filter(filter_.get());
      library_.execute(filter_.get());
    }
    const char* text = nullptr;
    const int code = library_.device_error(device_.get(), &text);
    message = text ? text : "it creates no filter";
    return filter_ || code != kErrorNone ? code : -1;
  }

 private:
  const Library& library_;
  std::unique_ptr<Device, void (*)(Device*)> device_;
  std::unique_ptr<Filter, void (*)(Filter*)> filter_{nullptr, [](Filter*) {}};
};

}  // namespace

Result<void> find_open_image_denoise() {
  if (library()) return {};
  return usage_error("Open Image Denoise is not installed: there is no libOpenImageDenoise.so.2 or .so.1");
}

Result<std::vector<Rgb>> denoise_with_open_image_denoise(const DenoiseInput& input, int threads,
                                                         const std::function<bool()>& continues) {
  if (const auto found = find_open_image_denoise(); !found) return found.error();
  std::vector<float> color = colors_of(input), albedo = features_of(input, 0), normal = features_of(input, 3);
  std::vector<float> output(color.size());
  std::string message;
  Run run(*library(), threads);
  run.set_image("color", color, input.width, input.height);
  run.set_image("albedo", albedo, input.width, input.height);
  run.set_image("normal", normal, input.width, input.height);
  run.set_image("output", output, input.width, input.height);
  const int error = run.execute(continues, message);
  if (error == kErrorCancelled) return std::vector<Rgb>();
  if (error != kErrorNone) return input_error("Open Image Denoise: " + message);
  std::vector<Rgb> image;
  for (size_t i = 0; i + 2 < output.size(); i += 3) image.push_back({output[i], output[i + 1], output[i + 2]});
  return image;
}

}  // namespace etendue::film
