// Radiance HDR (.hdr): RGBE, four bytes per pixel, which are three mantissas and a shared exponent [Ward 1991]
//
// Read: scanlines stored flat, or with the old or the new run-length encoding of the format [Radiance file formats].
// A component is byte * 2^(exponent - 136), without the offset of half a step in [Ward 1991], as in other image
// libraries. EXPOSURE is ignored, as in other renderers.
//
// Written: the new run-length encoding; components are rounded to the nearest representable value.
#include <algorithm>
#include <array>
#include <charconv>
#include <cmath>
#include <memory>

#include "base/file.h"
#include "image/format.h"

namespace etendue::image {
namespace {

using Rgbe = std::array<uint8_t, 4>;
using Row = std::span<Rgbe>;

// The widths that the new run-length encoding can represent.
constexpr size_t kMinRunWidth = 8, kMaxRunWidth = 32767;

// The length of the shortest row in any encoding.
constexpr uint64_t kMinRowBytes = 4;

class Input {
 public:
  explicit Input(Bytes bytes) : bytes_(bytes) {}

  // Each function returns false at the end of the file.
  bool read(uint8_t& byte) {
    if (position_ == bytes_.size()) return false;
    byte = static_cast<uint8_t>(bytes_[position_++]);
    return true;
  }
  bool read(Rgbe& pixel) { return read(pixel[0]) && read(pixel[1]) && read(pixel[2]) && read(pixel[3]); }
  bool read_line(std::string& line) {
    line.clear();
    for (uint8_t c; read(c);) {
      if (c == '\n') return true;
      line.push_back(static_cast<char>(c));
    }
    return false;
  }

