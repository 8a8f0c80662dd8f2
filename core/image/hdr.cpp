// Radiance pictures (.hdr): four bytes a pixel, three mantissas and a shared exponent (G. Ward, "Real Pixels", Graphics
// Gems II, 1991), scanlines stored flat or run-length encoded in the old or the new way (Radiance file formats,
// "Picture").
//
// A mantissa is read as byte * 2^(exponent - 136), without Ward's half step, as image libraries do; the writer rounds
// to the nearest such value. EXPOSURE is not undone: renderers agree on the stored numbers.
#include <algorithm>
#include <array>
#include <charconv>
#include <cmath>
#include <memory>

#include "base/file.h"
#include "image/codecs.h"

namespace etendue::image {
namespace {

using Rgbe = std::array<uint8_t, 4>;
using Row = std::span<Rgbe>;

// Widths that the new run-length encoding can express.
constexpr size_t kMinRunWidth = 8, kMaxRunWidth = 32767;

// The shortest row, whatever its encoding.
constexpr uint64_t kMinRowBytes = 4;

class Input {
 public:
  explicit Input(Bytes bytes) : bytes_(bytes) {}

  bool take(uint8_t& byte) {
    if (at_ == bytes_.size()) return false;
    byte = static_cast<uint8_t>(bytes_[at_++]);
    return true;
  }
  bool take(Rgbe& pixel) { return take(pixel[0]) && take(pixel[1]) && take(pixel[2]) && take(pixel[3]); }
  bool take_line(std::string& line) {
    line.clear();
    for (uint8_t c; take(c);) {
      if (c == '\n') return true;
      line.push_back(static_cast<char>(c));
    }
    return false;
  }

 private:
  Bytes bytes_;
  size_t at_ = 0;
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
    if (!input.take_line(line)) return input_error(name + ": the Radiance header is cut off");
    if (line.starts_with("FORMAT=") && !line.starts_with("FORMAT=32-bit_rle_rgbe"))
      return input_error(name + ": '" + line + "' cannot be read; give FORMAT=32-bit_rle_rgbe");
  } while (!line.empty() && line != "\r");
  if (!input.take_line(line) || !parse_resolution(line, width, height))
    return input_error(name + ": the Radiance resolution line is not of the form '-Y height +X width'");
  return {};
}

bool read_component(Input& input, Row row, size_t component) {
  for (size_t x = 0; x < row.size();) {
    uint8_t count = 0, value = 0;
    if (!input.take(count) || count == 0) return false;
    const bool run = count > 128;
    const size_t length = run ? count - 128u : count;
    if (length > row.size() - x || (run && !input.take(value))) return false;
    for (const size_t end = x + length; x < end; ++x) {
      if (!run && !input.take(value)) return false;
      row[x][component] = value;
    }
  }
  return true;
}

// Flat pixels, of which 1,1,1,n repeats the one before n times; a second such pixel in turn counts 256 n times, and so
// on.
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
    if (!input.take(pixel)) return false;
  }
}

bool read_row(Input& input, Row row) {
  Rgbe first;
  if (!input.take(first)) return false;
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

// What the format cannot hold becomes what is nearest: zero for negative values and NaN, the largest number for
// infinity.
Rgbe encode(const float* rgb) {
  constexpr float kLargest = 0x1.fep+126f;
  float v[3], largest = 0;
  for (int c = 0; c < 3; ++c) {
    v[c] = rgb[c] > 0 ? std::min(rgb[c], kLargest) : 0.0f;
    largest = std::max(largest, v[c]);
  }
  int exponent = 0;
  // A largest mantissa that would round up to 256 takes the next exponent.
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

// Runs of fewer than four bytes do not pay and stay among the literal ones.
void append_component(Row row, size_t component, std::string& out) {
  constexpr size_t kWorthwhile = 4, kMostLiterals = 128;
  for (size_t x = 0; x < row.size();) {
    const size_t run = run_length(row, x, component);
    if (run >= kWorthwhile) {
      out.push_back(static_cast<char>(128 + run));
      out.push_back(static_cast<char>(row[x][component]));
      x += run;
      continue;
    }
    size_t end = x + 1;
    while (end < row.size() && end - x < kMostLiterals && run_length(row, end, component) < kWorthwhile) ++end;
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

}  // namespace

bool is_hdr(Bytes bytes) { return starts_with(bytes, "#?RADIANCE") || starts_with(bytes, "#?RGBE"); }

Result<Image> decode_hdr(Bytes bytes, const std::string& name) {
  Input input(bytes);
  uint64_t width = 0, height = 0;
  if (auto header = read_header(input, name, width, height); !header) return header.error();
  if (auto size = check_size(width, height, name); !size) return size.error();
  if (auto length = check_length(height * kMinRowBytes, bytes, name); !length) return length.error();

  Image image;
  image.width = static_cast<int>(width), image.height = static_cast<int>(height), image.channels = 3;
  image.type = PixelType::float32;
  // Neither memory is touched before there are data for it, so that a lying header costs nothing.
  image.floats.reserve(width * height * 3);
  const auto storage = std::make_unique_for_overwrite<Rgbe[]>(width);
  const Row row(storage.get(), width);
  for (uint64_t y = 0; y < height; ++y) {
    if (!read_row(input, row))
      return input_error(name + ": the Radiance data are damaged or cut off in row " + std::to_string(y));
    for (const Rgbe& pixel : row) append_decoded(pixel, image.floats);
  }
  return image;
}

Result<void> write_hdr(const std::filesystem::path& path, int width, int height, std::span<const float> rgb) {
  const size_t w = static_cast<size_t>(std::max(width, 0)), h = static_cast<size_t>(std::max(height, 0));
  if (rgb.empty() || rgb.size() != w * h * 3)
    return output_error(path.string() + ": the pixels do not fill " + std::to_string(width) + " x " +
                        std::to_string(height) + " RGB");
  std::string out = "#?RADIANCE\nFORMAT=32-bit_rle_rgbe\n\n-Y " + std::to_string(h) + " +X " + std::to_string(w) + "\n";
  std::vector<Rgbe> row(w);
  for (size_t y = 0; y < h; ++y) {
    for (size_t x = 0; x < w; ++x) row[x] = encode(&rgb[(y * w + x) * 3]);
    append_row(row, out);
  }
  return write_file(path, out.data(), out.size());
}

}  // namespace etendue::image
