#include "part_options.h"

#include <array>
#include <charconv>
#include <vector>

#include "render/sample_coverage.h"

namespace etendue::cli {
namespace {

constexpr uint32_t kLastSample = 1'000'000;

// The non-negative integers in a text like "1,2,3"; nothing if it is not a list of integers.
std::vector<int64_t> parse_integers(const std::string& text, char separator) {
  std::vector<int64_t> values;
  const char *next = text.data(), *end = text.data() + text.size();
  while (true) {
    int64_t value = 0;
    const auto parsed = std::from_chars(next, end, value);
    if (parsed.ec != std::errc() || value < 0) return {};
    values.push_back(value);
    if (parsed.ptr == end) return values;
    if (*parsed.ptr != separator) return {};
    next = parsed.ptr + 1;
  }
}

struct SampleRange {
  uint32_t first, end;
};

Result<SampleRange> parse_samples(const std::string& text) {
  const auto values = parse_integers(text, ':');
  if (values.size() == 2 && values[0] < values[1] && values[1] <= kLastSample)
    return SampleRange{static_cast<uint32_t>(values[0]), static_cast<uint32_t>(values[1])};
  return usage_error("--samples: '" + text + "' is not a range; give A:B with A < B <= " + std::to_string(kLastSample) +
                     ", for example 0:64 for the samples 0 to 63");
}

Result<render::PixelRect> parse_region(const std::string& text, const render::Document& d) {
  const auto v = parse_integers(text, ',');
  if (v.size() == 4 && v[2] > 0 && v[3] > 0 && v[0] <= d.width && v[1] <= d.height && v[2] <= d.width - v[0] &&
      v[3] <= d.height - v[1])
    return render::PixelRect{static_cast<int>(v[0]), static_cast<int>(v[1]), static_cast<int>(v[2]),
                             static_cast<int>(v[3])};
  return usage_error("--region: '" + text + "' is not a part of the image; give X,Y,W,H within " +
                     std::to_string(d.width) + "x" + std::to_string(d.height) + " pixels, for example 0,0,32,16");
}

}  // namespace

CommandOption samples_option(std::string& target) {
  return {.names = "--samples",
          .target = &target,
          .doc = "Render only the samples A to B - 1 of each pixel, as A:B. OUT becomes a part for etendue merge"};
}

CommandOption region_option(std::string& target) {
  return {.names = "--region",
          .target = &target,
          .doc =
              "Render only this part of the image, as X,Y,W,H in pixels from the upper left corner. OUT becomes a "
              "part for etendue merge"};
}

Result<void> apply_part(const PartArguments& arguments, uint32_t samples, render::Document& document) {
  SampleRange range{0, document.limits.samples};
  if (!arguments.samples.empty()) {
    if (samples > 0)
      return usage_error("render: --samples A:B and --spp N exclude each other; --spp N is --samples 0:N");
    const auto parsed = parse_samples(arguments.samples);
    if (!parsed) return parsed.error();
    range = *parsed;
  }
  // A part without a region names the whole image, so that its checkpoint differs from that of a rendering that is not
  // divided.
  document.part.region = render::PixelRect{0, 0, document.width, document.height};
  if (!arguments.region.empty()) {
    const auto parsed = parse_region(arguments.region, document);
    if (!parsed) return parsed.error();
    document.part.region = *parsed;
  }
  document.part.first_sample = range.first;
  document.limits = {range.end - range.first, 0, 0, document.limits.measure};
  return {};
}

Result<void> check_resumed_part(const PartArguments& arguments, const render::Document& document) {
  if (!arguments.is_given()) return {};
  if (document.part.is_whole())
    return usage_error("--resume: the checkpoint is not one of a part; leave out --samples and --region");
  render::Document repeated = document;
  if (auto ok = apply_part(arguments, 0, repeated); !ok) return ok;
  if (repeated.part == document.part && repeated.limits.samples == document.limits.samples) return {};
  const uint32_t first = document.part.first_sample;
  return usage_error(
      "--resume: a checkpoint continues with its own part: " +
      render::text_of({first, first + document.limits.samples, document.part.region.value_or(render::PixelRect())},
                      document.width, document.height));
}

}  // namespace etendue::cli