 private:
  Bytes bytes_;
  size_t position_ = 0;
};

// "-Y height +X width": rows from the top, pixels from the left.
bool parse_resolution(const std::string& line, uint64_t& width, uint64_t& height) {
  const size_t x = line.find(" +X ");
  if (!line.starts_with("-Y ") || x == std::string::npos) return false;
  const char *middle = line.data() + x, *end = line.data() + line.size();
  const auto h = std::from_chars(line.data() + 3, middle, height);
  const auto w = std::from_chars(middle + 4, end, width);
  return h.ec == std::errc() && h.ptr == middle && w.ec == std::errc() && (w.ptr == end || *w.ptr == '\r');
}

Result<void> read_header(Input& input, const std::string& name, uint64_t& width, uint64_t& height) {
  std::string line;
  do {
    if (!input.read_line(line)) return input_error(name + ": the Radiance header is truncated");
    if (line.starts_with("FORMAT=") && !line.starts_with("FORMAT=32-bit_rle_rgbe"))
      return input_error(name + ": '" + line + "' is not supported; expected FORMAT=32-bit_rle_rgbe");
  } while (!line.empty() && line != "\r");
  if (!input.read_line(line) || !parse_resolution(line, width, height))
    return input_error(name + ": invalid Radiance resolution line; expected '-Y height +X width'");
  return {};
}

bool read_component(Input& input, Row row, size_t component) {
  for (size_t x = 0; x < row.size();) {
    uint8_t count = 0, value = 0;
    if (!input.read(count) || count == 0) return false;
    const bool run = count > 128;
    const size_t length = run ? count - 128u : count;
    if (length > row.size() - x || (run && !input.read(value))) return false;
    for (const size_t end = x + length; x < end; ++x) {
      if (!run && !input.read(value)) return false;
      row[x][component] = value;
    }
  }
  return true;
}

// Flat pixels with the old run-length encoding: the pixel (1, 1, 1, n) repeats the previous pixel n times; the k-th
// such pixel in a row repeats it 256^(k-1) n times. `pixel` is the first pixel of the row.
bool read_old_row(Input& input, Row row, Rgbe pixel) {
  unsigned shift = 0;
  for (size_t x = 0;;) {
    if (pixel[0] == 1 && pixel[1] == 1 && pixel[2] == 1) {
      const size_t length = size_t{pixel[3]} << shift;
      if (x == 0 || shift > 16 || length > row.size() - x) return false;
      std::ranges::fill(row.subspan(x, length), Rgbe(row[x - 1]));
      x += length;
      shift += 8;
    } else {
      row[x++] = pixel;
      shift = 0;
    }
    if (x == row.size()) return true;
    if (!input.read(pixel)) return false;
  }
}

bool read_row(Input& input, Row row) {
  Rgbe first;
  if (!input.read(first)) return false;
  const bool width_allows = row.size() >= kMinRunWidth && row.size() <= kMaxRunWidth;
  if (!width_allows || first[0] != 2 || first[1] != 2 || first[2] >= 128) return read_old_row(input, row, first);
  if (size_t{first[2]} * 256 + first[3] != row.size()) return false;
  for (size_t c = 0; c < 4; ++c)
    if (!read_component(input, row, c)) return false;
  return true;
}

void append_decoded(const Rgbe& pixel, std::vector<float>& rgb) {
  const float scale = pixel[3] == 0 ? 0.0f : std::ldexp(1.0f, pixel[3] - 136);
  for (size_t c = 0; c < 3; ++c) rgb.push_back(static_cast<float>(pixel[c]) * scale);
}

// The nearest representable value: zero for negative values and NaN, the largest value for infinity.
Rgbe encode(const float* rgb) {
  constexpr float kLargest = 0x1.fep+126f;
  float v[3], largest = 0;
  for (int c = 0; c < 3; ++c) {
    v[c] = rgb[c] > 0 ? std::min(rgb[c], kLargest) : 0.0f;
    largest = std::max(largest, v[c]);
  }
  int exponent = 0;
  // If the largest mantissa would round up to 256, the next exponent is used.
  if (std::frexp(largest, &exponent) * 256.0f >= 255.5f) ++exponent;
  if (largest <= 0 || exponent < -127) return {};
  Rgbe pixel{0, 0, 0, static_cast<uint8_t>(exponent + 128)};
  for (size_t c = 0; c < 3; ++c) pixel[c] = static_cast<uint8_t>(std::lround(std::ldexp(v[c], 8 - exponent)));
  return pixel;
}

size_t run_length(Row row, size_t x, size_t component) {
  size_t end = x + 1;
  while (end < row.size() && end - x < 127 && row[end][component] == row[x][component]) ++end;
  return end - x;
}

// Runs of fewer than four bytes are stored as literals, which is shorter.
void append_component(Row row, size_t component, std::string& out) {
  constexpr size_t kMinRun = 4, kMaxLiterals = 128;
  for (size_t x = 0; x < row.size();) {
    const size_t run = run_length(row, x, component);
    if (run >= kMinRun) {
      out.push_back(static_cast<char>(128 + run));
      out.push_back(static_cast<char>(row[x][component]));
      x += run;
      continue;
    }
    size_t end = x + 1;
    while (end < row.size() && end - x < kMaxLiterals && run_length(row, end, component) < kMinRun) ++end;
    out.push_back(static_cast<char>(end - x));
    for (; x < end; ++x) out.push_back(static_cast<char>(row[x][component]));
  }
}

void append_row(Row row, std::string& out) {
  if (row.size() < kMinRunWidth || row.size() > kMaxRunWidth) {
    for (const Rgbe& pixel : row) out.append(pixel.begin(), pixel.end());
    return;
  }
  out.append({2, 2, static_cast<char>(row.size() >> 8), static_cast<char>(row.size() & 255)});
  for (size_t c = 0; c < 4; ++c) append_component(row, c, out);
}

bool is_hdr(Bytes bytes) { return starts_with(bytes, "#?RADIANCE") || starts_with(bytes, "#?RGBE"); }

Result<Image> decode_hdr(Bytes bytes, const std::string& name) {
  Input input(bytes);
  uint64_t width = 0, height = 0;
  if (auto header = read_header(input, name, width, height); !header) return header.error();
  if (auto size = check_image_size(width, height, name); !size) return size.error();
  if (auto length = check_file_length(height * kMinRowBytes, bytes, name); !length) return length.error();

  Image image{
      .width = static_cast<int>(width), .height = static_cast<int>(height), .channels = 3, .type = PixelType::float32};
  // Memory is reserved but not touched before data were read for it, so that a wrong header costs nothing.
  image.floats.reserve(width * height * 3);
  const auto storage = std::make_unique_for_overwrite<Rgbe[]>(width);
  const Row row(storage.get(), width);
  for (uint64_t y = 0; y < height; ++y) {
    if (!read_row(input, row))
      return input_error(name + ": the Radiance data are damaged or truncated in row " + std::to_string(y));
    for (const Rgbe& pixel : row) append_decoded(pixel, image.floats);
  }
  return image;
}

}  // namespace

Result<void> write_hdr(const std::filesystem::path& path, int width, int height, std::span<const float> rgb) {
  if (auto size = check_rgb_size(width, height, rgb.size(), path.string()); !size) return size;
  const auto w = static_cast<size_t>(width), h = static_cast<size_t>(height);
  std::string out = "#?RADIANCE\nFORMAT=32-bit_rle_rgbe\n\n-Y " + std::to_string(h) + " +X " + std::to_string(w) + "\n";
  std::vector<Rgbe> row(w);
  for (size_t y = 0; y < h; ++y) {
    for (size_t x = 0; x < w; ++x) row[x] = encode(&rgb[(y * w + x) * 3]);
    append_row(row, out);
  }
  return write_file(path, out.data(), out.size());
}

extern const ImageFormat kHdrFormat{
    .name = "hdr",
    .label = "Radiance HDR",
    .extensions = {".hdr"},
    .doc = "Read and written: linear RGB with 8-bit mantissas and a shared exponent.",
    .recognises = is_hdr,
    .decode = decode_hdr,
    .write_linear = write_hdr,
};

}  // namespace etendue::image
