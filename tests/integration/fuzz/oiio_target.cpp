// Image files that OpenImageIO reads. The first byte of an input selects the format, the rest is the file.
#include <array>
#include <cmath>
#include <cstdio>
#include <cstdlib>

#include "base/file.h"
#include "image/format.h"
#include "image/plugin.h"
#include "image/plugin_interface.h"
#include "integration/fuzz/memory_file.h"
#include "integration/fuzz/target.h"

namespace etendue::fuzz {
namespace {

constexpr std::array kFormats{"tif", "tga", "bmp", "sgi", "ppm", "dpx", "jp2", "dds", "psd"};
constexpr int kWidth = 7, kHeight = 5;

const image::ImagePlugin& plugin() {
  static const image::ImagePlugin* loaded = [] {
    const auto found = image::image_plugin();
    if (found) return *found;
    // The value that CTest counts as skipped.
    std::fprintf(stderr, "skipped: %s\n", found.error().message.c_str());
    std::exit(77);
  }();
  return *loaded;
}

void read(Input input) {
  if (input.empty()) return;
  const char* format = kFormats[std::to_integer<size_t>(input[0]) % kFormats.size()];
  const MemoryFile file(input.subspan(1));
  for (const auto values : {image::PluginValues::texture, image::PluginValues::linear}) {
    const auto decoded = plugin().read({.path = file.path(),
                                        .name = "input",
                                        .format = format,
                                        .values = values,
                                        .check_size = image::check_image_size});
    if (!decoded) continue;
    const size_t expected = static_cast<size_t>(decoded->width) * static_cast<size_t>(decoded->height) *
                            static_cast<size_t>(decoded->channels);
    require(std::max(decoded->bytes.size(), decoded->floats.size()) == expected, "an image has too few pixels");
  }
}

Bytes with_format(size_t format, Bytes file) {
  file.insert(file.begin(), static_cast<std::byte>(format));
  return file;
}

// Little-endian for DDS, big-endian for PSD.
void append(Bytes& bytes, uint32_t value, int size, bool big) {
  for (int i = 0; i < size; ++i) bytes.push_back(static_cast<std::byte>(value >> (8 * (big ? size - 1 - i : i))));
}

// Uncompressed RGBA.
Bytes dds_file() {
  Bytes bytes = bytes_of("DDS ");
  const auto add = [&](uint32_t value) { append(bytes, value, 4, false); };
  for (const uint32_t value : {124u, 0x100fu, unsigned{kHeight}, unsigned{kWidth}, 4u * kWidth, 0u, 0u}) add(value);
  for (int i = 0; i < 11; ++i) add(0);
  for (const uint32_t value : {32u, 0x41u, 0u, 32u, 0xff0000u, 0xff00u, 0xffu, 0xff000000u, 0x1000u, 0u, 0u, 0u, 0u})
    add(value);
  for (uint32_t i = 0; i < kWidth * kHeight; ++i) add(i * 0x01020305);
  return bytes;
}

// RGB without compression, without resources and layers.
Bytes psd_file() {
  Bytes bytes = bytes_of("8BPS");
  const auto add = [&](uint32_t value, int size) { append(bytes, value, size, true); };
  add(1, 2);
  add(0, 4);
  add(0, 2);
  add(3, 2);
  add(kHeight, 4);
  add(kWidth, 4);
  add(8, 2);
  add(3, 2);
  for (int section = 0; section < 3; ++section) add(0, 4);
  add(0, 2);
  for (uint32_t i = 0; i < 3 * kWidth * kHeight; ++i) add(i * 7, 1);
  return bytes;
}

std::vector<Bytes> files() {
  std::vector<float> linear(size_t{3} * kWidth * kHeight);
  std::vector<uint8_t> display(linear.size());
  for (size_t i = 0; i < linear.size(); ++i) {
    linear[i] = static_cast<float>(i) / 64;
    display[i] = static_cast<uint8_t>(i * 5 % 251);
  }
  namespace fs = std::filesystem;
  std::vector<Bytes> seeds;
  for (size_t format = 0; format < kFormats.size(); ++format) {
    const fs::path file =
        fs::temp_directory_path() / ("etendue-fuzz-" + std::to_string(::getpid()) + "." + kFormats[format]);
    for (const bool is_linear : {false, true}) {
      image::PluginWrite request{.path = file.string(), .name = "seed", .width = kWidth, .height = kHeight};
      if (is_linear)
        request.linear = linear;
      else
        request.display = display;
      // Not all formats can be written, and some store only one kind of values.
      if (!plugin().write(request)) continue;
      if (const auto bytes = read_file(file)) seeds.push_back(with_format(format, *bytes));
    }
    std::error_code code;
    fs::remove(file, code);
  }
  require(seeds.size() >= 6, "seeds cannot be written");
  seeds.push_back(with_format(7, dds_file()));
  seeds.push_back(with_format(8, psd_file()));
  for (const Bytes& seed : seeds) {
    const MemoryFile file(Input(seed).subspan(1));
    const char* format = kFormats[std::to_integer<size_t>(seed[0])];
    const auto decoded =
        plugin().read({.path = file.path(), .name = "seed", .format = format, .check_size = image::check_image_size});
    require(static_cast<bool>(decoded), decoded ? "" : decoded.error().message.c_str());
  }
  return seeds;
}

}  // namespace

const Target kTarget{.run = read, .seeds = files};

}  // namespace etendue::fuzz
